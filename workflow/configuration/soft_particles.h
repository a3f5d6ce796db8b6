#pragma once

#include <memory>
#include <string>

#include "core/state/configuration.h"
#include "edmd/soft/soft_contact.h"
#include "workflow/configuration/parameters.h"
#include "workflow/log.h"

/// @file
/// From the parameters of soft particles to their contacts in a run.
namespace vitrel {

/// What the units of the run are in SI units.
struct UnitsOfRun {
  double length;  ///< m: the radius of a particle of size 1
  double mass;    ///< kg: its mass
  double time;    ///< s: length over thermal speed
};
UnitsOfRun units_of_run(const ContactParameters& parameters);

/// The scales of an impact of two particles of size 1 that meet head-on at the thermal speed.
ContactScales thermal_scales(const ContactParameters& parameters);

/// The law, the units, and what becomes of two particles of size 1 that meet head-on at the thermal
/// speed, in lines for a person.
std::string contact_text(const ContactParameters& parameters);

/// For particles of these radii and masses. A table covers relative speeds from 1e-5 to 20 thermal
/// speeds, is kept in $XDG_CACHE_HOME/vitrel (~/.cache/vitrel) and made if it is not there; `log` gets a
/// line if so. Its tolerance is 1e-8, or 1e-6 if pairs damp differently and there is one more variable.
template <int Dim>
std::shared_ptr<SoftContact> soft_contact(const ContactParameters& parameters,
                                          const Configuration<Dim>& configuration, int threads,
                                          const Log& log);

}  // namespace vitrel
