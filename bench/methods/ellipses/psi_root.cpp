#include "bench/methods/ellipses/psi_root.h"

#include <cmath>

#include "bench/methods/first_root.h"
#include "bench/methods/opening.h"

namespace vitrel::bench {

Prediction2 psi_root(const CollisionCase& asked, double tolerance) {
  const Opening opening = open_search(asked);
  if (opening.answer) return *opening.answer;
  const auto signed_psi = [&](double time) {
    const VieillardBaron<double> contact = vieillard_baron_at(asked, time);
    return contact.disjoint_or_touching() ? contact.psi : -std::abs(contact.psi);
  };
  const RootSearch search = first_root(signed_psi, opening.bracket, tolerance);
  if (!search.time) return without_contact(Outcome::none, search.evaluations);
  return contact_at(asked, *search.time, search.evaluations);
}

}  // namespace vitrel::bench
