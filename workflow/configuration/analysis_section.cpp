#include "workflow/configuration/sections.h"

#include <fmt/format.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "analysis/observables/observable.h"
#include "core/error.h"

namespace vitrel {
void validate_choice(const std::string& tables) {
  try {
    static_cast<void>(TableChoice(tables));
  } catch (const UserError& error) {
    throw BadValue("analysis.only", error.what());
  }
}

void describe_analysis(DisplacementOptions& p, FieldVisitor& visit) {
  visit.field({"longest_lag", "",
               "Longest time difference, as a fraction of an evenly sampled run. For other runs "
               "time differences extend to the end.",
               bounds::share_above_none},
              p.axis.longest_lag);
  visit.field(
      {"every_lag_up_to", "sample intervals",
       "Up to this value every time difference is evaluated; beyond it they are spaced "
       "logarithmically. For runs that are not evenly sampled all are spaced logarithmically.",
       bounds::at_least_one},
      p.axis.every_lag_up_to);
  visit.field({"lags_per_decade", "", "Time differences per factor of ten in the logarithmic part.",
               bounds::at_least_one},
              p.axis.lags_per_decade);
  visit.field({"max_origins", "",
               "Maximum number of time origins per time difference; if there are more, they are "
               "thinned evenly, of many particles to 2²¹ origins of all particles together, but "
               "not to less than a quarter of this number.",
               bounds::at_least_one, "most_origins"},
              p.axis.max_origins);
  visit.field(
      {"wave_numbers", "1/length",
       "Wave numbers q of the intermediate scattering functions. If empty: approximately that of "
       "the main peak of the structure factor, with the number density ρ 2π √(2ρ/√3), in space "
       "2π √3 (ρ/4)^⅓. A sweep over packing fractions uses the highest density of its jobs for all "
       "of them.",
       bounds::positive},
      p.wave_numbers);
  visit.field({"orders",
               "",
               "Orders n of the orientational correlations, ⟨cos n(θ(t) − θ(0))⟩ in the plane and "
               "Legendre's ⟨P_n(u(0)·u(t))⟩ in space. If empty: 2 and 4, in space 1 and 2.",
               {.low = 1, .high = 100, .words = "be a whole number from 1 to 100"}},
              p.orders);
  visit.field({"waiting_times", "time",
               "Waiting times since the first sample, each followed by correlations of its frame "
               "alone with all later ones: how a glass ages. Sample evenly for them.",
               bounds::time_or_none},
              p.waiting_times);
  visit.field({"overlap_distance", "length",
               "Cutoff distance of the overlap function and the four-point susceptibility: a "
               "particle that has moved by less counts as immobile. Choose it somewhat larger than "
               "the rattling in a cage.",
               bounds::length},
              p.overlap_distance);
  visit.field({"memory", "bytes", "Memory for particle tracks.", {1 << 20}}, p.memory);
}

void describe_structure(StructureOptions& p, FieldVisitor& visit) {
  visit.field({"frames", "",
               "Maximum number of frames in averages; if there are more, they are thinned evenly, "
               "of more than 5000 particles to "
               "5000000 particles in all frames together, but not below 64 frames. 0: "
               "only the order of single frames, which the verdict on equilibrium needs."},
              p.max_frames);
  visit.field({"wave_number_max", "1/length", "Maximum wave number q of structure factors.",
               bounds::positive},
              p.shells.wave_number_max);
  visit.field(
      {"wave_number_step", "1/length",
       "Width of the q shells over which structure factors are averaged.", bounds::positive},
      p.shells.wave_number_step);
  visit.field({"distance_max", "length",
               "Maximum distance of pair correlations; at most half the shorter side of the box.",
               bounds::length},
              p.pairs.distance_max);
  visit.field({"distance_step", "length", "Width of the distance bins.", bounds::length},
              p.pairs.distance_step);
}

void validate_analysis(const DisplacementOptions& p) {
  const Rules rules("analysis");
  for (const double n : p.orders)
    rules.require(n == std::floor(n), "orders",
                  fmt::format("has {}, but must hold whole numbers from 1 to 100", show(n)));
  for (std::size_t k = 1; k < p.orders.size(); ++k)
    rules.require(p.orders[k] > p.orders[k - 1], "orders", "must hold increasing numbers");
  for (std::size_t k = 1; k < p.waiting_times.size(); ++k)
    rules.require(p.waiting_times[k] > p.waiting_times[k - 1], "waiting_times",
                  "must hold increasing times");
}

void validate_structure(const StructureOptions& p) {
  const Rules rules("analysis.structure");
  const auto steps = [&](double longest, double step, const char* longest_key,
                         const char* step_key) {
    rules.require(step <= longest && longest / step <= 1e4, step_key,
                  fmt::format("is {}, but must lie between {} and {} = {}, a ten-thousandth of it "
                              "and all of it",
                              show(step), show(longest / 1e4), longest_key, show(longest)));
  };
  steps(p.shells.wave_number_max, p.shells.wave_number_step, "wave_number_max", "wave_number_step");
  steps(p.pairs.distance_max, p.pairs.distance_step, "distance_max", "distance_step");
}

void describe_published(PublishedResult& p, FieldVisitor& visit) {
  visit.field({"source", "", "The publication, as legends name it."}, p.source);
  visit.field({"quantity", "",
               "The column of the table of jobs with which the results are compared, for example "
               "wall_seconds."},
              p.quantity);
  visit.field({"values", "as the quantity",
               "One for each step of [sweep.together], or without that, for each value of the "
               "first key of [sweep.grid].",
               bounds::any},
              p.values);
  visit.optional({"exponent",
                  "",
                  "Instead of values: the power of the abscissa with which the quantity grows.",
                  {-100, 100}},
                 p.exponent, 1.5);
  visit.optional({"from", "as the abscissa", "The exponent holds from here.", bounds::any}, p.from,
                 1.0);
  visit.optional({"to", "as the abscissa", "The exponent holds up to here.", bounds::any}, p.to,
                 10.0);
}

std::size_t SweepParameters::first_axis_steps() const {
  const ParameterGrid& first = together.empty() ? grid : together;
  return first.empty() ? 1 : first.front().second.size();
}

void validate_published(const PublishedResult& p, std::size_t steps, const std::string& path) {
  const Rules rules(path);
  const std::vector<std::string> known = jobs_quantities();
  rules.require(!p.source.empty(), "source", "is missing; name the publication");
  rules.require(
      std::ranges::count(known, p.quantity) > 0, "quantity",
      fmt::format("is \"{}\", but must be one of {}", p.quantity, fmt::join(known, ", ")));
  rules.require(p.values.empty() == p.exponent.has_value(), "values",
                "excludes exponent; give one of the two");
  rules.require(p.exponent || p.values.size() == steps, "values",
                fmt::format("has {} number(s), but must have {}, one for each step of the first "
                            "axis of the sweep",
                            p.values.size(), steps));
}

void validate_sweep(const SweepParameters& p) {
  std::set<std::string> keys;
  for (const auto& [table, grid] :
       {std::pair("sweep.together.", &p.together), {"sweep.grid.", &p.grid}})
    for (const auto& [key, values] : *grid)
      if (!keys.insert(key).second)
        throw BadValue(table + key,
                       "stands twice in [sweep.grid] and [sweep.together]; leave one out");
  for (const auto& [key, chosen] : {std::pair("sweep.ladder", p.ladder), {"sweep.axis", p.axis}})
    if (chosen && !keys.contains(*chosen))
      throw BadValue(key, fmt::format("is \"{}\", but must be a key of [sweep.grid] or "
                                      "[sweep.together]",
                                      *chosen));
  for (const auto& [key, values] : p.together) {
    const auto& [first, wanted] = p.together.front();
    if (values.size() != wanted.size())
      throw BadValue(
          "sweep.together." + key,
          fmt::format("has {} value(s), but '{}' has {}; the keys of [sweep.together] advance "
                      "together and need as many values each",
                      values.size(), first, wanted.size()));
  }
  for (std::size_t k = 0; k < p.published.size(); ++k)
    validate_published(p.published[k], p.first_axis_steps(), fmt::format("sweep.published.{}", k));
}

}  // namespace vitrel
