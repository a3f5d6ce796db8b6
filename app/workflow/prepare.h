#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/workflow/parameters.h"
#include "core/state/check.h"
#include "core/state/configuration.h"
#include "core/state/stage.h"

/// From parameters to a first state: particles are drawn, then the stages of [prepare] run in a
/// row.
namespace vitrel {

struct Preparation {
  Configuration2 configuration;  ///< at rest, without overlaps
  StageReport report;            ///< counts of all stages together; `stopped` if the budget said so
  std::vector<GrowthReport> growth;  ///< one for every stage that grows
  ExactCheck check;                  ///< of the state, if not stopped; without overlaps
  std::uint64_t next_sweep = 0;      ///< Monte Carlo after it goes on with these numbers
  double wall_seconds = 0;
};

/// `say` gets a line at the start of every stage. The result does not depend on the number of threads, on
/// which Monte Carlo runs. Throws UserError if a stage cannot reach its goal
/// (too dense a lattice or insertion, too few sweeps), and InvariantError if the exact check finds
/// an overlap at the end. A stopped preparation cannot be continued: the same seed makes it anew.
Preparation prepare(const Parameters& parameters, const Budget& budget,
                    const std::function<void(const std::string&)>& say, int threads = 1);

}  // namespace vitrel
