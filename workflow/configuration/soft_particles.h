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
/// The contacts of soft particles in a run, from the parameters.
namespace vitrel {

class RestitutionTable;

/// Limits within which contacts have coefficients of restitution: the largest c_dis and the smallest l/X. Beyond
/// them, the impact leaves nothing of the speed, or the particles pass through each other.
inline constexpr double max_scaled_damping = 1e5, min_scaled_distance = 0.01;

/// The units of the run in SI units.
struct UnitsOfRun {
  double length;  ///< in m: the radius of a particle of size 1
  double mass;    ///< in kg: its mass
  double time;    ///< in s: length over thermal speed
};
UnitsOfRun units_of_run(const ContactParameters& parameters);

/// The scales of an impact of two particles of size 1 that meet head-on at the thermal speed.
ContactScales thermal_scales(const ContactParameters& parameters);

/// The scales of an impact of any pair, given in SI units, at any speed in m/s.
ContactScales contact_scales(const ContactParameters& parameters, const ContactPair& pair,
                             double speed);
ForceForm form_of_law(const ContactParameters& parameters);
/// The normal force F_n in N (contact_force.h).
double contact_force(const ContactParameters& parameters, const ContactPair& pair,
                     double compression, double rate);

/// Describes in lines of text the law, the units, and the result of a head-on impact of two particles of size 1 at
/// the thermal speed.
std::string contact_text(const ContactParameters& parameters);

/// The parameters for a material: those of all species, except for the values that the material gives.
ContactParameters of_material(const ContactParameters& all, const MaterialParameters& material);

/// Radius and mass of a sphere in units of the run.
struct KindOfSphere {
  double radius, mass;

  auto operator<=>(const KindOfSphere&) const = default;
};

/// The range of relative speeds that a table covers, in thermal speeds. Beyond it lie 10⁻⁹ of the impacts of a gas,
/// and the impacts of a gas that has cooled for long.
inline constexpr double slowest_tabulated = 1e-5, fastest_tabulated = 20;

/// The table of the coefficients of all pairs of these kinds. It is cached in $XDG_CACHE_HOME/vitrel
/// (~/.cache/vitrel). If it is not there, it is computed, and `log` receives a line. Its tolerance is 1e-8, or 1e-6
/// if pairs differ in their damping, which adds a variable.
RestitutionTable restitution_table(const ContactParameters& parameters,
                                   const std::set<KindOfSphere>& kinds, int threads,
                                   const Log& log);

/// The contacts of particles with these radii and masses: by a restitution_table, or integrated if the parameters say
/// so. If materials differ, there is a table for each pair of species. The parameters must have [dynamics.contact].
template <int Dim>
PairsOfSpecies<std::shared_ptr<SoftContact>> soft_contact(const Parameters& parameters,
                                                          const Configuration<Dim>& configuration,
                                                          int threads, const Log& log);

}  // namespace vitrel
