#include "analysis/observables/observable.h"

#include <algorithm>
#include <iterator>

#include "analysis/observables/dynamics_tables.h"
#include "analysis/observables/energy_tables.h"
#include "analysis/observables/frame_observable.h"

namespace vitrel {
namespace {

void append(std::vector<Observable>& all, std::vector<Observable> more) {
  std::ranges::move(more, std::back_inserter(all));
}

}  // namespace

const Observable* find(const std::vector<Observable>& all, std::string_view table) {
  // A group of one may be the name of another: orientation_distribution.
  for (const bool groups : {false, true})
    for (const Observable& observable : all)
      if (observable.has_groups == groups &&
          (groups ? table.starts_with(observable.table + "_") : table == observable.table))
        return &observable;
  return nullptr;
}

std::vector<Observable> observables(int dimension) {
  std::vector<Observable> all = {
      {.table = "summary",
       .what =
           "One row: packing fraction, and averages over the run, of the compressibility factor, "
           "energies and diffusion coefficients."}};
  append(all, dynamics_observables(dimension));
  append(all, energy_observables());
  append(all, dimension == 2 ? frame_observables<2>() : frame_observables<3>());
  append(all, {{.table = "on_the_fly",
                .what = "The same correlations, measured while the run went on "
                        "(output.correlations).",
                .has_groups = true},
               {.table = "relaxation_times",
                .what = "When correlations have fallen to 1/e, or bounds of that time.",
                .needs = {.motion = true}},
               {.table = "relaxation",
                .what = "One row: relaxation times, nematic order, and whether the run was long "
                        "enough.",
                .needs = {.motion = true}}});
  return all;
}

}  // namespace vitrel
