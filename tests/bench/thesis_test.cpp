// vitrel-bench thesis from outside, and the exponent that it fits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "bench/programs/thesis.h"
#include "bench/surveys/thesis_run.h"
#include "tests/app/program.h"
#include "tests/support/scenes.h"

namespace vitrel::bench {
namespace {

using testing_program::Folder;
using testing_program::Outcome;
using testing_program::run;
using Json = nlohmann::json;

std::string content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

// Disks fill π/4 of a square lattice; κ = √3 at 45° reaches the triangular lattice's π/(2√3), and
// θ and −θ are mirror images (thesis, figure 4.5).
TEST(BenchThesis, DensestSquareLattices) {
  constexpr double pi = std::numbers::pi;
  EXPECT_NEAR(densest_square_lattice({1, 1}, 0.3), pi / 4, 1e-14);
  EXPECT_NEAR(densest_square_lattice(of_aspect_ratio(std::sqrt(3.0)), pi / 4),
              pi / (2 * std::sqrt(3.0)), 1e-14);
  EXPECT_NEAR(densest_square_lattice(of_aspect_ratio(2), 0), pi / 8, 1e-14);
  for (double angle : {0.1, 0.5, 0.7})
    EXPECT_NEAR(densest_square_lattice(of_aspect_ratio(3), angle),
                densest_square_lattice(of_aspect_ratio(3), -angle), 1e-13);
}

TEST(BenchThesis, PrintsAndWrites) {
  const Folder folder("bench_thesis");
  const Outcome outcome =
      run(folder.path(), {"thesis", "--duration", "0.5", "--seconds", "0.1", "--largest", "25",
                          "--runs", "2", "--json", "-q", "-o", "out"});
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  const Json rows = Json::parse(outcome.output)["rows"];
  ASSERT_EQ(rows.size(), 24u);  // N = 16 and 25; ellipses and circles; three programs; two dynamics
  for (const Json& row : rows) {
    for (const char* const key : {"predictions", "energy_drift", "deepest_overlap", "stood_still"})
      EXPECT_TRUE(row.contains(key)) << key;
    EXPECT_GT(row["collisions"], 0);
    EXPECT_GT(row["seconds"], 0);
    if (row["program"] != "vitrel") continue;
    EXPECT_NEAR(row["simulated_time"], 0.5 * 400 / row["particles"].get<int>(), 0.1);
    EXPECT_EQ(row["correction_moves"], 0);
    EXPECT_NEAR(row["samples"], 10 * row["simulated_time"].get<double>(), 1e-6);
    EXPECT_EQ(row["samples_with_overlap"], 0);
    EXPECT_LT(row["energy_drift"], 1e-13);
  }
  const Json data = Json::parse(content(folder / "out/thesis.json"));
  EXPECT_EQ(data["rows"], rows);
  EXPECT_EQ(data["exponents"].size(), 6u);
  EXPECT_EQ(data["by_aspect_ratio"].size(), 18u);
  EXPECT_EQ(data["energies"].size(), 6u);
  EXPECT_EQ(data["relaxations"].size(), 6u);
  EXPECT_TRUE(data["provenance"].contains("commit"));
}

TEST(BenchThesis, RefusesNonsense) {
  const Folder folder("bench_thesis_nonsense");
  EXPECT_EQ(run(folder.path(), {"thesis", "--seconds", "0"}).code, 2);
  EXPECT_EQ(run(folder.path(), {"thesis", "--largest", "-1"}).code, 2);
  EXPECT_EQ(run(folder.path(), {"thesis", "--runs", "0"}).code, 2);
}

ThesisRow row_with(int particles, double seconds_per_time) {
  ThesisRow row{Program::thesis, {particles, 2}, 0, {}};
  row.run.simulated_time = 4;
  row.run.seconds = 4 * seconds_per_time;
  return row;
}

TEST(GrowthExponent, IsThatOfAPowerLaw) {
  std::vector<ThesisRow> rows;
  for (const int particles : {9, 25, 100})
    rows.push_back(row_with(particles, 3e-3 * particles * particles));
  EXPECT_NEAR(growth_exponent(rows, Program::thesis, 2), 2, 1e-12);
  EXPECT_TRUE(std::isnan(growth_exponent(rows, Program::ours, 2)));
}

}  // namespace
}  // namespace vitrel::bench
