#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/results.h"
#include "workflow/configuration/soft_particles.h"

/// @file
/// The impact of two soft spheres of one material (edmd/soft/restitution.h), by integration and by the table that a
/// run uses.
namespace vitrel {

/// Where an impact comes from. An empty text means that the value is not given.
struct ImpactSource {
  std::filesystem::path file;  ///< a parameter file with [dynamics.contact]; the defaults if empty
  std::vector<std::string> overrides;  ///< "key=value" for keys of [dynamics.contact]
  std::string speed, impact_parameter, second_radius;
};

struct Impact {
  ContactParameters contact;
  double speed = 0;             ///< of the relative velocity, in m/s
  double impact_parameter = 0;  ///< over the sum of the radii; 0: head-on, 1: grazing
  double second_radius = 0;     ///< in m; the density is that of the first sphere

  /// Both spheres in SI units.
  ContactPair pair() const;
  ContactScales scales() const;
  ScaledImpact scaled() const;
  /// The normal component of the relative velocity, √(1 − b²) times the speed.
  double normal_speed() const;
};

/// Reads and validates an impact. The speed defaults to that of the parameters (thermal_speed), the second radius to
/// the first. Throws UserError or FileError.
Impact load_impact(const ImpactSource& source);
/// Throws UserError if the speed, the impact parameter or the second radius is impossible.
void validate(const Impact& impact);

/// The coefficients ε_r, ε_φ, ε_t and ε_ṙ by integration of the impact.
Restitution integrated(const Impact& impact);

/// The table of coefficients that a run of particles of these two kinds uses.
RestitutionTable table_of(const Impact& impact, const Log& log);

/// The tabulated coefficients of this pair on a lattice of 100 relative speeds and 100 impact parameters b, evenly
/// spaced in ln v and ln(b/√(1 − b²)) over the ranges of the table. They are NaN where the table has no value.
Table coefficients_on_lattice(const Impact& impact, const RestitutionTable& table);

/// All values as TOML.
std::string impact_text(const Impact& impact);

}  // namespace vitrel
