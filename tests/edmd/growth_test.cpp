#include "edmd/growth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>
#include <vector>

#include "bench/reference/literature.h"
#include "core/error.h"
#include "core/state/check.h"
#include "edmd/brownian.h"
#include "tests/support/equal_bodies.h"
#include "tests/support/same_state.h"
#include "tests/support/statistics.h"
#include "tests/support/stops.h"

namespace vitrel {
namespace {

/// Advances by `time` in one block; the counters of the flight.
RunCounters advance(Configuration2& configuration, double rate, double time) {
  EngineOptions options;
  options.growth_rate = rate;
  const std::unique_ptr<Engine2> engine = make_engine(configuration, options);
  RunCounters counters;
  engine->load(configuration, configuration.time + time);
  EXPECT_EQ(engine->advance(configuration.time + time, counters), Engine2::Stop::time);
  engine->write(configuration);
  return counters;
}

double energy(const Configuration2& configuration) {
  const Mechanics sums = mechanics(configuration);
  return sums.translational_energy + sums.rotational_energy;
}

/// Two equal particles on the x axis, `distance` apart, meeting with the speeds u and −u.
Configuration2 head_on(const Ellipse& shape, double distance, double u) {
  Configuration2 c = equal_bodies(2, shape, Vec2(100, 100));
  c.position = {Vec2(-0.5 * distance, 0), Vec2(0.5 * distance, 0)};
  c.velocity = {Vec2(u, 0), Vec2(-u, 0)};
  return c;
}

class HeadOn : public testing::TestWithParam<Ellipse> {};

// Contact when D − 2 u t = 2 (1 + γ t) a, so t = (D − 2 a)/(2 u + 2 γ a). The surfaces meet with
// 2 u + s, s = 2 γ a, so J = 2 u + s for masses 1; each speed becomes u + s, and the energy rises by
// (u + s)² − u² = J s.
TEST_P(HeadOn, TimeImpulseAndEnergyFollowTheGrowingSurfaces) {
  const double distance = 8, u = 0.3, rate = 0.05;
  const double a = GetParam().a, s = 2 * rate * a;
  const double contact = (distance - 2 * a) / (2 * u + s);
  Configuration2 c = head_on(GetParam(), distance, u);
  const double before = energy(c);
  EXPECT_EQ(advance(c, rate, contact - 1e-9).collisions, 0u);
  c = head_on(GetParam(), distance, u);
  const RunCounters counters = advance(c, rate, contact + 0.5);
  EXPECT_EQ(counters.collisions, 1u);
  EXPECT_NEAR(counters.virial, (2 * u + s) * 2 * a * (1 + rate * contact), 1e-11);
  EXPECT_NEAR(c.velocity[0].x(), -(u + s), 1e-12);
  EXPECT_NEAR(c.velocity[1].x(), u + s, 1e-12);
  EXPECT_NEAR(energy(c) - before, (2 * u + s) * s, 1e-12);
  const double size = 1 + rate * (contact + 0.5);
  EXPECT_NEAR(c.shape[0].a, size * a, 1e-14 * a);
  EXPECT_NEAR(c.shape[1].b, size * GetParam().b, 1e-14);
  EXPECT_TRUE(exact_check(c).clean());
}

// Shrinking from rest: receding surfaces never touch, approaching ones touch later.
TEST_P(HeadOn, ShrinkingBodiesMeetLaterAndLoseEnergy) {
  const double distance = 8, u = 0.3, rate = -0.05;
  const double a = GetParam().a, s = 2 * rate * a;
  Configuration2 c = head_on(GetParam(), distance, u);
  const double before = energy(c), contact = (distance - 2 * a) / (2 * u + s);
  EXPECT_EQ(advance(c, rate, contact + 0.5).collisions, 1u);
  EXPECT_NEAR(c.velocity[1].x(), u + s, 1e-12);
  EXPECT_NEAR(energy(c) - before, (2 * u + s) * s, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Shapes, HeadOn, testing::Values(Ellipse{1, 1}, Ellipse{1.5, 0.5}),
                         [](const auto& at) { return at.param.is_round() ? "Disks" : "Ellipses"; });

// ω constant, I from the present axes: the rotational energy grows like the size squared.
TEST(GrowingFlight, AngularVelocityStaysAndTheMomentOfInertiaGrows) {
  Configuration2 c = equal_bodies(1, {2, 0.5}, Vec2(20, 20));
  c.angular_velocity = {0.7};
  const double before = energy(c);
  EXPECT_EQ(advance(c, 0.1, 3).collisions, 0u);
  EXPECT_NEAR(c.angle[0], 2.1, 1e-14);
  EXPECT_EQ(c.angular_velocity[0], 0.7);
  EXPECT_NEAR(energy(c), 1.69 * before, 1e-13);
}

// Each impact does the work J γ (R₁ + R₂), and n·d = (1 + γ t)(R₁ + R₂): over a time T the energy
// gained lies between γ Σ J n·d/(1 + γ T) and γ Σ J n·d.
TEST(GrowingFlight, TheWorkOfTheSurfacesIsTheVirial) {
  Configuration2 c = square_lattice(6, 0.5, 0, [](std::size_t i) {
    const double radius = i % 2 ? 1.2 : 1;
    return Ellipse{radius, radius};
  });
  draw_velocities(c, 3, Purpose::velocities, 0, Temperature::relative);
  const double before = energy(c), rate = 0.01, time = 2;
  const RunCounters counters = advance(c, rate, time);
  EXPECT_GT(counters.collisions, 100u);
  const double gained = energy(c) - before, most = rate * counters.virial;
  EXPECT_LT(gained, most);
  EXPECT_GT(gained, most / (1 + rate * time));
  EXPECT_LT(mechanics(c).momentum.norm(), 1e-12);
}

// ---------------------------------------------------------------------------------------------------

struct Material {
  const char* name;
  std::function<Ellipse(std::size_t)> shape;
};
void PrintTo(const Material& material, std::ostream* out) {
  *out << material.name;
}

/// For every particle the same.
auto always(const Ellipse& shape) {
  return [shape](std::size_t) { return shape; };
}

Ellipse one_of_two_sizes(std::size_t i) {
  return i % 2 ? Ellipse{1.4, 1.4} : Ellipse{1, 1};
}

Ellipse one_of_many_shapes(std::size_t i) {
  const double size = 0.7 + 0.1 * static_cast<double>(i % 7);
  return scaled(of_aspect_ratio(1 + static_cast<double>(i % 5)), size);
}

const Material materials[] = {{"Disks", always({1, 1})},
                              {"DisksOfTwoSizes", one_of_two_sizes},
                              {"NearlyRound", always(of_aspect_ratio(1.4))},
                              {"Long", always(of_aspect_ratio(4))},
                              {"SizesAndShapes", one_of_many_shapes}};

Configuration2 dilute(const Material& material, int side) {
  return square_lattice(side, 0.15, 0.6, material.shape);
}

void expect_same_shapes(const Configuration2& c, const Configuration2& start) {
  for (std::size_t i = 0; i < c.size(); ++i) {
    EXPECT_EQ(c.shape[i].a, start.shape[i].a);
    EXPECT_EQ(c.shape[i].b, start.shape[i].b);
    EXPECT_EQ(c.mass[i], start.mass[i]);
  }
}

class Growth : public testing::TestWithParam<Material> {};

/// The end of a growth that is not stopped.
struct Grown : StageReport, GrowthState {};
Grown grown(Configuration2& c, const GrowthOptions& options) {
  Grown result;
  static_cast<StageReport&>(result) = grow(c, options, result, {});
  return result;
}

/// The same of one that reaches its goal, without overlap.
Grown grown_to_the_goal(Configuration2& c, const GrowthOptions& options) {
  Grown result = grown(c, options);
  EXPECT_EQ(result.end, StageEnd::reached) << result.reason;
  EXPECT_TRUE(exact_check(c).clean());
  return result;
}

TEST_P(Growth, ReachesThePackingFractionExactly) {
  const Configuration2 start = dilute(GetParam(), 8);
  Configuration2 c = start;
  const Grown report = grown_to_the_goal(c, {0.02, 0.7, {}, 1});
  EXPECT_NEAR(packing_fraction(c), 0.7, 0.7e-12);
  // φ = (1 + γ t)² φ(0) in one go; in units of the present size, sizes grow exponentially.
  EXPECT_NEAR(report.time, std::log(std::sqrt(0.7 / 0.15)) / 0.02, 0.01 * report.time);
  EXPECT_GT(report.reduced_pressure, 5);
  expect_same_shapes(c, start);
  EXPECT_EQ(c.time, start.time);
  EXPECT_LT(mechanics(c).momentum.norm(), 1e-11);
  EXPECT_NEAR(kinetic_temperature(c), 1, 1e-12);
}

TEST_P(Growth, JamsWithoutOverlap) {
  Configuration2 c = dilute(GetParam(), 8);
  const Grown report = grown_to_the_goal(c, {0.02, {}, 1e4, 2});
  EXPECT_GE(report.reduced_pressure, 1e4);
  EXPECT_LT(mechanics(c).momentum.norm(), 1e-11);
  EXPECT_GT(packing_fraction(c), 0.78);
  EXPECT_LT(packing_fraction(c), std::numbers::pi / std::sqrt(12.0));
}

INSTANTIATE_TEST_SUITE_P(Materials, Growth, testing::ValuesIn(materials),
                         [](const auto& at) { return std::string(at.param.name); });

// Eight hundred time units of 400 disks around φ = 0.5, half of them growing, half shrinking: what
// lags behind the density cancels to first order in every pair of legs, as does the heating within
// blocks. Wanted: the equation of state of the infinite system (Kolafa & Rottner, Mol. Phys. 104,
// 3435, 2006) to 5 standard errors from 8 pairs (false alarm 0.2 %, seeds fixed) and 0.2 % for N:
// fixed N lowers Z by y'' φ/(2 y' N) = 0.1 %, y = φ Z, and zero momentum by 1/N = 0.06 %.
TEST(GrowthPressure, FollowsTheEquationOfState) {
  const double low = 0.4975, high = 0.5025, reference = fluid_pressure(1, 0.5).z;
  Configuration2 c = lattice_of_disks(20, 0.4);
  grown(c, {1e-2, low, {}, 1});
  std::vector<double> over_legs, of_last_block;
  for (std::uint64_t pair = 0; pair < 8; ++pair) {
    const Grown up = grown(c, {1e-4, high, {}, 2 * pair + 2});
    const Grown down = grown(c, {-1e-4, low, {}, 2 * pair + 3});
    const double virial = up.counters.virial + down.counters.virial;
    over_legs.push_back(1 + virial / (2 * 400 * (up.time + down.time)));
    of_last_block.push_back(0.5 * (up.reduced_pressure + down.reduced_pressure));
  }
  for (const Estimate& z : {estimate(over_legs), estimate(of_last_block)}) {
    EXPECT_LT(z.error, 0.015 * reference);
    EXPECT_NEAR(z.mean, reference, 5 * z.error + 0.002 * reference);
  }
  EXPECT_LT(estimate(over_legs).error, 0.003 * reference);
}

// A particle between its own images above and below swings within ±θ₀, θ₀² = 2 (L_y/(2 b s) − 1)/
// (1 − b²/a²), and jams when its short axis fills the box: φ_J = π a b/(L_x L_y) (L_y/2b)². One degree
// of freedom in a free range ∝ √(1 − φ/φ_J): Z (1 − φ/φ_J) → 1/2. Wanted up to what Z changes in a
// block, which a growth by 0.05/Z makes 2·0.05/0.5 = 20 %. A block holds only a few swings: the mean of 20 starts.
TEST(GrowthLimits, ALoneParticleJamsAgainstItsOwnImages) {
  constexpr int starts = 20;
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= starts; ++seed) {
    Configuration2 c = equal_bodies(1, {2, 0.5}, Vec2(6, 1.1));
    const double box_aspect = c.box.lengths().y() / c.box.lengths().x();
    const double jamming = std::numbers::pi / 2 * 2 * box_aspect;  // π (a/b) (L_y/L_x)/4
    const Grown report = grown_to_the_goal(c, {1e-4, {}, 2e3, seed});
    EXPECT_GT(report.counters.collisions, 1000u);
    sum += report.reduced_pressure * (1 - packing_fraction(c) / jamming);
  }
  EXPECT_NEAR(sum / starts, 0.5, 0.15);
}

TEST(GrowthLimits, KnowsWhenTheParticlesAreJammed) {
  Configuration2 c = dilute(materials[3], 4);
  const Grown report = grown(c, {0.05, 0.9, {}, 1});
  EXPECT_EQ(report.end, StageEnd::stalled);
  EXPECT_NE(report.reason.find("jammed"), std::string::npos) << report.reason;
  EXPECT_LT(packing_fraction(c), 0.9);
  EXPECT_TRUE(exact_check(c).clean());
}

// 27 spheres grown this fast jam below 0.62 with every one of these seeds.
TEST(GrowthLimits, FewJammedSpheresTryAgain) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Configuration3 c = cubic_lattice(3, 0.05, Ellipsoid{}, seed);
    GrowthState state;
    GrowthOptions options{0.1, 0.62, {}, seed};
    Configuration3 once = c;
    ASSERT_EQ(grow(once, options, state, {}).end, StageEnd::stalled);
    options.retries = 12;
    state = {};
    const StageReport report = grow(c, options, state, {});
    EXPECT_EQ(report.end, StageEnd::reached) << report.reason;
    EXPECT_GT(state.retries, 0u);
    EXPECT_NEAR(packing_fraction(c), 0.62, 0.62e-12);
    EXPECT_TRUE(exact_check(c).clean());
  }
}

