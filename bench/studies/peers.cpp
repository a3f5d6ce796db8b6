// What do the shortcuts cost that other programs are known to take?

#include <nlohmann/json.hpp>

#include "bench/studies/choice.h"
#include "bench/studies/study.h"

namespace vitrel::bench {
namespace {

/// A part of another study, restricted to some of its methods.
Part some_methods(const Study& study, const std::string& name, const std::string& about,
                  const std::vector<std::string>& methods) {
  Part part = selected(study.parts, {name}).front();
  part.about = about + " " + part.about;
  part.method_names = methods;
  part.measure = [measure = part.measure, methods](const StudyContext& context) {
    StudyOptions options = context.options;
    if (options.methods.empty()) options.methods = methods;
    return measure({options, context.control, context.more});
  };
  return part;
}

}  // namespace

Study peers_study() {
  const Study overlap = overlap_study(), contact = contact_time_study();
  const std::string undecided =
      "A search for the maximum of the function of Perram and Wertheim ends after some steps, and "
      "a "
      "pair without an answer counts as disjoint.";
  std::vector<std::string> criteria = {"separating_axis"};
  for (const char* const steps : {"4", "8", "16", "32", "64"})
    criteria.push_back(std::string("undecided_is_disjoint_") + steps);
  Part times = some_methods(
      contact, "plane",
      "A penalty on the overlap takes the place of the condition of contact (quadratic_penalty), "
      "or "
      "a distance is sampled and bisected where it changes its sign (perram_wertheim_root).",
      {"separating_axis", "quadratic_penalty", "perram_wertheim_root"});
  times.name = "contact_time";
  return {.name = "peers",
          .aliases = {},
          .question = "What do shortcuts cost that other programs are known to take?",
          .parts = {some_methods(overlap, "plane", undecided, criteria),
                    some_methods(overlap, "space", undecided, criteria), times},
          .defaults = {.pairs = 20000, .seconds = 4},
          .has_tolerance = true,
          .has_quick = false};
}

}  // namespace vitrel::bench
