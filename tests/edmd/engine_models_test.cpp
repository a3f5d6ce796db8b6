// One scene, several models of it: each is no more than what a scene needs, so the general one must
// make the same events; and what must not matter (threads, a drift, the order of the particles) does
// not.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <ostream>
#include <vector>

#include "core/neighbors/cell_neighbors.h"
#include "core/state/check.h"
#include "edmd/instances/instances.h"
#include "tests/support/equal_bodies.h"
#include "tests/support/runs.h"
#include "tests/support/same_motion.h"
#include "tests/support/same_state.h"

namespace vitrel {
namespace {

Configuration2 disks() {
  return moving(square_lattice(8, 0.5, 0, [](std::size_t i) {
    return i % 3 ? Ellipse{1, 1} : Ellipse{1.1, 1.1};
  }));
}

Configuration2 ellipses() {
  return moving(square_lattice(8, 0.5, std::numbers::pi / 4, of_aspect_ratio(2)));
}

Configuration2 mixture() {
  return moving(square_lattice(8, 0.4, std::numbers::pi / 4, [](std::size_t i) {
    return i % 2 ? Ellipse{1.2, 1.2} : of_aspect_ratio(2.5);
  }));
}

TEST(Models, DisksMoveAsRoundEllipses) {
  expect_same_motion(disks(), *make_disk_engine({}), *make_ellipse_engine({}));
}

TEST(Models, DisksMoveAsEllipsesThatDoNotGrow) {
  expect_same_motion(disks(), *make_disk_engine({}), *make_growing_ellipse_engine({}));
}

TEST(Models, EllipsesMoveAsThoseThatDoNotGrow) {
  expect_same_motion(ellipses(), *make_ellipse_engine({}), *make_growing_ellipse_engine({}));
}

TEST(Models, AMixtureMovesAsOneThatDoesNotGrow) {
  expect_same_motion(mixture(), *make_ellipse_engine({}), *make_growing_ellipse_engine({}));
}

TEST(Models, InelasticDisksMoveAsInelasticEllipses) {
  EngineOptions options;
  options.laws = 0.8;
  expect_same_motion(disks(), *make_disk_engine(options), *make_ellipse_engine(options));
}

// Also in a box of only three cells.
TEST(Models, DisksWithCellsMoveAsThoseWithLists) {
  EngineOptions cells, lists;
  cells.neighbors = NeighborSearch::cells;
  lists.neighbors = NeighborSearch::lists;
  for (const double restitution : {1., 0.9}) {
    cells.laws = lists.laws = restitution;
    expect_same_motion(disks(), *make_disk_engine(cells), *make_disk_engine(lists));
  }
  const Configuration2 few = moving(lattice_of_disks(4, 0.7));
  ASSERT_LT(few.box.lengths().x(), 4 * min_cell_width(1));
  expect_same_motion(few, *make_disk_engine(cells), *make_disk_engine(lists));
}

TEST(Models, GasesHaveCellsAndLiquidsLists) {
  const auto engine = [](double packing_fraction) {
    return make_engine(lattice_of_disks(8, packing_fraction), {})->description();
  };
  EngineOptions cells;
  cells.neighbors = NeighborSearch::cells;
  EXPECT_NE(make_disk_engine(cells)->description(), make_disk_engine({})->description());
  EXPECT_EQ(engine(0.34), make_disk_engine(cells)->description());
  EXPECT_EQ(engine(0.4), make_disk_engine({})->description());
}

// A model that holds for more scenes than one is told by the scene.
TEST(Models, TheSimplestThatHoldsIsMade) {
  EngineOptions growing;
  growing.growth_rate = 0.01;
  EXPECT_EQ(make_engine(disks(), {})->description(), make_disk_engine({})->description());
  EXPECT_EQ(make_engine(mixture(), {})->description(), make_ellipse_engine({})->description());
  EXPECT_EQ(make_engine(disks(), growing)->description(),
            make_growing_ellipse_engine(growing)->description());
}

// ---- What must not matter ----

struct Material {
  const char* name;
  std::function<Configuration2()> scene;
  std::function<Ellipse(std::size_t)> shape_of;
};
void PrintTo(const Material& material, std::ostream* out) {
  *out << material.name;
}

class Invariance : public testing::TestWithParam<Material> {};

// Seen from a frame that moves: the particles cross the faces of the box at other times, some of them
// while a collision with them is planned. Four particles cross often.
TEST_P(Invariance, ADriftChangesNoCollision) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Configuration2 start =
        moving(square_lattice(2, 0.2, std::numbers::pi / 4, GetParam().shape_of), seed);
    const auto still = make_engine(start, {}), drifting = make_engine(start, {});
    const Vec2 drift(0.8, -0.5);
    bool begun = false;
    const auto frame = [&](Configuration2& c, double time) {
      for (std::size_t i = 0; i < c.size(); ++i) {
        c.position[i] -= drift * time;
        c.velocity[i] += begun ? -drift : drift;
      }
      begun = true;
    };
    expect_same_motion(start, *still, *drifting, {.collisions_of_each = 6}, frame);
    if (HasFailure()) return;
  }
}

