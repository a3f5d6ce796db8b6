#pragma once

#include <cmath>
#include <memory>
#include <numbers>

#include "core/random/stream.h"
#include "core/state/configuration.h"
#include "edmd/options.h"
#include "edmd/soft/restitution_table.h"
#include "edmd/soft/soft_contact.h"

/// Soft particles in SI units, of the material of mueller2013.
namespace vitrel {

/// Of density 1140 kg/m³.
inline double sphere_mass(double radius) {
  return 1140 * 4 * std::numbers::pi / 3 * std::pow(radius, 3);
}

/// Gives round particles the masses of spheres and velocities of about 2 m/s.
template <int Dim>
void set_in_motion(Configuration<Dim>& c, std::uint64_t seed) {
  Stream draw(seed, Purpose::tests);
  for (std::size_t i = 0; i < c.size(); ++i) {
    c.mass[i] = sphere_mass(c.shape[i].circumradius());
    for (double& component : c.velocity[i]) component = 1.2 * draw.normal();
  }
}

/// Contacts whose coefficients are integrated, not tabulated.
template <ContactForce Force>
std::shared_ptr<SoftContact> integrated_contact(const Force& force) {
  return std::make_shared<SoftContactOf<Force, IntegratedRestitution>>(
      force, IntegratedRestitution(form_of<Force>()));
}

}  // namespace vitrel
