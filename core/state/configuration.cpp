#include "core/state/configuration.h"

#include <algorithm>

namespace vitrel {

void Configuration2::resize(std::size_t n) {
  position.resize(n, Vec2::Zero());
  image.resize(n, Shift<2>::Zero());
  angle.resize(n, 0.0);
  velocity.resize(n, Vec2::Zero());
  angular_velocity.resize(n, 0.0);
  shape.resize(n);
  mass.resize(n, 1.0);
  species.resize(n, 0);
}

double packing_fraction(const Configuration2& configuration) {
  double area = 0;
  for (const Ellipse& shape : configuration.shape) area += shape.volume();
  return area / configuration.box.volume();
}

double largest_circumradius(const Configuration2& configuration) {
  double largest = 0;
  for (const Ellipse& shape : configuration.shape)
    largest = std::max(largest, shape.circumradius());
  return largest;
}

Mechanics mechanics(const Configuration2& configuration) {
  Mechanics sums{Vec2::Zero(), 0, 0};
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const Vec2& v = configuration.velocity[i];
    sums.momentum += configuration.mass[i] * v;
    sums.translational_energy += 0.5 * configuration.mass[i] * v.squaredNorm();
    if (configuration.shape[i].is_round()) continue;
    const double omega = configuration.angular_velocity[i];
    sums.rotational_energy += 0.5 * configuration.inertia(i) * omega * omega;
  }
  return sums;
}

std::size_t rotor_count(const Configuration2& configuration) {
  return std::count_if(configuration.shape.begin(), configuration.shape.end(),
                       [](const Ellipse& shape) { return !shape.is_round(); });
}

}  // namespace vitrel
