#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/state/configuration.h"
#include "workflow/configuration/distributions.h"
#include "workflow/configuration/parameters.h"

/// @file
/// Comparison of parameters with the particles of the state from which a run starts.
namespace vitrel {

struct SpeciesConflict {
  std::string key;        ///< dotted, for example "species.0.size"
  std::string complaint;  ///< completes "key …"
};

/// Returns the first contradiction between species and particles in names, counts per species, aspect ratios, sizes,
/// semi-axes and masses. Constants must agree to a relative 1e-9, or to the digits given; drawn values must lie
/// within the bounds of their distribution. The result does not depend on the packing fraction, because every stage
/// of a preparation keeps the shapes and scales the box.
template <int Dim>
std::optional<SpeciesConflict> species_conflict(const std::vector<Species>& species,
                                                const Configuration<Dim>& state,
                                                Agreement agreement = Agreement::rounding);

/// The origin of a state.
struct StateOrigin {
  std::string file;        ///< for messages
  std::string parameters;  ///< recorded in the file, as TOML; may be empty
};

/// Throws UserError with the place of the key if there is a conflict with the state in `file`.
void refuse(const std::optional<SpeciesConflict>& conflict, const Parameters& parameters,
            const std::string& file);

/// Replaces the species and the box aspect by those of the state. They are taken as recorded if the record agrees
/// with the particles; otherwise as given, if the given ones agree up to rounding; otherwise from the particles, with
/// ranges of semi-axes that differ. Throws UserError with the place of the key if a value that the parameters give
/// (Parameters::given) contradicts the state in the digits given.
template <int Dim>
void take_species(Parameters& parameters, const Configuration<Dim>& state,
                  const StateOrigin& origin);

}  // namespace vitrel