// Whichever goal comes first.
TEST(GrowthLimits, EndsAtThePackingFractionBeforeThePressure) {
  Configuration2 c = dilute(materials[2], 6);
  const Grown report = grown(c, {0.02, 0.5, 1e4, 1});
  EXPECT_EQ(report.end, StageEnd::reached);
  EXPECT_NEAR(packing_fraction(c), 0.5, 0.5e-12);
  EXPECT_LT(report.reduced_pressure, 10);
}

TEST(GrowthLimits, ShrinksWithANegativeRate) {
  Configuration2 c = dilute(materials[4], 6);
  grown(c, {0.02, 0.6, {}, 1});
  const Grown report = grown_to_the_goal(c, {-0.02, 0.3, {}, 1});
  EXPECT_NEAR(packing_fraction(c), 0.3, 0.3e-12);
}

// Stopped at every block end and resumed, growth ends in the same bits, also if particles that jam try again.
class ResumedGrowth : public testing::TestWithParam<GrowthOptions> {};

TEST_P(ResumedGrowth, EndsInTheSameBits) {
  const GrowthOptions options = GetParam();
  Configuration2 whole = dilute(materials[4], 5), parts = whole;
  const Grown uninterrupted = grown(whole, options);
  GrowthState state;
  const auto one_block = [&](const auto& control) { return grow(parts, options, state, control); };
  EXPECT_GE(stops_of(2, one_block), 10);
  expect_same_state(parts, whole);
  EXPECT_EQ(state.reduced_pressure, uninterrupted.reduced_pressure);
  EXPECT_EQ(state.counters.collisions, uninterrupted.counters.collisions);
  EXPECT_EQ(state.retries, static_cast<std::uint64_t>(options.retries));
}
INSTANTIATE_TEST_SUITE_P(GrowthLimits, ResumedGrowth,
                         testing::Values(GrowthOptions{0.005, {}, 1e3, 5},
                                         GrowthOptions{0.05, 0.9, {}, 1, 2}));

