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
/// Preparation of an initial state from parameters. Particles are drawn, or taken from a state; then the stages of
/// [prepare] follow each other.
///
///     const Preparation<2> preparation = prepare<2>({parameters, "state.h5"}, {}, {});
///     write_state("state.h5", preparation.configuration, provenance);
///     forget_preparation("state.h5");
namespace vitrel {

struct PrepareRequest {
  Parameters parameters;
  /// The file into which the caller will write the state; if it is empty, no files are written. The preparation keeps
  /// a checkpoint beside it, `<output>.preparation`, from which the same request continues. If a stage gets stuck,
  /// its state goes to `<output>.stuck.h5`.
  std::filesystem::path output = {};
  std::string command_line = {};  ///< for the provenance
  int threads = 1;                ///< for Monte Carlo; the result does not depend on it
  /// Whether a given state may have overlaps. They are allowed only if no other stage follows it.
  bool overlaps_allowed = false;
};

template <int Dim>
struct Preparation {
  /// Has no overlaps unless they are allowed, and is at rest unless it is a given state.
  Configuration<Dim> configuration;
  Parameters parameters;  ///< of the request, with the system and species of a given state
  bool complete = false;  ///< false if the run control stopped the preparation
  std::vector<StageRecord> stages;  ///< those that have ended
  ExactCheck<Dim> check;            ///< of the state, if complete
  std::uint64_t next_sweep = 0;     ///< later Monte Carlo continues the numbers of sweeps from here
  double wall_seconds = 0;          ///< spent by all processes that worked on it

  TrialCounts trials() const;
};

/// The dimension of the state to be prepared: that of the parameters or, if a state is given, that of the preparation
/// to continue or of the given state.
int prepared_dimension(const PrepareRequest& request);

/// Runs or continues the preparation. The parameters must be valid and of dimension Dim (prepared_dimension). `log`
/// receives a line at the start and at the end of every stage. The result is bit-identical however often the
/// preparation was stopped or killed, and on any number of threads. Throws
/// - UserError if a stage cannot reach its goal (too dense a lattice or insertion, too few sweeps, jammed), or if the
///   checkpoint belongs to other parameters;
/// - FileError if the checkpoint cannot be read or written;
/// - InvariantError if a given state has overlaps, or if the exact check finds one at the end.
template <int Dim = 2>
Preparation<Dim> prepare(const PrepareRequest& request, const RunControl& control, const Log& log);

/// Throws UserError if a preparation of this output was begun with other parameters.
template <int Dim>
void require_same_preparation(const PrepareRequest& request);

/// Removes the checkpoint. Call it once the result of the preparation is safely on disk.
void forget_preparation(const std::filesystem::path& output);

}  // namespace vitrel
