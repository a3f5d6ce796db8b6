#pragma once

#include <string>

#include "edmd/contact_law.h"
#include "workflow/configuration/parameters.h"

/// @file
/// From the parameters of hard particles to the laws of their contacts in a run.
namespace vitrel {

/// The laws between the species, in the order of the parameters, which is that of the configuration.
ContactLaws contact_laws(const Parameters& parameters);

/// Whether any contact is rough.
Contacts contacts_of(const DynamicsParameters& dynamics);

/// The laws of a run of which these are the dynamics, in lines for a person; empty for elastic and smooth contacts of
/// particles that nothing drives.
std::string hard_contact_text(const DynamicsParameters& dynamics);

/// Whether all contacts have the same constant coefficient of restitution below 1, and no friction.
bool has_constant_restitution(const DynamicsParameters& dynamics);
/// Whether no law depends on the speed: a gas then cools by Haff's law.
bool cools_by_haff(const DynamicsParameters& dynamics);
/// Whether contacts can dissipate energy.
bool is_dissipative(const DynamicsParameters& dynamics);

}  // namespace vitrel
