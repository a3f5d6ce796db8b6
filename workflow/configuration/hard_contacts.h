#pragma once

#include <string>

#include "edmd/contact_law.h"
#include "workflow/configuration/parameters.h"

/// @file
/// The contact laws of hard particles in a run, from the parameters.
namespace vitrel {

/// The laws between the species, in the order that the parameters and the configuration share.
ContactLaws contact_laws(const Parameters& parameters);

/// Whether any contact is rough.
Contacts contacts_of(const DynamicsParameters& dynamics);

/// Describes the laws of contact and the driving in lines of text. The text is empty for elastic and smooth contacts
/// of particles that nothing drives.
std::string hard_contact_text(const DynamicsParameters& dynamics);

/// Whether all contacts have the same constant coefficient of restitution below 1, and no friction.
bool has_constant_restitution(const DynamicsParameters& dynamics);
/// Whether no law depends on the speed, so that a gas cools by Haff's law.
bool cools_by_haff(const DynamicsParameters& dynamics);
/// Whether contacts can dissipate energy.
bool is_dissipative(const DynamicsParameters& dynamics);

}  // namespace vitrel
