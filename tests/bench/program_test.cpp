// vitrel-bench from outside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/reference/literature.h"
#include "bench/studies/study.h"
#include "tests/app/program.h"

namespace vitrel::bench {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing_program::Folder;
using testing_program::Outcome;
using testing_program::run;
using testing_program::run_and_signal;

/// What a study prints as JSON; by part, its rows.
Json numbers(const Folder& folder, std::vector<std::string> words) {
  words.insert(words.end(), {"--json", "-q"});
  const Outcome outcome = run(folder.path(), words);
  EXPECT_EQ(outcome.code, 0) << outcome.errors;
  EXPECT_EQ(outcome.errors, "");
  return Json::parse(outcome.output);
}
Json numbers(const std::vector<std::string>& words) {
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  return numbers(Folder(std::string(test.test_suite_name()) + "_" + test.name()), words);
}

void expect_keys(const Json& of, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) EXPECT_TRUE(of.contains(key)) << key;
}

const Json& rows_of(const Json& found, const std::string& part) {
  for (const Json& one : found["parts"])
    if (one["name"] == part) return one["rows"];
  throw std::runtime_error("no part " + part);
}

TEST(BenchContactTime, PrintsRowsWithTheKeysOfTheManual) {
  const Json found = numbers({"contact-time", "plane", "--pairs", "30", "--class", "generic",
                              "--method", "separating_axis", "slsqp"});
  const Json& rows = found["parts"][0]["rows"];
  ASSERT_EQ(rows.size(), 4u);  // two methods, generic at two aspect ratios
  for (const Json& row : rows) {
    expect_keys(row, {"tolerance", "degenerate", "median_error", "largest_gap_error",
                      "largest_moot_gap", "contacts"});
    EXPECT_GT(row["ns_per_call"], 1.0);
    int answers = 0;
    for (const char* const key : {"correct", "early", "late", "missed", "false", "not_converged"})
      answers += row[key].get<int>();
    EXPECT_EQ(answers, row["pairs"]);
  }
  EXPECT_EQ(rows[0]["method"], "separating_axis");
  EXPECT_EQ(rows[0]["correct"], 30);
  EXPECT_LT(rows[0]["largest_error"], 1e-12);
}

TEST(BenchContactTime, AllowsErrorsOfTimesAndGapsByTheirTolerances) {
  const auto row = [&](const std::vector<std::string>& tolerances) {
    std::vector<std::string> words = {"collision-time", "plane", "--pairs",  "60",
                                      "--class",        "slow",  "--method", "separating_axis"};
    words.insert(words.end(), tolerances.begin(), tolerances.end());
    return numbers(words)["parts"][0]["rows"][0];
  };
  // All contacts of this class are degenerate: declared at a gap of about one contact gap, early.
  const Json lenient = row({"--tolerance", "1e-12", "--gap-tolerance", "1e-8"});
  EXPECT_EQ(lenient["correct"], 60);
  EXPECT_GT(lenient["contacts"], 10);
  EXPECT_EQ(lenient["contacts"], lenient["degenerate"]);
  EXPECT_GT(lenient["largest_moot_gap"], 0.7);
  EXPECT_LT(lenient["largest_moot_gap"], 1.4);
  const Json strict = row({"--tolerance", "1e-15"});
  EXPECT_EQ(strict["early"], strict["contacts"]);
}

TEST(BenchContactTime, WritesPageTablesAndNumbers) {
  const Folder folder("bench_page");
  const Outcome outcome = run(folder.path(), {"contact-time", "--pairs", "40", "--seconds", "0.2",
                                              "--class", "generic", "recorded", "-o", "out"});
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("## plane"), HasSubstr("recorded, κ = 2"),
                                    HasSubstr("## passing_pair")));
  const Json data = Json::parse(folder.read("out/contact-time.json"));
  ASSERT_EQ(data["parts"].size(), 6u);
  for (const Json& part : data["parts"]) EXPECT_GT(part["rows"].size(), 3u) << part["name"];
  const Json& scene = data["parts"][2]["rows"];
  ASSERT_EQ(scene[1]["method"], "separating_axis");
  EXPECT_NEAR(scene[1]["time"], 0.08472238582199765, 1e-13);
  expect_keys(data["provenance"], {"command", "commit", "processor", "compiler", "flags", "date"});
  ASSERT_FALSE(data["more"]["failures"].empty());
  for (const Json& failure : data["more"]["failures"]) {
    EXPECT_NE(failure["method"], "separating_axis");
    const std::string command = failure["command"];
    EXPECT_THAT(command, testing::StartsWith("vitrel pair path --body 'semi_axes="));
  }
  const std::string page = folder.read("out/contact-time.html");
  EXPECT_THAT(page, AllOf(HasSubstr("default-src 'none'"), HasSubstr("plane_tolerances"),
                          testing::Not(HasSubstr(" src="))));
  EXPECT_THAT(folder.read("out/contact-time.md"), HasSubstr(outcome.output.substr(0, 200)));
}

