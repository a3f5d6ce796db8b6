#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/state/species.h"
#include "workflow/configuration/parameters.h"
#include "workflow/rules.h"

/// @file
/// The sections of the parameter file. Each has a function that describes its fields with their bounds, and one that
/// throws BadValue for values that do not suit each other.
namespace vitrel {

/// Binds `part` to the function `describe`, which describes its fields.
FieldVisitor::Inside section_of(auto& part, auto describe) {
  return [&part, describe](FieldVisitor& visit) { describe(part, visit); };
}

void describe_system(SystemParameters& p, FieldVisitor& visit);
/// Validates all but the packing fraction, whose bound depends on the species.
void validate_system(const SystemParameters& p);

void describe_species(Species& p, FieldVisitor& visit);
void validate_species(const std::vector<Species>& species, int dimension);
Species default_species();
/// Whether all particles of the species are disks or spheres.
bool is_round(const Species& p);

/// The packing fraction that no arrangement of these particles exceeds, as far as a bound is known:
///
/// - Ellipses of equal area A, whatever their aspect ratios: π/√12. Ellipses that do not overlap lie in as many
///   convex polygons that do not overlap and have six sides on average (fejestoth1950), and a polygon of n sides
///   around an ellipse has at least the area (A/π) n tan(π/n), which is convex in n.
/// - Equal spheres: π/√18 (hales2005).
/// - All others: 1. Small disks or spheres fill the holes between large ones, and crystals of ellipsoids are denser
///   than those of spheres: 0.7707 at the aspect ratio √3 (donev2004).
///
/// The species must be valid.
PackingBound packing_bound(const std::vector<Species>& species, int dimension);

struct SpeciesNameConflict {
  std::size_t species;    ///< the later one of the two
  std::string complaint;  ///< completes "its name …"
};

/// Tables and columns of results are named after species (identifier, results.h). Returns a conflict if two species
/// would share such a name, or if a species would take a name that is used otherwise.
std::optional<SpeciesNameConflict> species_name_conflict(const std::vector<std::string>& names);

/// Names of the values of FreeRotation in the parameter file.
inline constexpr const char* rotation_names[] = {"euler", "constant"};

void describe_dynamics(DynamicsParameters& p, FieldVisitor& visit);
/// Describes the contact laws of hard particles, and the driving.
void describe_collisions(DynamicsParameters& p, FieldVisitor& visit);
void validate_collisions(const Parameters& parameters);
void describe_contact(ContactParameters& p, FieldVisitor& visit);
void describe_materials(ContactParameters& p, FieldVisitor& visit);
void validate_times(const Parameters& parameters);
/// Validates the contact law of soft particles, together with the species and the dynamics, which must suit it.
void validate_contact(const Parameters& parameters);

void describe_output(OutputParameters& p, FieldVisitor& visit);
void validate_output(const Parameters& parameters);

void describe_import(ImportOptions& p, FieldVisitor& visit);
void validate_import(const ImportOptions& p);

void validate_choice(const std::string& tables);
void describe_analysis(DisplacementOptions& p, FieldVisitor& visit);
void validate_analysis(const DisplacementOptions& p);

void describe_structure(StructureOptions& p, FieldVisitor& visit);
void validate_structure(const StructureOptions& p);

void describe_published(PublishedResult& p, FieldVisitor& visit);
void validate_sweep(const SweepParameters& p);

}  // namespace vitrel
