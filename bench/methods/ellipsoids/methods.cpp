#include "bench/methods/ellipsoids/methods.h"

#include "bench/methods/ellipses/separating_axis.h"
#include "bench/methods/ellipsoids/eta_root.h"
#include "bench/methods/first_root.h"
#include "bench/methods/method_list.h"
#include "bench/methods/opening.h"

namespace vitrel::bench {
namespace {

std::vector<MethodEntry<3>> entries() {
  return {
      {"separating_axis", separating_axis, contact_at_rounding, contact_gaps},
      {"eta_root", eta_root, 1.0 / 100, scan_steps},
      {"perram_wertheim_root", perram_wertheim_root, 1.0 / 100, scan_steps},
  };
}

}  // namespace

Prediction3 perram_wertheim_root(const EllipsoidCase& asked, double tolerance) {
  const OpeningOf<3> opening = open_search(asked);
  if (opening.answer) return *opening.answer;
  const auto excess = [&](double time) { return perram_wertheim_at(asked, time).value - 1; };
  const RootSearch search = first_root(excess, opening.bracket, tolerance);
  if (!search.time) return without_contact<3>(Outcome::none, search.evaluations);
  return contact_at(asked, *search.time, search.evaluations);
}

std::vector<MethodOf<3>> ellipsoid_methods() {
  return at_usual_tolerance(entries());
}

std::vector<MethodOf<3>> ellipsoid_methods_by_tolerance() {
  return by_tolerance(entries());
}

}  // namespace vitrel::bench
