#pragma once

#include "workflow/configuration/parameters.h"
#include "workflow/rules.h"

/// @file
/// The sections of the parameter file. For each there is a function that names its fields with their bounds, and one
/// that throws BadValue for values that do not suit each other.
namespace vitrel {

/// The fields of `part`, as `describe` names them.
FieldVisitor::Inside section_of(auto& part, auto describe) {
  return [&part, describe](FieldVisitor& visit) { describe(part, visit); };
}

void describe_system(SystemParameters& p, FieldVisitor& visit);
/// But for the packing fraction, whose bound depends on the species.
void validate_system(const SystemParameters& p);

void describe_species(Species& p, FieldVisitor& visit);
void validate_species(const std::vector<Species>& species, int dimension);
Species default_species();
/// Whether all its particles are disks or spheres.
bool is_round(const Species& p);

/// The words for FreeRotation.
inline constexpr const char* rotation_names[] = {"euler", "constant"};

void describe_dynamics(DynamicsParameters& p, FieldVisitor& visit);
/// Of hard particles: their laws of contact and what drives them.
void describe_collisions(DynamicsParameters& p, FieldVisitor& visit);
void validate_collisions(const Parameters& parameters);
void describe_contact(ContactParameters& p, FieldVisitor& visit);
void describe_materials(ContactParameters& p, FieldVisitor& visit);
void validate_times(const Parameters& parameters);
/// Of soft particles, which the species and the dynamics must fit.
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