// In small boxes the neighbourhoods of several particles meet in one corner.
TEST(GrowthLimits, KeepsAFewParticlesHardInASmallBox) {
  const auto expect_hard = []<int Dim>(const Configuration<Dim>& start) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      Configuration<Dim> c = start;
      GrowthState state;
      ASSERT_EQ(grow(c, {0.01, 0.3, {}, seed}, state, {}).end, StageEnd::reached) << seed;
      EXPECT_TRUE(exact_check(c).clean()) << seed;
    }
  };
  for (const int side : {2, 3}) {
    expect_hard(square_lattice(side, 0.1, 0.4, of_aspect_ratio(2)));
    expect_hard(cubic_lattice(side, 0.02, prolate(2)));
  }
}

TEST(GrowthLimits, RefusesWhatCannotSucceed) {
  Configuration2 c = dilute(materials[0], 3);
  EXPECT_THROW(grown(c, {0.01, {}, {}, 1}), UserError);
  EXPECT_THROW(grown(c, {0, 0.5, {}, 1}), UserError);
  EXPECT_THROW(grown(c, {-0.01, 0.5, {}, 1}), UserError);
  EXPECT_THROW(grown(c, {0.01, 0.1, {}, 1}), UserError);
  EXPECT_THROW(grown(c, {-0.01, {}, 100, 1}), UserError);
  Configuration2 lone = dilute(materials[0], 1);
  EXPECT_THROW(grown(lone, {0.01, 0.5, {}, 1}), UserError);
}

}  // namespace
}  // namespace vitrel
