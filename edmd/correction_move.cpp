#include "edmd/correction_move.h"

namespace vitrel {

template <int Dim>
void separate(Motion<Dim>& one, const Inertia<Dim>& inertia1, Motion<Dim>& two,
              const Inertia<Dim>& inertia2, const Vec<Dim>& d) {
  const double m1 = 1 / inertia1.inverse_mass;
  const double m2 = 1 / inertia2.inverse_mass;
  const Vec<Dim> common = (m1 * one.velocity + m2 * two.velocity) / (m1 + m2);
  const double speed = norm(two.velocity - one.velocity);
  const Vec<Dim> apart = normalized(d);
  one.velocity = common - m2 / (m1 + m2) * speed * apart;
  two.velocity = common + m1 / (m1 + m2) * speed * apart;
}

template void separate(Motion<2>&, const Inertia<2>&, Motion<2>&, const Inertia<2>&, const Vec<2>&);
template void separate(Motion<3>&, const Inertia<3>&, Motion<3>&, const Inertia<3>&, const Vec<3>&);

}  // namespace vitrel
