#include "bench/methods/ellipsoids/roots.h"

#include "bench/methods/first_root.h"
#include "bench/methods/opening.h"

#include "core/geometry/free_flight.h"

namespace vitrel::bench {
namespace {

bool is_external_contact(const EllipsoidEta<double>& eta) {
  return eta.eta2 > 0 && eta.eta3 < 0 && eta.eta5 > 0;
}

Prediction3 touch_at(const EllipsoidCase& asked, double time, int evaluations) {
  const Pose3 one = pose_at(asked, 0, time), two = pose_at(asked, 1, time);
  const auto touch = ellipsoid_touch<double>({body_at(asked.one, time), one.orientation},
                                             {body_at(asked.two, time), two.orientation},
                                             two.position - one.position);
  return {Outcome::contact, time, touch.normal, one.position + touch.point, evaluations};
}

}  // namespace

Prediction3 eta_root(const EllipsoidCase& asked, double tolerance) {
  const OpeningOf<3> opening = open_search(asked);
  if (opening.answer) return *opening.answer;
  const Bracket& bracket = opening.bracket;
  int evaluations = 0;
  const auto eta1 = [&](double time) {
    ++evaluations;
    return ellipsoid_eta_at(asked, time).eta1;
  };
  const int steps = scan_steps_of(tolerance);
  double before = bracket.earliest;
  double eta_before = eta1(before);
  for (int step = 1; step <= steps; ++step) {
    const double time = bracket.sample(step, steps);
    const double eta_time = eta1(time);
    if ((eta_before > 0 && eta_time <= 0) || (eta_before <= 0 && eta_time > 0)) {
      const double sign = eta_before > 0 ? 1 : -1;
      const auto falling = [&](double at) { return sign * eta1(at); };
      const double root = root_between(falling, before, sign * eta_before, time, sign * eta_time);
      if (is_external_contact(ellipsoid_eta_at(asked, root)))
        return touch_at(asked, root, evaluations);
    }
    before = time;
    eta_before = eta_time;
  }
  return without_contact<3>(Outcome::none, evaluations);
}

Prediction3 perram_wertheim_root(const EllipsoidCase& asked, double tolerance) {
  const OpeningOf<3> opening = open_search(asked);
  if (opening.answer) return *opening.answer;
  const auto excess = [&](double time) { return perram_wertheim_at(asked, time).value - 1; };
  const RootSearch search = first_root(excess, opening.bracket, tolerance);
  if (!search.time) return without_contact<3>(Outcome::none, search.evaluations);
  return contact_at(asked, *search.time, search.evaluations);
}

}  // namespace vitrel::bench
