#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "analysis/statistics/blocking.h"
#include "core/state/check.h"
#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "edmd/growth.h"
#include "mc/sweep_state.h"
#include "workflow/configuration/parameters.h"

/// From parameters to a first state: particles are drawn, then the stages of [prepare] run in a
/// row.
namespace vitrel {

struct PrepareRequest {
  Parameters parameters;
  /// Of the command: a checkpoint is kept beside it, <output>.preparation, from which the same request
  /// goes on, and a state that is stuck goes to <output>.stuck.h5. Empty: nothing is written.
  std::filesystem::path output = {};
  std::string command_line = {};  ///< for the provenance
  int threads = 1;                ///< of Monte Carlo; the result does not depend on it
};

/// What one stage did.
struct StageRecord {
  StageReport report;
  double packing_fraction = 0;                 ///< at its end
  Estimate mean_packing_fraction = {0, 0, 0};  ///< second half of a compression without such a goal
  std::uint64_t sweeps = 0;
  std::uint64_t chain_contacts = 0;  ///< of event chains
  TrialCounts trials;
  GrowthState growth;  ///< of growth and hybrid; its counters are 0 elsewhere
  double wall_seconds = 0;
};

template <int Dim>
struct Preparation {
  Configuration<Dim> configuration;  ///< at rest, without overlaps
  bool complete = false;             ///< else stopped by the run control
  std::vector<StageRecord> stages;
  ExactCheck<Dim> check;         ///< of the state, if complete; without overlaps
  std::uint64_t next_sweep = 0;  ///< Monte Carlo after it goes on with these numbers
  double wall_seconds = 0;       ///< of all processes that worked on it

  TrialCounts trials() const;
};

/// For parameters of that dimension. `say` gets a line at the start of every stage and one about its end. The result is the same, bit by bit,
/// however often the preparation was stopped or killed. Throws UserError if a stage cannot reach its goal
/// (too dense a lattice or insertion, too few sweeps, jammed), or if the checkpoint belongs to other
/// parameters, and InvariantError if the exact check finds an overlap at the end.
template <int Dim = 2>
Preparation<Dim> prepare(const PrepareRequest& request, const RunControl& control,
                         const std::function<void(const std::string&)>& say);

/// Removes the checkpoint, once what comes after the preparation is safely on disk.
void forget_preparation(const std::filesystem::path& output);

}  // namespace vitrel
