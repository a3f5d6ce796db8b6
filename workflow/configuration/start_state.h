#pragma once

#include "core/io/foreign/foreign_frame.h"
#include "core/io/h5md.h"
#include "core/state/configuration.h"
#include "workflow/configuration/parameters.h"
#include "workflow/log.h"

/// @file
/// States from which a preparation or a run starts (stages/state_stage.h).
namespace vitrel {

/// What the parameters know about a system that a file may not state: the dimension if it is given, the box of the
/// import or of the stage, and species with a single shape.
KnownSystem known_system(const Parameters& parameters);

/// The dimension of the state from which the preparation or run starts.
int start_dimension(const Parameters& parameters);

/// Reads the state to start from. The dimension, number, box and species of `parameters` become those of the state,
/// and so does the packing fraction unless a stage changes it. Values that the parameters give must agree with the
/// state in the digits given; if not, throws UserError with the place of the key. Throws FileError if the file is
/// unreadable, and InvariantError if particles overlap, unless they are to be shrunk, or overlaps are allowed and no
/// stage follows.
template <int Dim>
Configuration<Dim> read_start(Parameters& parameters, bool overlaps_allowed, const Log& log);

/// Takes the system of `parameters` from the state of a checkpoint in the same way. If that state may have been
/// shrunk, nothing needs to agree with it. `recorded` are the parameters of the checkpoint as TOML.
template <int Dim>
void take_system(Parameters& parameters, const Configuration<Dim>& state, const std::string& file,
                 const std::string& recorded);

}  // namespace vitrel
