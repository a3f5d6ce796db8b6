#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/contact/contact_queries.h"
#include "core/random/stream.h"
#include "core/state/configuration.h"
#include "tests/support/scenes.h"

/// A gas whose hard states can be drawn independently, to compare with those that a Monte Carlo method
/// visits.
namespace vitrel {

/// Sixteen long ellipses in a box of four domains, thin enough to be drawn all at once at random.
inline Configuration2 thin_gas() {
  Configuration2 c;
  c.resize(16);
  for (Ellipse& shape : c.shape) shape = of_aspect_ratio(3);
  c.box = PeriodicBox<2>(Vec2(28, 28));
  return c;
}

/// What is measured of a state: pairs closer than two thirds of the longest reach, how parallel they are, and the
/// particles within a tenth of a cell's width of a line between cells.
inline std::array<double, 3> measured(const Configuration2& c) {
  std::array<double, 3> sums{};
  for (std::size_t i = 0; i < c.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      Vec2 d = c.position[j] - c.position[i];
      d += c.box.translation(c.box.nearest_shift(d));
      if (d.norm() > 2.4) continue;
      sums[0] += 1;
      sums[1] += std::cos(2 * (c.angle[i] - c.angle[j]));
    }
  for (const Vec2& position : c.position) {
    const double cells = 8 * (position.x() / c.box.lengths().x() + 0.5);
    sums[2] += std::abs(cells - std::round(cells)) < 0.1;
  }
  return sums;
}

inline bool is_hard(const Configuration2& c) {
  for (std::size_t i = 0; i < c.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      Vec2 d = c.position[j] - c.position[i];
      d += c.box.translation(c.box.nearest_shift(d));
      if (!separated(c.shape[i], c.pose(i), c.shape[j], c.pose(j), d, 0)) return false;
    }
  return true;
}

/// `measured` of hard states of the thin gas, each drawn with all particles at once at random until it is
/// hard. The last is left in `c`.
inline std::array<std::vector<double>, 3> independent_states(Configuration2& c, int count) {
  Stream draw(17, Purpose::tests);
  std::array<std::vector<double>, 3> values;
  for (int k = 0; k < count; ++k) {
    do {
      for (std::size_t i = 0; i < c.size(); ++i) {
        c.position[i] = {draw.uniform(-14, 14), draw.uniform(-14, 14)};
        c.angle[i] = draw.uniform(0, std::numbers::pi);
      }
    } while (!is_hard(c));
    const auto one = measured(c);
    for (std::size_t m = 0; m < 3; ++m) values[m].push_back(one[m]);
  }
  return values;
}

}  // namespace vitrel
