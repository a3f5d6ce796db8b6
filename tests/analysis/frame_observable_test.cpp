#include "analysis/observables/frame_observable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

#include "analysis/statistics/blocking.h"
#include "analysis/structure/order.h"
#include "analysis/structure/pair_correlation.h"
#include "analysis/structure/structure_factor.h"
#include "core/random/stream.h"
#include "tests/support/scenes.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

/// Independent frames of two species of ellipses at random, in a box that changes if `breathing`.
std::vector<Configuration2> gases(std::size_t frames, bool breathing) {
  std::vector<Configuration2> all;
  Stream draw(5, Purpose::tests);
  for (std::size_t k = 0; k < frames; ++k) {
    Configuration2 c;
    c.resize(60);
    c.time = 0.5 * static_cast<double>(k);
    c.species_names = {"big", "small-1"};
    const Vec2 lengths = (breathing && k % 2 ? 1.2 : 1.0) * Vec2(20, 15);
    c.box = PeriodicBox<2>(lengths);
    for (std::size_t i = 0; i < c.size(); ++i) {
      c.species[i] = i % 3 == 0;
      c.shape[i] = of_aspect_ratio(2);
      c.position[i] = lengths.cwiseProduct(Vec2{draw.uniform(-0.5, 0.5), draw.uniform(-0.5, 0.5)});
      c.angle[i] = draw.uniform(-pi, pi);
    }
    all.push_back(c);
  }
  return all;
}

const Table& named(const std::vector<Table>& tables, std::string_view name) {
  for (const Table& table : tables)
    if (table.name == name) return table;
  throw std::out_of_range(std::string(name));
}

std::vector<std::string> column_names(const Table& table) {
  std::vector<std::string> names;
  for (const Column& column : table.columns) names.push_back(column.name);
  return names;
}

bool same_bits(const std::vector<double>& x, const std::vector<double>& y) {
  const auto bits = [](double number) { return std::bit_cast<std::uint64_t>(number); };
  return std::ranges::equal(x, y, {}, bits, bits);
}

// 100 frames, one in three of them measured, 32 at a time.
TEST(StructureTables, TellHowFarTheyAre) {
  MemoryTrajectory2 trajectory(gases(100, false));
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
  MemoryTrajectory2 trajectory(gases(40, false));
  const std::vector<Table> tables = measure_frames(trajectory, {}, 1).tables;
  ASSERT_EQ(tables.size(), 5u);
  EXPECT_EQ(column_names(named(tables, "structure_factor")),
            (std::vector<std::string>{"q", "s", "s_big_big", "s_big_small_1", "s_small_1_small_1",
                                      "s_orientation", "modes"}));
  EXPECT_EQ(column_names(named(tables, "pair_correlation")),
            (std::vector<std::string>{"r", "g", "g_big_big", "g_big_small_1", "g_small_1_small_1",
                                      "g_2", "g_4"}));
  EXPECT_EQ(column_names(named(tables, "orientation_distribution")),
            (std::vector<std::string>{"angle", "density", "by_chance"}));
  EXPECT_EQ(column_names(named(tables, "order")),
            (std::vector<std::string>{"time", "nematic", "director", "hexatic"}));
  EXPECT_EQ(named(tables, "pair_correlation").rows(), 150u);  // half of 15 by 0.05
  for (const Table& table : tables)
    for (const Column& column : table.columns) {
      EXPECT_EQ(column.value.size(), table.rows()) << table.name << ' ' << column.name;
      EXPECT_TRUE(column.error.empty() || column.error.size() == table.rows());
      EXPECT_FALSE(column.unit.empty());
    }
}

TEST(StructureTables, OfDisksAreWithoutOrientations) {
  std::vector<Configuration2> frames = gases(3, false);
  for (Configuration2& frame : frames) {
    frame.species_names = {"A"};
    frame.species.assign(60, 0);
    frame.shape.assign(60, {1, 1});
  }
  MemoryTrajectory2 trajectory(frames);
  const std::vector<Table> tables = measure_frames(trajectory, {}, 2).tables;
  ASSERT_EQ(tables.size(), 3u);
  EXPECT_EQ(column_names(named(tables, "structure_factor")),
            (std::vector<std::string>{"q", "s", "modes"}));
  EXPECT_EQ(column_names(named(tables, "pair_correlation")), (std::vector<std::string>{"r", "g"}));
  EXPECT_EQ(column_names(named(tables, "order")), (std::vector<std::string>{"time", "hexatic"}));
}

TEST(StructureTables, DoNotDependOnThreads) {
  MemoryTrajectory2 trajectory(gases(41, true));
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
  std::vector<Configuration2> frames = gases(300, false);
  StructureOptions options;
  options.max_frames = 100;
  std::vector<double> s, orders;
  double pairs = 0, weighted = 0;
  const ScatteringShells shells(frames[0].box.lengths(), options.shells);
  const std::size_t shell = 20;
  double q = 0;
  for (std::size_t k = 0; k < 300; k += 3) {
    const StructureFactor one = shells.direct_structure_factor(frames[k]);
    s.push_back(one.total[shell]);
    q = one.q[shell];
    const PairCorrelation pair = pair_correlation(frames[k], options.pairs);
    if (pair.rotor_pairs[100] > 0) weighted += pair.rotor_pairs[100] * pair.g_2[100];
    pairs += pair.rotor_pairs[100];
    orders.push_back(nematic_order(frames[k]));
  }
  MemoryTrajectory2 trajectory(frames);
  const std::vector<Table> tables = measure_frames(trajectory, options, 2).tables;
  const Table& structure = named(tables, "structure_factor");
  const std::vector<double>& listed = structure.find("q")->value;
  const auto row = static_cast<std::size_t>(
      std::min_element(listed.begin(), listed.end(),
                       [&](double x, double y) { return std::abs(x - q) < std::abs(y - q); }) -
      listed.begin());
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
  MemoryTrajectory2 trajectory(gases(400, true));
  const std::vector<Table> tables = measure_frames(trajectory, {}, 2).tables;
  for (const auto& [table, column] :
       {std::pair{"structure_factor", "s"}, std::pair{"structure_factor", "s_orientation"},
        std::pair{"pair_correlation", "g"}, std::pair{"pair_correlation", "g_big_small_1"}}) {
    const Column& values = *named(tables, table).find(column);
    double chi_squared = 0, rows = 0;
    for (std::size_t k = 0; k < values.value.size(); ++k) {
      if (!(values.error[k] > 0)) continue;
      chi_squared += std::pow((values.value[k] - 1) / values.error[k], 2);
      ++rows;
    }
    EXPECT_GT(rows, 60) << column;
    EXPECT_NEAR(chi_squared / rows, 1, 5 * std::sqrt(2 / rows)) << column;
  }
  // The larger box has half of 18 by 0.05.
  EXPECT_EQ(named(tables, "pair_correlation").rows(), 180u);
}

TEST(StructureTables, WithoutFramesThereIsOrderOnly) {
  MemoryTrajectory2 trajectory(gases(10, false));
  const std::vector<Table> tables = measure_frames(trajectory, {0, {}, {}}, 1).tables;
  ASSERT_EQ(tables.size(), 1u);
  EXPECT_EQ(tables.front().name, "order");
  EXPECT_EQ(tables.front().rows(), 10u);
}

}  // namespace
}  // namespace vitrel
