#pragma once

#include "core/io/foreign/foreign_frame.h"
#include "core/io/h5md.h"
#include "core/state/configuration.h"
#include "workflow/configuration/parameters.h"
#include "workflow/log.h"

/// @file
/// States that a preparation or a run starts from (stages/state_stage.h).
namespace vitrel {

/// What the parameters say that a file may lack: the dimension if it is given, the box of the stage, and species whose
/// particles are all alike.
KnownSystem known_system(const Parameters& parameters);

/// The dimension of the state to start from.
int start_dimension(const Parameters& parameters);

/// The state to start from. Dimension, number, box and species of `parameters` become its own, and, unless a stage
/// changes it, the packing fraction. What the parameters give must agree with it in the digits given; otherwise UserError,
/// with the place of the key. FileError if the file is unreadable; InvariantError if particles overlap, unless they are
/// to be shrunk, or `overlaps_allowed`.
template <int Dim>
Configuration<Dim> read_start(Parameters& parameters, bool overlaps_allowed, const Log& log);

/// The same for the state of a checkpoint of that work. If it may have been shrunk, nothing needs to agree. `recorded`:
/// its parameters, TOML.
template <int Dim>
void take_system(Parameters& parameters, const Configuration<Dim>& state, const std::string& file,
                 const std::string& recorded);

}  // namespace vitrel
