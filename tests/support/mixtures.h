#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <vector>

#include "core/state/species.h"
#include "mc/insertion.h"

/// Mixtures that every Monte Carlo method must be able to move: shapes and sizes of all kinds, and boxes
/// in which particles meet several images of each other.
namespace vitrel {

struct Mixture {
  const char* name;
  std::size_t particles;
  double packing_fraction;
  std::vector<Species> species;
  double box_aspect = 1;
};
inline void PrintTo(const Mixture& mixture, std::ostream* out) {
  *out << mixture.name;
}

inline Species species_of(double fraction, const Distribution& aspect_ratio,
                          const Distribution& size) {
  Species kind;
  kind.fraction = fraction;
  kind.aspect_ratio = aspect_ratio;
  kind.size = size;
  return kind;
}
inline Distribution always(double value) {
  return {.mean = value};
}
inline Distribution between(double low, double high) {
  return {.kind = Distribution::Kind::uniform, .low = low, .high = high};
}

inline std::vector<Mixture> mixtures() {
  const auto all = [](double kappa) {
    return std::vector{species_of(1, always(kappa), always(1))};
  };
  return {{"disks", 300, 0.5, all(1)},
          {"nearly round", 300, 0.5, all(1.1)},
          {"kappa 3", 600, 0.4, all(3)},
          {"kappa 10", 400, 0.3, all(10)},
          {"sizes 1:5, round and long",
           500,
           0.4,
           {species_of(0.9, always(4), always(1)), species_of(0.1, always(1), always(5))}},
          {"many shapes and sizes", 400, 0.4, {species_of(1, between(1, 8), between(0.3, 3))}},
          {"one, among its images", 1, 0.4, all(6)},
          {"two, among their images", 2, 0.4, all(6)},
          {"five, in a flat box", 5, 0.3, all(4), 0.2},
          {"fifty, in a flat box", 50, 0.3, all(3), 0.05}};
}

inline Configuration2 inserted_mixture(const Mixture& m) {
  Configuration2 c =
      draw_particles<2>(m.species, m.particles, m.packing_fraction, Vec2(1, m.box_aspect), 1);
  const StageReport report = insert_particles(c, {m.packing_fraction, 1'000'000, false}, 1, {});
  EXPECT_EQ(report.end, StageEnd::reached);
  return c;
}

}  // namespace vitrel