// A particle that crossed a face of the box while a collision with it was planned once was looked for
// a box length away: in such a small dilute box that ended in an overlap after some hundred time units.
TEST_P(Invariance, CrossingTheBoxKeepsFourParticlesHard) {
  const Configuration2 start =
      moving(square_lattice(2, 0.3, std::numbers::pi / 4, GetParam().shape_of), 5);
  const RunState2 state = run_until(start, 2000);
  EXPECT_GT(state.counters.collisions, 3000u);
  EXPECT_TRUE(exact_check(state.configuration).clean());
  EXPECT_LE(state.energy_drift, 1e-12);
}

// Particles are numbered for memory, but no event depends on it.
TEST_P(Invariance, TheOrderOfTheParticlesChangesNoCollision) {
  const Configuration2 start = GetParam().scene();
  const auto forward = make_engine(start, {}), backward = make_engine(start, {});
  const auto frame = [](Configuration2& c, double) {
    std::ranges::reverse(c.position);
    std::ranges::reverse(c.velocity);
    std::ranges::reverse(c.image);
    std::ranges::reverse(c.angle);
    std::ranges::reverse(c.angular_velocity);
    std::ranges::reverse(c.shape);
    std::ranges::reverse(c.mass);
  };
  expect_same_motion(start, *forward, *backward, {}, frame);
}

// So many that they exceed what the engine takes a cache to hold.
constexpr int times = 23;
Configuration2 repeated(const Configuration2& tile) {
  Configuration2 c;
  c.resize(tile.size() * times * times);
  c.species_names = tile.species_names;
  c.box = PeriodicBox<2>(tile.box.lengths() * times);
  for (std::size_t k = 0; k < c.size(); ++k) {
    const std::size_t i = k % tile.size(), copy = k / tile.size();
    const std::size_t row = copy / times;
    const Vec2 corner(static_cast<double>(copy % times), static_cast<double>(row));
    c.position[k] = tile.position[i] + corner.cwiseProduct(tile.box.lengths());
    c.box.wrap(c.position[k], c.image[k]);
    c.angle[k] = tile.angle[i];
    c.velocity[k] = tile.velocity[i];
    c.angular_velocity[k] = tile.angular_velocity[i];
    c.shape[k] = tile.shape[i];
    c.mass[k] = tile.mass[i];
  }
  return c;
}

// A box and many copies of it side by side: the same motion, but so many particles that what events
// will read is asked for beforehand, and that the particles are in other cells.
TEST_P(Invariance, ManyCopiesMoveAsOne) {
  const Configuration2 tile = GetParam().scene(), start = repeated(tile);
  Configuration2 one = tile, many = start;
  const auto small = make_engine(one, {}), large = make_engine(many, {});
  RunCounters of_one, of_many;
  small->load(one);
  large->load(many);
  for (double until = 0.02; of_one.collisions < 3 * one.size(); until += 0.02) {
    advance(*small, one, until, of_one);
    advance(*large, many, until, of_many);
    ASSERT_EQ(of_many.collisions, of_one.collisions * times * times) << "up to " << until;
    Configuration2 copy = tile;
    for (std::size_t k = 0; k < many.size(); ++k) {
      const std::size_t i = k % one.size();
      copy.position[i] = tile.position[i] + (many.unwrapped(k) - start.unwrapped(k));
      copy.angle[i] = many.angle[k];
      copy.velocity[i] = many.velocity[k];
      copy.angular_velocity[i] = many.angular_velocity[k];
      if (i + 1 < one.size()) continue;
      ASSERT_LT(difference(one, copy), 1e-5) << "at " << until;
    }
  }
  EXPECT_TRUE(exact_check(many).clean());
}

