#pragma once

#include <algorithm>
#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <cmath>
#include <type_traits>
#include <vector>

#include "core/error.h"
#include "edmd/soft/linear_dashpot.h"
#include "edmd/soft/restitution.h"
#include "edmd/soft/viscoelastic.h"

namespace vitrel {

/// What integrate_contact is compared with: the equations of motion as they stand, in l − r, φ and t, in
/// extended precision by the method of Bulirsch and Stoer, up to the last step that does not pass the
/// end of the contact. Neither variables nor method nor the search for the end are those of edmd. Its errors
/// are some 10⁻¹⁶, absolute: damping beyond c_dis = 20 leaves too little of ε_t and ε_ṙ.
template <class Force>
requires std::is_same_v<Force, LinearDashpot> || std::is_same_v<Force, Viscoelastic>
class PlainContact {
 public:
  explicit PlainContact(const ScaledImpact& impact)
      : distance_(impact.distance), swirl_(impact.angular_momentum), damping_(impact.damping) {}

  Restitution operator()() const {
    namespace odeint = boost::numeric::odeint;
    odeint::bulirsch_stoer<State, long double> stepper(1e-17L, 1e-17L);
    const auto motion = [this](const State& x, State& slope, long double) { move(x, slope); };
    State x{0, 1, 0};
    long double time = 0, step = 1e-3L / (1 + damping_), taken = 1;
    for (int trial = 0; taken > 1e-17L && step > 1e-18L; ++trial) {
      if (trial == max_trials) throw InvariantError("the plain contact does not end");
      const State before = x;
      const long double begin = time;
      if (stepper.try_step(motion, x, time, step) == odeint::fail) continue;
      taken = time - begin;
      step = std::min(step, 2 * taken);
      if (x[1] >= 0 || force(x) > 0) continue;
      x = before;
      time = begin;
      step = taken / 4;
    }
    return {static_cast<double>(1 - x[0] / distance_), static_cast<double>(x[2]),
            static_cast<double>(time), static_cast<double>(x[1])};
  }

 private:
  using State = std::vector<long double>;  // l − r, −r', φ
  static constexpr int max_trials = 1'000'000;

  // The dashpot's is smooth beyond r = l, where a step that is tried may go; the other one is none there.
  long double force(const State& x) const {
    const long double pull = x[0] + damping_ * x[1];
    if constexpr (std::is_same_v<Force, LinearDashpot>)
      return pull;
    else
      return x[0] > 0 ? std::sqrt(x[0]) * pull : 0;
  }
  void move(const State& x, State& slope) const {
    const long double r = distance_ - x[0];
    slope.resize(3);
    slope[0] = x[1];
    slope[1] = -swirl_ * swirl_ / (r * r * r) - force(x);
    slope[2] = swirl_ / (r * r);
  }

  long double distance_, swirl_, damping_;
};

}  // namespace vitrel
