#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/state/configuration.h"
#include "workflow/configuration/distributions.h"
#include "workflow/configuration/parameters.h"

/// @file
/// Whether parameters describe the particles of a state that a run starts from.
namespace vitrel {

struct SpeciesConflict {
  std::string key;        ///< dotted: "species.0.size"
  std::string complaint;  ///< completes "key … "
};

/// The first contradiction between species and particles: names, counts per species, aspect ratios, sizes,
/// semi-axes and masses. Constants must agree to a relative 1e-9, or to the digits given; draws must lie within the
/// bounds of their distribution. Every stage of a preparation keeps the shapes and scales the box, so that this
/// holds at any packing fraction.
template <int Dim>
std::optional<SpeciesConflict> species_conflict(const std::vector<Species>& species,
                                                const Configuration<Dim>& state,
                                                Agreement agreement = Agreement::rounding);

/// Where a state comes from.
struct StateOrigin {
  std::string file;        ///< for messages
  std::string parameters;  ///< recorded there, TOML; may be empty
};

/// Throws UserError, with the place of the key, if there is a conflict with the state in that file.
void refuse(const std::optional<SpeciesConflict>& conflict, const Parameters& parameters,
            const std::string& file);

/// Replaces the species and the box aspect by those of the state: as recorded, if the record agrees with
/// the particles; otherwise as given, if that agrees to rounding; otherwise as the particles are, with ranges of their
/// semi-axes where they differ. UserError with the place of the key if what the parameters give (Parameters::given)
/// contradicts the state in the digits given.
template <int Dim>
void take_species(Parameters& parameters, const Configuration<Dim>& state,
                  const StateOrigin& origin);

}  // namespace vitrel
