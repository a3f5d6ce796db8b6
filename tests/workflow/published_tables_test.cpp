// What publications say beside the results of a sweep.
#include "workflow/sweep/published_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace vitrel {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::NanSensitiveDoubleEq;

constexpr double infinite = std::numeric_limits<double>::infinity();
const std::string particles = "system.particles";

Published value(const std::string& source, double value) {
  return {source, "wall_seconds", value, false, -infinite, infinite};
}

Published power(double exponent, double from, double to) {
  return {"article", "wall_seconds", exponent, true, from, to};
}

/// Jobs with so many particles, each of which took 3 N^1.5 seconds, give or take; two seeds.
std::vector<SeedAverage> averages(const std::vector<int>& numbers,
                                  const std::vector<std::vector<Published>>& published) {
  std::vector<JobResult> jobs;
  for (std::size_t k = 0; k < numbers.size(); ++k)
    for (const double deviation : {-0.5, 0.5})
      jobs.push_back(
          {{{particles, std::to_string(numbers[k])}, {seed_key, deviation < 0 ? "1" : "2"}},
           {{"wall_seconds", 3 * std::pow(numbers[k], 1.5) + deviation}},
           published[k]});
  return seed_averages(jobs);
}

std::vector<Table> tables(const std::vector<SeedAverage>& averages) {
  std::vector<SweptValues> values;
  for (const SeedAverage& average : averages) values.push_back(average.values);
  return published_tables(averages, study_axes(study_keys(values), {}));
}

TEST(PublishedTables, HaveAValueAndTheAverageOfItsJobsInEveryRow) {
  const auto found =
      tables(averages({4, 16}, {{value("A", 25), value("B", 26)}, {value("A", 190)}}));
  ASSERT_EQ(found.size(), 1u);
  const Table& table = found[0];
  EXPECT_EQ(table.name, "published");
  EXPECT_THAT(table.find("system_particles")->value, ElementsAre(4, 4, 16));
  EXPECT_THAT(table.find("source")->value, ElementsAre(0, 1, 0));
  EXPECT_THAT(table.find("source")->labels, ElementsAre("A", "B"));
  EXPECT_THAT(table.find("quantity")->labels, ElementsAre("wall_seconds"));
  EXPECT_THAT(table.find("published")->value, ElementsAre(25, 26, 190));
  EXPECT_THAT(table.find("measured")->value, ElementsAre(24, 24, 192));
  EXPECT_GT(table.find("measured")->error[2], 0.5);
}

TEST(PublishedTables, HaveTheSlopeOfTheAveragesWhereAPowerLawHolds) {
  const std::vector<Published> laws = {power(1, -infinite, 100), power(2, 20, infinite),
                                       power(3, 300, 1000)};
  const auto found = tables(averages({10, 30, 100, 300}, {laws, laws, laws, laws}));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].name, "published_exponents");
  EXPECT_THAT(found[0].find("from")->value, ElementsAre(10, 20, 300));
  EXPECT_THAT(found[0].find("to")->value, ElementsAre(100, 300, 300));
  EXPECT_THAT(found[0].find("published")->value, ElementsAre(1, 2, 3));
  EXPECT_THAT(found[0].find("measured")->value,
              ElementsAre(DoubleNear(1.5, 1e-12), DoubleNear(1.5, 1e-12),
                          NanSensitiveDoubleEq(std::nan(""))));
}

TEST(PublishedTables, AreLeftOutWithoutRows) {
  EXPECT_THAT(tables(averages({10, 20}, {{}, {}})), IsEmpty());
}

}  // namespace
}  // namespace vitrel
