#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/state/check.h"
#include "core/state/configuration.h"
#include "core/state/stage.h"
#include "workflow/configuration/parameters.h"
#include "workflow/log.h"
#include "workflow/stages/stage_record.h"

/// @file
/// From parameters to a first state: particles are drawn, or taken from a state, then the stages of [prepare] follow each
/// other.
///
///     const Preparation<2> preparation = prepare<2>({parameters, "state.h5"}, {}, {});
///     write_state("state.h5", preparation.configuration, provenance);
///     forget_preparation("state.h5");
namespace vitrel {

struct PrepareRequest {
  Parameters parameters;
  /// Where the caller will write the state. A checkpoint is kept beside it, `<output>.preparation`, from which
  /// the same request continues; a state that is stuck goes to `<output>.stuck.h5`. Empty: no files.
  std::filesystem::path output = {};
  std::string command_line = {};  ///< for the provenance
  int threads = 1;                ///< of Monte Carlo; the result does not depend on it
  /// A given state may have overlaps, if no stage follows it.
  bool overlaps_allowed = false;
};

template <int Dim>
struct Preparation {
  /// Without overlaps, unless they are allowed; at rest, unless it is a given state.
  Configuration<Dim> configuration;
  Parameters parameters;  ///< of the request; of a given state with its system and species
  bool complete = false;  ///< else stopped by the run control
  std::vector<StageRecord> stages;  ///< those that have ended
  ExactCheck<Dim> check;            ///< of the state, if complete; without overlaps
  std::uint64_t next_sweep = 0;     ///< Monte Carlo after it goes on with these numbers
  double wall_seconds = 0;          ///< of all processes that worked on it

  TrialCounts trials() const;
};

/// The dimension of the state that is prepared: of the parameters, of a given state, or of a preparation to continue.
int prepared_dimension(const PrepareRequest& request);

/// For parameters that are valid and of that dimension (prepared_dimension). `log` gets a line at the start of every stage and
/// one about its end. The result is bit-identical however often the preparation was stopped or killed, and
/// on any number of threads. Throws
/// - UserError if a stage cannot reach its goal (too dense a lattice or insertion, too few sweeps, jammed),
///   or if the checkpoint belongs to other parameters;
/// - FileError if the checkpoint cannot be read or written;
/// - InvariantError if a given state has overlaps, or the exact check finds one at the end.
template <int Dim = 2>
Preparation<Dim> prepare(const PrepareRequest& request, const RunControl& control, const Log& log);

/// Removes the checkpoint, once what comes after the preparation is safely on disk.
void forget_preparation(const std::filesystem::path& output);

}  // namespace vitrel
