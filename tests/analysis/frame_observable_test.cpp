#include "analysis/observables/frame_observable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "analysis/statistics/blocking.h"
#include "analysis/structure/order.h"
#include "analysis/structure/pair_correlation.h"
#include "analysis/structure/structure_factor.h"
#include "tests/support/chi_squared.h"
#include "tests/support/frames.h"
#include "tests/support/random_gas.h"
#include "tests/support/scenes.h"
#include "tests/support/tables.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

/// Independent frames of two species of ellipses at random, in a box that changes if `breathing`.
MemoryTrajectory2 gases(std::size_t frames, bool breathing = false) {
  Stream draw(5, Purpose::tests);
  return trajectory_of(frames, Configuration2(), [&](Configuration2& frame, std::size_t k) {
    const Vec2 lengths = (breathing && k % 2 ? 1.2 : 1.0) * Vec2(20, 15);
    frame = random_gas(60, lengths, draw, [&](Configuration2& c, std::size_t i) {
      c.species[i] = i % 3 == 0;
      c.shape[i] = of_aspect_ratio(2);
      c.angle[i] = draw.uniform(-pi, pi);
    });
    frame.time = 0.5 * static_cast<double>(k);
    frame.species_names = {"big", "small-1"};
  });
}

bool same_bits(const std::vector<double>& x, const std::vector<double>& y) {
  const auto bits = [](double number) { return std::bit_cast<std::uint64_t>(number); };
  return std::ranges::equal(x, y, {}, bits, bits);
}

// 100 frames, one in three of them measured, 32 at a time.
TEST(StructureTables, TellHowFarTheyAre) {
  MemoryTrajectory2 trajectory = gases(100);
  StructureOptions options;
  options.max_frames = 40;
  std::vector<double> frames;
  measure_frames(trajectory, options, 2, [&](const Progress& progress) {
    frames.push_back(progress.value);
    EXPECT_DOUBLE_EQ(progress.fraction, progress.value / 100);
    EXPECT_STREQ(progress.quantity, "frames");
  });
  EXPECT_EQ(frames, (std::vector<double>{96, 100}));
}

TEST(StructureTables, HaveTheColumnsThatReadersRelyOn) {
  MemoryTrajectory2 trajectory = gases(40);
  const std::vector<Table> tables = measure_frames(trajectory, {}, 1).tables;
  ASSERT_EQ(tables.size(), 5u);
  expect_columns(
      tables, "structure_factor",
      {"q", "s", "s_big_big", "s_big_small_1", "s_small_1_small_1", "s_orientation", "modes"});
  expect_columns(tables, "pair_correlation",
                 {"r", "g", "g_big_big", "g_big_small_1", "g_small_1_small_1", "g_2", "g_4"});
  expect_columns(tables, "orientation_distribution", {"angle", "density", "by_chance"});
  expect_columns(tables, "order", {"time", "nematic", "director", "hexatic"});
  EXPECT_EQ(named(tables, "pair_correlation").rows(), 150u);  // half of 15 by 0.05
  expect_whole_columns(tables);
}

TEST(StructureTables, OfDisksAreWithoutOrientations) {
  MemoryTrajectory2 ellipses = gases(3);
  auto trajectory = trajectory_of(3, Configuration2(), [&](Configuration2& frame, std::size_t k) {
    frame = ellipses.read(k);
    frame.species_names = {"A"};
    frame.species.assign(60, 0);
    frame.shape.assign(60, {1, 1});
  });
  const std::vector<Table> tables = measure_frames(trajectory, {}, 2).tables;
  ASSERT_EQ(tables.size(), 3u);
  expect_columns(tables, "structure_factor", {"q", "s", "modes"});
  expect_columns(tables, "pair_correlation", {"r", "g"});
  expect_columns(tables, "order", {"time", "hexatic"});
}