TEST(BenchWholeRun, NeedsNoCorrectionsWithTheDefaultMethod) {
  const Folder folder("bench_whole_run");
  const Json rows = numbers(folder, {"whole-run", "--duration", "1", "--method", "separating_axis",
                                     "psi_root", "-o", "run.json"})["parts"][0]["rows"];
  ASSERT_EQ(rows.size(), 12u);  // two methods, six tolerances
  for (const Json& row : rows) {
    EXPECT_NEAR(row["simulated_time"], 1, 1e-9);
    EXPECT_GT(row["collisions"], 100);
    EXPECT_LT(row["energy_drift"], 1e-13);
    EXPECT_FALSE(row["stood_still"]);
    if (row["method"] == "separating_axis") {
      EXPECT_EQ(row["correction_moves"], 0);
      EXPECT_EQ(row["deepest_overlap"], 0);
    }
  }
  EXPECT_EQ(Json::parse(folder.read("run.json"))["parts"][0]["rows"], rows);
}

TEST(BenchThesis, ComparesThreePrograms) {
  const Json found = numbers({"thesis", "--quick", "--duration", "0.5", "--seconds", "0.1"});
  const Json& rows = found["parts"][0]["rows"];
  ASSERT_EQ(rows.size(), 24u);  // N = 16 and 25; ellipses and circles; three programs; two dynamics
  for (const Json& row : rows) {
    EXPECT_GT(row["collisions"], 0);
    EXPECT_GT(row["ns_per_time"], 0);
    if (row["method"] != "vitrel") continue;
    EXPECT_NEAR(row["simulated_time"], 0.5 * 400 / row["particles"].get<int>(), 0.1);
    EXPECT_EQ(row["correction_moves"], 0);
    EXPECT_NEAR(row["samples"], 10 * row["simulated_time"].get<double>(), 1e-6);
    EXPECT_EQ(row["samples_with_overlap"], 0);
    EXPECT_LT(row["energy_drift"], 1e-13);
  }
}

TEST(BenchEngine, CountsMakeSense) {
  const Json found = numbers({"engine", "speed", "gases", "calendar", "--quick"});
  for (const Json& row : found["parts"][0]["rows"]) {
    if (row["method"] != "engine") continue;
    // A collision is one event; a few more find that their partner has met another.
    EXPECT_GT(row["events"], 1) << row;
    EXPECT_LT(row["events"], 3) << row;
    EXPECT_GT(row["predictions"], 8) << row;
    EXPECT_LT(row["searches"], row["predictions"]) << row;
    if (row["shape"] == "disks" && row["packing_fraction"] == 0.5) {
      EXPECT_NEAR(row["z"], fluid_pressure(1, 0.5).z, 0.3);
    }
  }
  EXPECT_EQ(found["parts"][2]["rows"].size(), 4u);  // two calendars, 100 and 1000 particles
}

TEST(BenchSampling, AllMethodsAgreeAndForget) {
  const Json found = numbers({"sampling", "--quick"});
  std::map<std::string, std::vector<double>> z;
  for (const Json& row : found["parts"][0]["rows"]) {
    EXPECT_TRUE(row["z_error"].is_null() || row["z_error"] > 0) << row;  // no error: too short
    if (row["packing_fraction"] == 0.3 && row["shape"] == "disks") {
      EXPECT_NEAR(row["z"], 2.0, 0.3) << row;  // 64 particles, a twentieth of a second
    }
  }
  for (const Json& row : rows_of(found, "structure")) {
    if (row["packing_fraction"] == 0.3 && row["shape"] == "disks") {
      EXPECT_NEAR(row["longest_s"], 0.25, 0.1)
          << row;  // that of scaled-particle theory at q = 0: 0.264
      EXPECT_GT(row["peak_s"], row["longest_s"]);
    }
  }
  for (const Json& row : rows_of(found, "forgetting")) {
    EXPECT_FALSE(row.contains("orientations") && row["liquid"] != "ellipses");
    if (row.contains("exchanges_accepted")) {
      EXPECT_GT(row["exchanges_accepted"], 0);
      EXPECT_LT(row["exchanges_accepted"], 1);
    }
  }
  for (const Json& row : rows_of(found, "threads")) EXPECT_GT(row["ns_per_trial"], 0);
}

