#include "mc/place_correlation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random/stream.h"
#include "tests/support/mixtures_in_space.h"

namespace vitrel {
namespace {

constexpr std::size_t particles = 400;

/// No two of which are so close that they count as one place.
std::vector<Species> many_sizes() {
  return {species_of(1, always(2), between(0.7, 1.3))};
}
Configuration2 some_ellipses() {
  return inserted_mixture(Mixture{"ellipses", particles, 0.4, many_sizes()});
}
Configuration3 some_spheroids() {
  return inserted_mixture(MixtureInSpace{"spheroids", particles, 0.2, many_sizes()});
}

void expect_near(const PlaceCorrelations& one, const PlaceCorrelations& other, double within) {
  EXPECT_NEAR(one.places, other.places, within);
  EXPECT_NEAR(one.orientations, other.orientations, within);
  EXPECT_NEAR(one.sizes, other.sizes, within);
}

TEST(PlaceCorrelation, IsOneWithItself) {
  const Configuration2 plane = some_ellipses();
  expect_near(PlaceCorrelation<2>(plane).with(plane), {1, 1, 1}, 1e-12);
  const Configuration3 space = some_spheroids();
  expect_near(PlaceCorrelation<3>(space).with(space), {1, 1, 1}, 1e-12);
}

// Points that may overlap, so that all of them are independent. Each sum is one of N numbers of either sign or of rare
// pairs, with a deviation of less than 0.6/√N; and 50 configurations are averaged.
template <int Dim>
void expect_zero_at_random(Configuration<Dim> c) {
  Stream draw(5, Purpose::tests);
  const auto scatter = [&] {
    for (std::size_t i = 0; i < c.size(); ++i) {
      for (int axis = 0; axis < Dim; ++axis)
        c.position[i][axis] = (draw.uniform() - 0.5) * c.box.lengths()[axis];
      if constexpr (Dim == 2)
        c.angle[i] = std::numbers::pi * draw.uniform();
      else
        c.orientation[i] =
            Quaternion{draw.normal(), draw.normal(), draw.normal(), draw.normal()}.normalized();
    }
  };
  constexpr int samples = 50;
  PlaceCorrelations mean{};
  for (int sample = 0; sample < samples; ++sample) {
    scatter();
    const PlaceCorrelation<Dim> first(c);
    scatter();
    const PlaceCorrelations one = first.with(c);
    mean.places += one.places / samples;
    mean.orientations += one.orientations / samples;
    mean.sizes += one.sizes / samples;
  }
  expect_near(mean, {0, 0, 0}, 4 * 0.6 / std::sqrt(samples * particles));
}

TEST(PlaceCorrelation, IsZeroBetweenIndependentPlaces) {
  expect_zero_at_random<2>(some_ellipses());
  expect_zero_at_random<3>(some_spheroids());
}

// Every particle at the place of another, and all of them far away together.
TEST(PlaceCorrelation, SeesNoNumbersOfParticlesAndNoDrift) {
  const Configuration2 first = some_ellipses();
  Configuration2 later = first;
  std::ranges::reverse(later.position);
  std::ranges::reverse(later.image);
  std::ranges::reverse(later.angle);
  for (std::size_t i = 0; i < later.size(); ++i) {
    later.position[i] += Vec2(1234.5, -0.7);
    later.box.wrap(later.position[i], later.image[i]);
  }
  const PlaceCorrelations now = PlaceCorrelation<2>(first).with(later);
  EXPECT_NEAR(now.places, 1, 1e-9);
  EXPECT_NEAR(now.orientations, 1, 1e-9);
  EXPECT_LT(std::abs(now.sizes), 0.2);
}

TEST(PlaceCorrelation, FallsAsOrientationsTurnAndParticlesLeaveTheirPlaces) {
  const Configuration2 first = some_ellipses();
  Configuration2 turned = first, moved = first;
  for (double& angle : turned.angle) angle += 0.3;
  const PlaceCorrelation<2> correlation(first);
  expect_near(correlation.with(turned), {1, std::cos(0.6), 1}, 1e-12);
  // A quarter of them, as far to one side as another quarter to the other.
  const double step = 0.35 * std::sqrt(first.box.volume() / particles);
  for (std::size_t i = 0; i < particles / 2; ++i)
    moved.position[i].y() += i % 2 == 0 ? step : -step;
  const PlaceCorrelations now = correlation.with(moved);
  EXPECT_NEAR(now.orientations, 0.5, 0.1);
  EXPECT_NEAR(now.sizes, 0.5, 0.1);
}

TEST(PlaceCorrelation, OfRoundOrEqualParticlesIsOneOfPlacesAlone) {
  const Configuration2 disks =
      inserted_mixture(Mixture{"disks", particles, 0.4, {species_of(1, always(1), always(1))}});
  expect_near(PlaceCorrelation<2>(disks).with(disks), {1, 0, 0}, 1e-12);
}

}  // namespace
}  // namespace vitrel
