#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "analysis/observables/frame_observable.h"
#include "analysis/statistics/blocking.h"
#include "analysis/structure/pair_correlation.h"
#include "tests/support/random_gas.h"
#include "tests/support/scenes.h"
#include "tests/support/tables.h"

namespace vitrel {
namespace {

using testing::ElementsAre;

void make_rotor(Configuration2& c, std::size_t i, Stream& draw) {
  c.shape[i] = of_aspect_ratio(2);
  c.angle[i] = draw.uniform(-3, 3);
}
void make_rotor(Configuration3& c, std::size_t i, Stream& draw) {
  c.shape[i].semi_axes = Vec3(1, 1, 2);
  const double angle = draw.uniform(-3, 3);
  c.orientation[i] = Quaternion(Eigen::AngleAxisd(angle, Vec3::UnitX()));
}

/// Ideal gases of 80 particles, none of species "none", one of species "one".
template <int Dim>
std::vector<Configuration<Dim>> gases(std::size_t frames, bool round) {
  Stream draw(8, Purpose::tests);
  std::vector<Configuration<Dim>> all;
  for (std::size_t k = 0; k < frames; ++k) {
    const Vec<Dim> lengths = Vec<Dim>::Constant(20);
    all.push_back(random_gas(80, lengths, draw, [&](Configuration<Dim>& c, std::size_t i) {
      c.species[i] = i == 0 ? 2 : i % 2 ? 0 : 3;
      if (!round) make_rotor(c, i, draw);
    }));
    all.back().time = static_cast<double>(k);
    all.back().species_names = {"big", "none", "one", "small-1"};
  }
  return all;
}

template <int Dim>
std::vector<Table> pair_tables(const std::vector<Configuration<Dim>>& frames) {
  MemoryTrajectory<Dim> trajectory(frames);
  StructureOptions options;
  options.pairs.distance_step = 0.5;
  return measure_frames(trajectory, options, 2, {}, {"pair_correlation"}).tables;
}

TEST(PairCorrelationObservable, HasColumnsOfThePairsOfSpeciesThatThereAre) {
  EXPECT_THAT(column_names(pair_tables(gases<2>(2, false)).front()),
              ElementsAre("r", "g", "g_big_big", "g_big_one", "g_big_small_1", "g_one_small_1",
                          "g_small_1_small_1", "g_2", "g_4"));
  EXPECT_THAT(column_names(pair_tables(gases<3>(2, true)).front()),
              ElementsAre("r", "g", "g_big_big", "g_big_one", "g_big_small_1", "g_one_small_1",
                          "g_small_1_small_1"));
  std::vector<Configuration3> alone = gases<3>(2, true);
  for (Configuration3& frame : alone) frame.species.assign(80, 3);
  EXPECT_THAT(column_names(pair_tables(alone).front()), ElementsAre("r", "g"));
}

TEST(PairCorrelationByAngleObservable, HasAColumnForEveryBinOfTheAngle) {
  EXPECT_THAT(column_names(pair_tables(gases<2>(2, false)).at(1)),
              ElementsAre("r", "g_theta_05", "g_theta_15", "g_theta_25", "g_theta_35", "g_theta_45",
                          "g_theta_55", "g_theta_65", "g_theta_75", "g_theta_85"));
  EXPECT_THAT(column_names(pair_tables(gases<3>(2, false)).at(1)),
              ElementsAre("r", "g_cos_theta_95", "g_cos_theta_85", "g_cos_theta_75",
                          "g_cos_theta_65", "g_cos_theta_55", "g_cos_theta_45", "g_cos_theta_35",
                          "g_cos_theta_25", "g_cos_theta_15", "g_cos_theta_05"));
}

TEST(PairCorrelationByAngleObservable, IsLeftOutIfAllAreRound) {
  EXPECT_EQ(pair_tables(gases<2>(2, true)).size(), 1u);
  EXPECT_EQ(pair_tables(gases<3>(2, true)).size(), 1u);
}

/// The mean of the frames and its error in the tenth bin, r = 4.75, of a column.
void expect_average(const Table& table, const std::string& name,
                    const std::vector<double>& of_frames) {
  const Column* column = table.find(name);
  ASSERT_TRUE(column) << name;
  EXPECT_EQ(column->unit, "1");
  EXPECT_EQ(table.find("r")->value[9], 4.75);
  const Estimate expected = slow_average(of_frames);
  EXPECT_GT(expected.error, 0);
  EXPECT_NEAR(column->value[9], expected.mean, 1e-12);
  EXPECT_NEAR(column->error[9], expected.error, 1e-12);
}

template <int Dim>
void expect_averages(const std::string& first, const std::string& last) {
  const std::vector<Configuration<Dim>> frames = gases<Dim>(40, false);
  const std::vector<Table> tables = pair_tables(frames);
  std::vector<double> big, unlike, along, across;
  for (const Configuration<Dim>& frame : frames) {
    const PairCorrelation pairs = pair_correlation(frame, {20, 0.5});
    big.push_back(pairs.partial.at(0).at(9));
    unlike.push_back(pairs.partial.at(3).at(9));
    const PairCorrelationByAngle by_angle = pair_correlation_by_angle(frame, {20, 0.5});
    along.push_back(by_angle.g.front().at(9));
    across.push_back(by_angle.g.back().at(9));
  }
  expect_average(tables[0], "g_big_big", big);
  expect_average(tables[0], "g_big_small_1", unlike);
  expect_average(tables[1], first, along);
  expect_average(tables[1], last, across);
}

TEST(PairCorrelationObservable, AveragesFrames) {
  expect_averages<2>("g_theta_05", "g_theta_85");
  expect_averages<3>("g_cos_theta_95", "g_cos_theta_05");
}

/// The labels of the chart of that table, whose columns are all there.
template <int Dim>
std::vector<std::string> drawn(const std::string& name) {
  const std::vector<Observable> all = frame_observables(Dim);
  const std::vector<Table> tables = pair_tables(gases<Dim>(2, false));
  const Table& table = named(tables, name);
  const Chart& chart = find(all, name)->charts.at(0);
  std::vector<std::string> labels;
  for (const Curve& curve : chart.curves) {
    EXPECT_TRUE(table.find(curve.column)) << curve.column;
    labels.push_back(curve.label);
  }
  EXPECT_TRUE(table.find(chart.x));
  return labels;
}

TEST(PairCorrelationByAngleObservable, IsDrawnByTheAngle) {
  EXPECT_THAT(drawn<2>("pair_correlation_by_angle"),
              ElementsAre("θ = 5°", "θ = 25°", "θ = 45°", "θ = 65°", "θ = 85°"));
  EXPECT_THAT(drawn<3>("pair_correlation_by_angle"),
              ElementsAre("cos θ = 0.95", "cos θ = 0.65", "cos θ = 0.35", "cos θ = 0.05"));
}

}  // namespace
}  // namespace vitrel