TEST(BenchDense, GrowthReachesWhatItIsAskedFor) {
  const Json found = numbers({"dense", "density", "--quick"});
  for (const Json& row : rows_of(found, "density")) {
    const double wanted = row["packing_fraction"], reached = row["reached"];
    EXPECT_EQ(row.contains("ns"), row["end"] == "reached") << row;
    if (row["method"] == "grow, rate 1e-3") {
      EXPECT_NEAR(reached, wanted, 1e-9) << row;
    }
  }
}

TEST(BenchBrownianStep, LongStepsSlowDownAndCostLess) {
  const Json found = numbers({"brownian-step", "--quick"});
  const Json& rows = rows_of(found, "relaxation");
  ASSERT_EQ(rows.size(), 3u);  // τ_B = 0.1, 0.3 and 1
  EXPECT_FALSE(rows[0].contains("error"));
  EXPECT_GT(rows[2]["deviation"], 0.3);
  EXPECT_LT(rows[2]["ns"], rows[0]["ns"]);
}

TEST(BenchAnalysis, AgreesWithPlainLoopsAndSums) {
  const Json found = numbers({"analysis", "--quick"});
  for (const Json& row : found["parts"][0]["rows"])
    if (row["method"] == "vitrel") {
      EXPECT_LT(row["difference"], 1e-9) << row;
    }
  const Json& estimators = rows_of(found, "estimators");
  const auto error = [&](const char* method) -> double {
    const auto is = [&](const Json& row) { return row["method"] == method; };
    return (*std::ranges::find_if(estimators, is))["error"];
  };
  EXPECT_NEAR(error("transforms"), error("all origins"), 1e-9);
  for (const Json& row : rows_of(found, "structure_factor"))
    if (row["method"] == "transform") {
      EXPECT_LE(row["share_of_bound"], 1) << row;
    }
}

TEST(BenchSoftContacts, TablesAreAsAccurateAsTheySay) {
  const Json found = numbers({"soft-contacts", "accuracy", "--quick"});
  std::map<double, double> errors;  // of tables, by their tolerance
  for (const Json& row : found["parts"][0]["rows"])
    if (row["method"] == "tables") errors[row["parameter"]] = row["median"];
  EXPECT_EQ(errors.size(), 4u);
  EXPECT_LT(errors[1e-8], errors[1e-2]);
}

TEST(Bench, RefusesUnknownNamesAndSaysWhichThereAre) {
  const Folder folder("bench_names");
  folder.write("file", "");
  const auto expect_mistake = [&](const std::vector<std::string>& words, const std::string& says,
                                  int code = 2) {
    const Outcome outcome = run(folder.path(), words);
    EXPECT_EQ(outcome.code, code);
    EXPECT_THAT(outcome.errors, HasSubstr(says));
  };
  expect_mistake({"contact-time", "--method", "magic"}, "separating_axis");
  expect_mistake({"contact-time", "--class", "easy"}, "generic,");
  expect_mistake({"overlap", "--method", "magic"}, "vieillard_baron");
  expect_mistake({"whole-run", "--method", "nelder_mead"}, "psi_root");
  expect_mistake({"engine", "spede", "--quick"}, "speed");
  expect_mistake({"whole-run", "--duration", "0"}, "--duration");
  expect_mistake({"contact-time", "--pairs", "0"}, "--pairs");
  expect_mistake({"thesis", "-o", "file/output"}, "file/output: the folder cannot be made", 3);
}

TEST(Bench, StopsOnASignalWithTheRowsDone) {
  const Folder folder("bench_stop");
  const Outcome outcome =
      run_and_signal(folder.path(), {"contact-time", "--pairs", "100000000", "-o", "out"},
                     std::chrono::milliseconds(1500), SIGTERM);
  EXPECT_EQ(outcome.code, 5) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("generic"));
  EXPECT_THAT(outcome.errors, HasSubstr("no files were written"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(Bench, ListsItsStudies) {
  const Folder folder("bench_list");
  const Outcome outcome = run(folder.path(), {});
  EXPECT_EQ(outcome.code, 0);
  for (const Study& study : studies()) EXPECT_THAT(outcome.output, HasSubstr("\n  " + study.name));
}

TEST(Bench, StudiesHaveAQuestionAndPartsWithNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const Study& study : studies()) {
    EXPECT_TRUE(study.question.ends_with("?"));
    EXPECT_TRUE(names.insert(study.name).second);
    for (const Alias& alias : study.aliases) EXPECT_TRUE(names.insert(alias.name).second);
    std::set<std::string> parts;
    for (const Part& part : study.parts) {
      EXPECT_TRUE(parts.insert(part.name).second);
      EXPECT_TRUE(part.about.ends_with(".")) << part.name;
    }
    for (const Alias& alias : study.aliases)
      for (const std::string& part : alias.parts) EXPECT_TRUE(parts.contains(part)) << part;
  }
}

}  // namespace
}  // namespace vitrel::bench
