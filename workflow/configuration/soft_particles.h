#pragma once

#include <compare>
#include <memory>
#include <set>
#include <string>

#include "core/state/configuration.h"
#include "edmd/soft/soft_contact.h"
#include "workflow/configuration/parameters.h"
#include "workflow/log.h"

/// @file
/// From the parameters of soft particles to their contacts in a run.
namespace vitrel {

class RestitutionTable;

/// Contacts that coefficients can be had of: c_dis at most, l/X at least. Beyond, nothing is left of the speed, or the
/// particles pass through each other.
inline constexpr double max_scaled_damping = 1e5, min_scaled_distance = 0.01;

/// What the units of the run are in SI units.
struct UnitsOfRun {
  double length;  ///< m: the radius of a particle of size 1
  double mass;    ///< kg: its mass
  double time;    ///< s: length over thermal speed
};
UnitsOfRun units_of_run(const ContactParameters& parameters);

/// The scales of an impact of two particles of size 1 that meet head-on at the thermal speed.
ContactScales thermal_scales(const ContactParameters& parameters);

/// The same at any speed, m/s, of any pair in SI units.
ContactScales contact_scales(const ContactParameters& parameters, const ContactPair& pair,
                             double speed);
ForceForm form_of_law(const ContactParameters& parameters);
/// F_n in N, as of contact_force.h.
double contact_force(const ContactParameters& parameters, const ContactPair& pair,
                     double compression, double rate);

/// The law, the units, and what becomes of two particles of size 1 that meet head-on at the thermal
/// speed, in lines for a person.
std::string contact_text(const ContactParameters& parameters);

/// As those of all, but of this material.
ContactParameters of_material(const ContactParameters& all, const MaterialParameters& material);

/// In units of the run.
struct KindOfSphere {
  double radius, mass;

  auto operator<=>(const KindOfSphere&) const = default;
};

/// The relative speeds that a table covers, in thermal speeds: beyond are 10⁻⁹ of the impacts of a gas, and those of
/// one that has cooled for long.
inline constexpr double slowest_tabulated = 1e-5, fastest_tabulated = 20;

/// The coefficients of all pairs of these kinds. The table is kept in $XDG_CACHE_HOME/vitrel (~/.cache/vitrel) and
/// made if it is not there; `log` gets a line if so. Its tolerance is 1e-8, or 1e-6 if pairs damp differently and
/// there is one more variable.
RestitutionTable restitution_table(const ContactParameters& parameters,
                                   const std::set<KindOfSphere>& kinds, int threads,
                                   const Log& log);

/// For particles of these radii and masses, by such a table unless all contacts are integrated; where materials differ,
/// by a table for each pair of species. Of parameters with [dynamics.contact].
template <int Dim>
PairsOfSpecies<std::shared_ptr<SoftContact>> soft_contact(const Parameters& parameters,
                                                          const Configuration<Dim>& configuration,
                                                          int threads, const Log& log);

}  // namespace vitrel