TEST(StructureTables, DoNotDependOnThreads) {
  MemoryTrajectory2 trajectory = gases(41, true);
  const std::vector<Table> one = measure_frames(trajectory, {}, 1).tables;
  for (const int threads : {2, 7}) {
    const std::vector<Table> many = measure_frames(trajectory, {}, threads).tables;
    for (std::size_t t = 0; t < one.size(); ++t)
      for (std::size_t c = 0; c < one[t].columns.size(); ++c) {
        EXPECT_TRUE(same_bits(one[t].columns[c].value, many[t].columns[c].value));
        EXPECT_TRUE(same_bits(one[t].columns[c].error, many[t].columns[c].error));
      }
  }
}

// What a column says must be the plain averages of the single frames, thinned: 0, 3, 6 … 297, here of one
// shell of wave numbers and one bin of distances.
TEST(StructureTables, AverageEveryThirdFrame) {
  MemoryTrajectory2 trajectory = gases(300);
  StructureOptions options;
  options.max_frames = 100;
  std::vector<double> s, orders;
  double pairs = 0, weighted = 0;
  const ScatteringShells shells(trajectory.read(0).box.lengths(), options.shells);
  const std::size_t shell = 20;
  double q = 0;
  for (std::size_t k = 0; k < 300; k += 3) {
    const Configuration2& frame = trajectory.read(k);
    const StructureFactor one = shells.direct_structure_factor(frame);
    s.push_back(one.total[shell]);
    q = one.q[shell];
    const PairCorrelation pair = pair_correlation(frame, options.pairs);
    if (pair.rotor_pairs[100] > 0) weighted += pair.rotor_pairs[100] * pair.g_2[100];
    pairs += pair.rotor_pairs[100];
    orders.push_back(nematic_order(frame));
  }
  const std::vector<Table> tables = measure_frames(trajectory, options, 2).tables;
  const Table& structure = named(tables, "structure_factor");
  const std::vector<double>& listed = structure.find("q")->value;
  const auto nearest =
      std::ranges::min_element(listed, {}, [&](double x) { return std::abs(x - q); });
  const auto row = static_cast<std::size_t>(nearest - listed.begin());
  const Estimate mean = block_average(s);
  EXPECT_NEAR(listed[row], q, 1e-12);
  EXPECT_NEAR(structure.find("s")->value[row], mean.mean, 4e-5);  // the bound for N S = 400
  EXPECT_NEAR(structure.find("s")->error[row], mean.error, 4e-5);
  EXPECT_NEAR(named(tables, "pair_correlation").find("g_2")->value[100], weighted / pairs, 1e-12);
  EXPECT_EQ(named(tables, "order").find("nematic")->value, orders);
  EXPECT_EQ(named(tables, "order").find("time")->value[1], 1.5);
}

// An ideal gas in a box of two sizes in turn: S = g = 1 in both, also in shells that only one of the boxes
// has wave vectors in. χ² with the tables' own errors; five standard deviations, of 60 rows or more.
TEST(StructureTables, OfAChangingBoxAreAveragesOverItsFrames) {
  MemoryTrajectory2 trajectory = gases(400, true);
  const std::vector<Table> tables = measure_frames(trajectory, {}, 2).tables;
  for (const auto& [table, column] : {std::pair{"structure_factor", "s"},
                                      {"structure_factor", "s_orientation"},
                                      {"pair_correlation", "g"},
                                      {"pair_correlation", "g_big_small_1"}}) {
    const Column& values = *named(tables, table).find(column);
    ChiSquared rows;
    for (std::size_t k = 0; k < values.value.size(); ++k)
      if (values.error[k] > 0) rows.add(values.value[k] - 1, values.error[k]);
    SCOPED_TRACE(column);
    EXPECT_GT(rows.values, 60);
    rows.expect_one(5);
  }
  // The larger box has half of 18 by 0.05.
  EXPECT_EQ(named(tables, "pair_correlation").rows(), 180u);
}

TEST(StructureTables, WithoutFramesThereIsOrderOnly) {
  MemoryTrajectory2 trajectory = gases(10);
  const std::vector<Table> tables = measure_frames(trajectory, {0, {}, {}}, 1).tables;
  ASSERT_EQ(tables.size(), 1u);
  EXPECT_EQ(tables.front().name, "order");
  EXPECT_EQ(tables.front().rows(), 10u);
}

}  // namespace
}  // namespace vitrel
