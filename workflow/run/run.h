#pragma once

#include <filesystem>
#include <string>

#include "core/io/json.h"
#include "core/state/observer.h"
#include "core/state/stage.h"
#include "edmd/run.h"
#include "workflow/configuration/parameters.h"
#include "workflow/log.h"

/// @file
/// The event-driven run with its files. The trajectory run.h5 has a checkpoint run.h5.checkpoint beside it, and
/// run.h5.correlations.h5 if the run correlates on the fly. The same request starts the run, continues it, or finds
/// it complete. A run that was killed at any moment and continued has datasets that are bit-identical to those of an
/// uninterrupted run.
///
///     const RunOutcome<2> outcome = run_simulation<2>({parameters, "run.h5"}, {}, {});
namespace vitrel {

struct RunRequest {
  Parameters parameters;
  std::filesystem::path output;
  std::string command_line = {};  ///< for the provenance
  int threads = 1;                ///< the results do not depend on it
};

/// The dimension of the run: that of its checkpoint if it was begun, else that of its start.
int run_dimension(const RunRequest& request);

/// Says in lines of text what the request would do, and writes nothing. Throws as run_simulation does if the state to
/// start from, or the run to continue, is not usable.
std::string run_plan(RunRequest request);

template <int Dim>
struct RunOutcome {
  bool complete = false;      ///< false if the run control stopped it; the same request continues
  bool was_complete = false;  ///< nothing was left to do
  RunState<Dim> state;
  std::size_t overlaps = 0;  ///< overlapping pairs of the last state
  double wall_seconds = 0;   ///< spent by all processes that worked on the run
};

/// Runs or continues the simulation. The parameters must be valid and of dimension Dim. `log` receives a line about
/// every step. `observer`, unless it is null, receives every frame that the run writes from here on; if it throws,
/// the run ends at its last checkpoint. Throws
/// - UserError if the output exists but is no run that can be continued, if it belongs to other parameters, or if the
///   state to start from does not fit them;
/// - FileError if a file cannot be read or written; the run continues from its last checkpoint once the cause is
///   removed;
/// - InvariantError on an overlap or a standstill; the state is then in `<output>.failed.h5`.
template <int Dim>
RunOutcome<Dim> run_simulation(const RunRequest& request, const RunControl& control, const Log& log,
                               Observer<Dim>* observer = nullptr);

/// The results that `vitrel run --json` prints, from the trajectory and the last state of the run. Throws FileError
/// if the trajectory cannot be read.
template <int Dim>
Json run_summary(const RunRequest& request, const RunOutcome<Dim>& outcome);

}  // namespace vitrel
