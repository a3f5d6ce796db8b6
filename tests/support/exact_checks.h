#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "core/contact/ellipse_vieillard_baron.h"
#include "core/contact/ellipsoid_eta.h"
#include "core/state/check.h"
#include "core/state/exact_pair.h"
#include "tests/support/solids.h"

/// What the tests of the exact check share in two and three dimensions.
namespace vitrel {

template <int Dim>
Configuration<Dim> empty_box(const Vec<Dim>& lengths) {
  Configuration<Dim> configuration;
  configuration.box = PeriodicBox<Dim>(lengths);
  return configuration;
}

template <int Dim>
Orientation<Dim> random_turn(Stream& draw) {
  if constexpr (Dim == 2)
    return draw.uniform(-9, 9);
  else
    return random_orientation(draw);
}

inline void turn(Configuration2& state, std::size_t i, double angle) {
  state.angle[i] = angle;
}
inline void turn(Configuration3& state, std::size_t i, const Quaternion& orientation) {
  state.orientation[i] = orientation;
}

/// Returns whether the bodies are disjoint or touch, by the signs of the characteristic polynomial
/// in the arithmetic of the particles.
template <int Dim, class Real>
bool apart_by_criterion(const exact::Particle<Dim, Real>& one,
                        const exact::Particle<Dim, Real>& two, const exact::Point<Dim, Real>& d) {
  if constexpr (Dim == 2)
    return vieillard_baron<Real>(one.axes, two.axes, d.x(), d.y()).disjoint_or_touching();
  else
    return ellipsoid_eta<Real>(one.axes, two.axes, d).disjoint_or_touching();
}

/// By all pairs and by cells.
template <int Dim>
void expect_one_overlap(const Configuration<Dim>& configuration, std::size_t i, std::size_t j,
                        const Shift<Dim>& shift) {
  for (std::size_t limit : {10'000, 0}) {
    const ExactCheck<Dim> check = exact_check(configuration, limit);
    EXPECT_FALSE(check.clean());
    ASSERT_EQ(check.overlaps.size(), 1u);
    EXPECT_EQ(check.overlaps[0].i, i);
    EXPECT_EQ(check.overlaps[0].j, j);
    EXPECT_EQ(check.overlaps[0].shift, shift);
    EXPECT_LT(check.smallest_gap, 0);
  }
}

template <int Dim>
void expect_equal(const ExactCheck<Dim>& one, const ExactCheck<Dim>& two) {
  EXPECT_EQ(one.pairs_examined, two.pairs_examined);
  EXPECT_EQ(one.smallest_gap, two.smallest_gap);
  ASSERT_EQ(one.overlaps.size(), two.overlaps.size());
  for (std::size_t k = 0; k < one.overlaps.size(); ++k) {
    EXPECT_EQ(one.overlaps[k].i, two.overlaps[k].i);
    EXPECT_EQ(one.overlaps[k].j, two.overlaps[k].j);
    EXPECT_EQ(one.overlaps[k].shift, two.overlaps[k].shift);
  }
}

/// All shifts of up to `boxes` box lengths in any direction, in ascending order.
template <int Dim>
std::vector<Shift<Dim>> all_shifts(int boxes) {
  std::vector<Shift<Dim>> shifts{Shift<Dim>::Zero()};
  for (int k = 0; k < Dim; ++k) {
    std::vector<Shift<Dim>> longer;
    for (Shift<Dim> shift : shifts)
      for (shift[k] = -boxes; shift[k] <= boxes; ++shift[k]) longer.push_back(shift);
    shifts = longer;
  }
  return shifts;
}

/// That `check` lists exactly the pairs and images whose gap(i, j, d) is not positive, by a plain scan of
/// the images up to `boxes` box lengths; returns how many there are.
template <int Dim, class Gap>
std::size_t expect_overlaps_of_a_scan(const Configuration<Dim>& state, const ExactCheck<Dim>& check,
                                      int boxes, Gap&& gap) {
  std::size_t found = 0;
  const std::vector<Shift<Dim>> shifts = all_shifts<Dim>(boxes);
  for (std::size_t i = 0; i < state.size(); ++i) {
    for (std::size_t j = i; j < state.size(); ++j) {
      for (const Shift<Dim>& shift : shifts) {
        if (i == j && !is_positive_shift<Dim>(shift)) continue;
        const Vec<Dim> d = state.position[j] - state.position[i] + state.box.translation(shift);
        if (gap(i, j, d) > 0) continue;
        const std::size_t k = found++;
        if (k >= check.overlaps.size()) continue;
        EXPECT_EQ(check.overlaps[k].i, i);
        EXPECT_EQ(check.overlaps[k].j, j);
        EXPECT_EQ(check.overlaps[k].shift, shift);
      }
    }
  }
  EXPECT_EQ(found, check.overlaps.size());
  return found;
}

}  // namespace vitrel
