// vitrel-bench pair from outside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/methods/method.h"
#include "tests/app/program.h"

namespace vitrel::bench {
namespace {

using testing::HasSubstr;
using testing_program::expect_refusal;
using testing_program::Folder;
using testing_program::Outcome;
using testing_program::run;
using Json = nlohmann::json;

// Appendix B.1 of the thesis.
const std::string thesis_pair =
    "[[body]]\nsemi_axes = [1, 0.5]\n[[body]]\nsemi_axes = [1, 0.5]\nposition = [1, 1]\n"
    "velocity = [-1, 0]\nangular_velocity = 3.141592653589793\n";
constexpr double thesis_time = 0.08472238582199765;

const std::string tumbling_pair =
    "[[body]]\nsemi_axes = [2, 1, 1.5]\nangular_velocity = [1, 0.3, 0.1]\n[[body]]\n"
    "semi_axes = [2, 1, 1]\nposition = [5, 0.5, 0]\nvelocity = [-1, 0, 0]\n";

class BenchPair : public testing::Test {
 protected:
  Json rows(std::vector<std::string> words) const {
    words.insert(words.begin(), "pair");
    words.push_back("--json");
    const Outcome outcome = run(folder_.path(), words);
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
    return Json::parse(outcome.output, nullptr, false)["rows"];
  }

  Folder folder_{"bench_pair"};
};

TEST_F(BenchPair, EveryMethodFindsTheContactOfTheThesis) {
  const Json found = rows({thesis_pair});
  ASSERT_EQ(found.size(), collision_time_methods().size());
  EXPECT_EQ(found[0]["method"], "separating_axis");
  EXPECT_NEAR(found[0]["time"], thesis_time, 1e-13);
  for (const Json& row : found) {
    SCOPED_TRACE(row["method"]);
    EXPECT_GT(row["ns_per_call"], 1);
    if (row["method"] == "circles") {  // made for circles
      EXPECT_EQ(row["outcome"], "no answer");
      EXPECT_TRUE(row["time"].is_null());
      continue;
    }
    EXPECT_EQ(row["outcome"], "contact");
    const double tolerance = row["method"] == "simulated_annealing" ? 1e-2 : 1e-8;
    EXPECT_NEAR(row["time"], thesis_time, tolerance);
    EXPECT_EQ(row["difference"], row["time"].get<double>() - found[0]["time"].get<double>());
  }
}

TEST_F(BenchPair, EllipsoidsTumbleForEveryMethod) {
  const Json found = rows({tumbling_pair});
  ASSERT_EQ(found.size(), collision_time_methods<3>().size());
  const Json constant = rows({"rotation = \"constant\"\n" + tumbling_pair});
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_NEAR(found[k]["difference"], 0, 1e-12);
    EXPECT_NEAR(constant[k]["difference"], 0, 1e-12);
    EXPECT_GT(std::abs(found[k]["time"].get<double>() - constant[k]["time"].get<double>()), 1e-3);
  }
}

TEST_F(BenchPair, ShowsTheDefaultBesideTheMethodsAskedFor) {
  const Json found = rows({thesis_pair, "--method", "slsqp", "psi_root"});
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0]["method"], "separating_axis");
  EXPECT_EQ(found[1]["method"], "slsqp");
  EXPECT_EQ(found[2]["method"], "psi_root");
  const Outcome text = run(folder_.path(), {"pair", thesis_pair, "--method", "psi_root"});
  EXPECT_THAT(text.output, testing::ContainsRegex("psi_root +contact +0.08472238582"));
  const Json none = rows({"horizon = 0.01\n" + thesis_pair, "--method", "psi_root"});
  EXPECT_EQ(none[1]["outcome"], "no contact");
  EXPECT_TRUE(none[1]["difference"].is_null());
  const Outcome whole =
      run(folder_.path(), {"pair", thesis_pair, "--method", "psi_root", "--json"});
  const Json overlap = Json::parse(whole.output)["overlap"];
  EXPECT_EQ(overlap["found"], false);
  EXPECT_GT(overlap["ns_per_call"], 1);
}

// In a box of 8, the disk of radius 1 that leaves to the right comes back from the left.
TEST_F(BenchPair, AsksAboutAllImages) {
  const Json found =
      rows({"box = [8, 8]\n[[body]]\nsemi_axes = [1, 1]\n[[body]]\n"
            "semi_axes = [1, 1]\nposition = [3, 0]\nvelocity = [1, 0]\n"});
  for (const Json& row : found)
    EXPECT_NEAR(row["time"], 3, row["method"] == "simulated_annealing" ? 0.1 : 1e-7) << row;
}

TEST_F(BenchPair, RefusesUnknownMethodsAndBadPairs) {
  expect_refusal(run(folder_.path(), {"pair", thesis_pair, "--method", "guess"}), 2,
                 "vitrel-bench pair: there is no method \"guess\"; known are separating_axis,");
  expect_refusal(run(folder_.path(), {"pair", thesis_pair + "spin = 1\n"}), 2,
                 "pair:8:1: key 'body.1.spin' is unknown");
}

}  // namespace
}  // namespace vitrel::bench
