#pragma once

#include "tests/support/mixtures.h"

/// Mixtures in space that every Monte Carlo method must be able to move.
namespace vitrel {

struct MixtureInSpace {
  const char* name;
  std::size_t particles;
  double packing_fraction;
  std::vector<Species> species;
  Vec3 box = Vec3::Ones();
};
inline void PrintTo(const MixtureInSpace& mixture, std::ostream* out) {
  *out << mixture.name;
}

inline Species solids_of(double fraction, const Vec3& semi_axes) {
  Species kind;
  kind.fraction = fraction;
  kind.semi_axes = {always(semi_axes[0]), always(semi_axes[1]), always(semi_axes[2])};
  return kind;
}

inline std::vector<MixtureInSpace> mixtures_in_space() {
  const auto all = [](const Vec3& semi_axes) { return std::vector{solids_of(1, semi_axes)}; };
  const auto spread = species_of(1, between(1, 4), between(0.5, 1.5));
  return {
      {"spheres", 400, 0.3, all({1, 1, 1})},
      {"spheres of two sizes", 500, 0.3, {solids_of(0.5, {1, 1, 1}), solids_of(0.5, {2, 2, 2})}},
      {"prolate", 400, 0.25, all({3, 1, 1})},
      {"oblate", 400, 0.2, all({0.4, 1, 1})},
      {"scalene", 300, 0.2, all({2, 1, 0.5})},
      {"many shapes and sizes", 400, 0.2, {spread}},
      {"one, among its images", 1, 0.2, all({4, 1, 1})},
      {"two, among their images", 2, 0.2, all({4, 1, 1})},
      {"forty, in a flat box", 40, 0.15, all({3, 1, 1}), {1, 1, 0.15}}};
}

inline Configuration3 inserted_mixture(const MixtureInSpace& m) {
  Configuration3 c = draw_particles<3>(m.species, m.particles, m.packing_fraction, m.box, 1);
  const StageReport report = insert_particles(c, {m.packing_fraction, 1'000'000, false}, 1, {});
  EXPECT_EQ(report.end, StageEnd::reached);
  return c;
}

}  // namespace vitrel
