#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/results.h"
#include "workflow/configuration/soft_particles.h"

/// @file
/// One impact of two soft spheres of a material (edmd/soft/restitution.h), integrated and from the table that a run
/// uses.
namespace vitrel {

/// Where an impact comes from. Empty texts are not given.
struct ImpactSource {
  std::filesystem::path file;  ///< parameter file with [dynamics.contact]; empty: the defaults
  std::vector<std::string> overrides;  ///< each "key=value", of [dynamics.contact]
  std::string speed, impact_parameter, second_radius;
};

struct Impact {
  ContactParameters contact;
  double speed = 0;             ///< of the relative velocity, m/s
  double impact_parameter = 0;  ///< over the sum of the radii; 0: head-on, 1: grazing
  double second_radius = 0;     ///< m, of the same density as the first

  /// In SI units.
  ContactPair pair() const;
  ContactScales scales() const;
  ScaledImpact scaled() const;
  /// √(1 − b²) times the speed.
  double normal_speed() const;
};

/// Reads and validates. Without a speed that of the parameters (thermal_speed), without a second radius the first.
/// Throws UserError or FileError.
Impact load_impact(const ImpactSource& source);
/// UserError if the speed, the impact parameter or the second radius is impossible.
void validate(const Impact& impact);

/// ε_r, ε_φ, ε_t and ε_ṙ by integration.
Restitution integrated(const Impact& impact);

/// The table of a run of particles of these two kinds.
RestitutionTable table_of(const Impact& impact, const Log& log);

/// The tabulated coefficients of this pair on a lattice of 100 relative speeds and 100 impact parameters b, evenly spaced
/// in ln v and ln(b/√(1 − b²)) over the ranges of the table; NaN where it has no value.
Table coefficients_on_lattice(const Impact& impact, const RestitutionTable& table);

/// All values as TOML text.
std::string impact_text(const Impact& impact);

}  // namespace vitrel
