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
/// The event-driven run with its files. The trajectory run.h5 has a checkpoint run.h5.checkpoint
/// beside it, and run.h5.correlations.h5 if the run correlates on the fly; the same request starts the
/// run, continues it, or finds it complete. The datasets of a run that was killed at any moment and continued
/// are bit-identical to those of one that was not.
///
///     const RunOutcome<2> outcome = run_simulation<2>({parameters, "run.h5"}, {}, {});
namespace vitrel {

struct RunRequest {
  Parameters parameters;
  std::filesystem::path output;
  std::string command_line = {};  ///< for the provenance
  int threads = 1;                ///< the results do not depend on it
};

/// The dimension of the run: of its checkpoint if it was begun, else of what it starts from.
int run_dimension(const RunRequest& request);

/// What the request would do, in lines for a person. Nothing is written. Throws like run for what is there
/// already: the state to start from, or the run to continue.
std::string run_plan(RunRequest request);

template <int Dim>
struct RunOutcome {
  bool complete = false;      ///< else stopped by the run control; the same request continues
  bool was_complete = false;  ///< nothing was left to do
  RunState<Dim> state;
  std::size_t overlaps = 0;  ///< pairs of the last state that overlap
  double wall_seconds = 0;   ///< of all processes that worked on the run
};

/// For parameters of that dimension, which must be valid. `log` gets a line about every step, and `observer`, if there is
/// one, every frame that the run writes from here on; what it throws ends the run at its last checkpoint. Throws
/// - UserError if the output exists but is no run that can be continued, belongs to other
///   parameters, or the state to start from does not fit them;
/// - FileError; the run continues from its last checkpoint once the cause is removed;
/// - InvariantError on an overlap or a standstill; the state is then in `<output>.failed.h5`.
template <int Dim>
RunOutcome<Dim> run_simulation(const RunRequest& request, const RunControl& control, const Log& log,
                               Observer<Dim>* observer = nullptr);

/// The figures of a run, from its trajectory and its last state: what `vitrel run --json` prints.
/// Throws FileError if the trajectory cannot be read.
template <int Dim>
Json run_summary(const RunRequest& request, const RunOutcome<Dim>& outcome);

}  // namespace vitrel
