#include "analysis/dynamics/like_particles.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/dynamics/correlation.h"
#include "tests/support/particles_of.h"
#include "tests/support/scenes.h"

namespace vitrel {
namespace {

template <int Dim>
Configuration<Dim> particles(const std::vector<ParticleShape<Dim>>& shapes,
                             const std::vector<int>& species = {}) {
  Configuration<Dim> c = particles_of<Dim>(shapes);
  c.species_names = {"A", "B"};
  for (std::size_t i = 0; i < species.size(); ++i) c.species[i] = species[i];
  return c;
}

TEST(LikeParticles, OfOneShapeAreOneClassOfEverySpecies) {
  const std::vector<Ellipse> shapes(20, of_aspect_ratio(2));
  EXPECT_EQ(like_particles(particles<2>(shapes)).classes, 1u);
  std::vector<int> species(20, 0);
  species[3] = species[17] = 1;
  const LikeParticles alike = like_particles(particles<2>(shapes, species));
  EXPECT_EQ(alike.classes, 2u);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(alike.class_of[i], i == 3 || i == 17) << i;
}

// 64 sizes in an order that is none: eight classes of eight, each of neighbours in size.
TEST(LikeParticles, OfManySizesAreNeighboursInSize) {
  std::vector<Ellipsoid> shapes;
  std::vector<std::size_t> rank;
  for (std::size_t i = 0; i < 64; ++i) {
    rank.push_back(i * 29 % 64);
    shapes.push_back({Vec3::Constant(1 + 0.1 * static_cast<double>(rank.back()))});
  }
  const LikeParticles alike = like_particles(particles<3>(shapes));
  EXPECT_EQ(alike.classes, 8u);
  for (std::size_t i = 0; i < 64; ++i) EXPECT_EQ(alike.class_of[i], rank[i] / 8);
}

// Particles of one area, but of different aspect ratios, are halved by area, which all share, and then by the longer
// semi-axis.
TEST(LikeParticles, AreAlikeInAspectRatioToo) {
  std::vector<Ellipse> shapes;
  for (int i = 0; i < 32; ++i) shapes.push_back(of_aspect_ratio(i % 2 == 0 ? 1 : 4));
  const LikeParticles alike = like_particles(particles<2>(shapes));
  for (std::size_t i = 0; i < 32; ++i)
    for (std::size_t j = 0; j < 32; ++j)
      EXPECT_TRUE(alike.class_of[i] != alike.class_of[j] || i % 2 == j % 2) << i << ' ' << j;
}

TEST(LikeParticles, AreAtMostThirtyTwoClasses) {
  std::vector<Ellipse> shapes;
  for (int i = 0; i < 1000; ++i) shapes.push_back(of_aspect_ratio(1 + 0.001 * i));
  EXPECT_EQ(like_particles(particles<2>(shapes)).classes, 32u);
  shapes.resize(1);
  EXPECT_EQ(like_particles(particles<2>(shapes)).classes, 1u);
}

// One origin only, so that the particles stand in for blocks: those of class 1 move a hundred times as far.
TEST(CorrelationSum, ParticlesAreComparedWithTheirClass) {
  const double moved[] = {1, 3, 101, 103};
  CorrelationSum apart(1, 2), together(1);
  for (std::size_t i = 0; i < 4; ++i) {
    for (CorrelationSum* sum : {&apart, &together}) sum->add(0, {&moved[i], 1});
    apart.finish_particle(i / 2);
    together.finish_particle();
  }
  const Lag lag{1, 1, 1};
  EXPECT_NEAR(apart.estimate(lag, 4).spread, std::sqrt(2.0 / 4) * student_factor(2), 1e-12);
  EXPECT_GT(together.estimate(lag, 4).spread, 25);
}

}  // namespace
}  // namespace vitrel