// Before the end of a Brownian step many particles meet nobody and have no next event.
TEST_P(Invariance, ManyParticlesStayHardInBrownianSteps) {
  const RunState2 state = run_until(repeated(GetParam().scene()), 2, brownian(0.1));
  EXPECT_GT(state.counters.collisions, 5000u);
  EXPECT_EQ(state.counters.correction_moves, 0u);
  EXPECT_TRUE(exact_check(state.configuration).clean());
}

RunState2 brownian_run(const Configuration2& start, int threads) {
  DynamicsOptions options = brownian(0.05);
  options.engine.threads = threads;
  return run_until(start, 3, options);
}

// Every velocity is drawn from a stream of its own and every prediction made from the state alone:
// more threads change no bit.
TEST_P(Invariance, ThreadsChangeNoBitOfABrownianRun) {
  const Configuration2 start = GetParam().scene();
  const RunState2 one = brownian_run(start, 1);
  EXPECT_EQ(one.velocity_steps, 60u);
  EXPECT_GT(one.counters.collisions, 30u);
  for (const int threads : {2, 3}) {
    const RunState2 more = brownian_run(start, threads);
    expect_same_state(more.configuration, one.configuration);
    EXPECT_EQ(more.counters.collisions, one.counters.collisions);
    EXPECT_EQ(more.counters.predictions, one.counters.predictions);
    EXPECT_EQ(more.counters.searches, one.counters.searches);
    EXPECT_EQ(more.counters.virial, one.counters.virial);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Materials, Invariance,
    testing::Values(Material{"disks", disks,
                             [](std::size_t) {
                               return Ellipse{1, 1};
                             }},
                    Material{"ellipses", ellipses, [](std::size_t) { return of_aspect_ratio(2); }},
                    Material{"a mixture", mixture, [](std::size_t i) {
                               return i % 2 ? Ellipse{1.2, 1.2} : of_aspect_ratio(2.5);
                             }}));

// ---- Accuracy ----

/// A square lattice of disks, stretched along x with its particles: aligned, and far denser than the
/// particles fit squares.
Configuration2 stretched_lattice(int side, double packing_fraction, double aspect_ratio) {
  Configuration2 c = square_lattice(side, packing_fraction, 0, of_aspect_ratio(aspect_ratio));
  const Vec2 stretch(std::sqrt(aspect_ratio), 1 / std::sqrt(aspect_ratio));
  c.box = PeriodicBox<2>(c.box.lengths().cwiseProduct(stretch));
  for (Vec2& position : c.position) position = position.cwiseProduct(stretch);
  return c;
}

// A million collisions. Every impact rounds the energies of two of the N particles by about ε, at
// random: √(2·10⁶ N) ε/N of the total, 2e-14, and as much in the momentum.
TEST(Accuracy, DoesNotDecayOverAMillionCollisions) {
  RunState2 state = begin_run(moving(stretched_lattice(16, 0.7, 6)), 0);
  int blocks = 0;
  bool clean = true;
  RunPlan2 plan{{}, 1e9, nullptr, [&](const RunState2& now) {
                  ++blocks;
                  clean = clean && exact_check(now.configuration).clean();
                }};
  RunControl control;
  control.should_stop = [&] { return state.counters.collisions > 1'000'000; };
  run(state, {}, plan, control);
  EXPECT_GT(state.counters.collisions, 1'000'000u);
  EXPECT_GT(blocks, 30);
  EXPECT_TRUE(clean);
  EXPECT_EQ(state.counters.correction_moves, 0u);
  EXPECT_LE(state.energy_drift, 1e-13);
  EXPECT_LE(state.largest_momentum, 1e-12);
}

}  // namespace
}  // namespace vitrel
