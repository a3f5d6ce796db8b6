// vitrel-bench from outside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bench/programs/number_text.h"
#include "tests/app/program.h"

namespace vitrel::bench {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing_program::Folder;
using testing_program::Outcome;
using testing_program::run;
using testing_program::run_and_signal;
using Json = nlohmann::json;

std::string content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t times = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size())
    ++times;
  return times;
}

/// The data inside a page.
Json data_of(const std::string& page) {
  const std::string opening = "<script type=\"application/json\" id=\"data\">";
  const std::size_t begin = page.find(opening) + opening.size();
  return Json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

TEST(BenchThesis, TheOutputIsLookedAtFirst) {
  const Folder folder("bench_output");
  folder.write("file", "");
  const Outcome outcome = run(folder.path(), {"thesis", "-o", "file/output"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.errors, HasSubstr("file/output: the folder cannot be made"));
}

TEST(BenchCollisionTime, PrintsRowsWithTheKeysOfTheManual) {
  const Folder folder("bench_rows");
  const Outcome outcome =
      run(folder.path(), {"collision-time", "--pairs", "30", "--class", "generic", "--method",
                          "separating_axis", "slsqp", "--json", "-q"});
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  EXPECT_EQ(outcome.errors, "");
  const Json rows = Json::parse(outcome.output)["rows"];
  ASSERT_EQ(rows.size(), 4u);  // two methods, generic at two aspect ratios
  for (const Json& row : rows) {
    for (const char* const key :
         {"method", "class", "aspect_ratio", "pairs", "correct", "early", "late", "missed", "false",
          "not_converged", "ns_per_call", "largest_error", "tolerance", "degenerate",
          "median_error", "largest_gap_error", "largest_moot_gap", "contacts"})
      EXPECT_TRUE(row.contains(key)) << key;
    EXPECT_EQ(row["class"], "generic");
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

TEST(BenchCollisionTime, AllowsErrorsOfTimesAndGapsByTheirTolerances) {
  const Folder folder("bench_tolerance");
  const auto row = [&](const std::vector<std::string>& tolerances) {
    std::vector<std::string> words = {"collision-time",  "--pairs", "60",
                                      "--class",         "slow",    "--method",
                                      "separating_axis", "--json",  "-q"};
    words.insert(words.end(), tolerances.begin(), tolerances.end());
    return Json::parse(run(folder.path(), words).output)["rows"][0];
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

TEST(BenchCollisionTime, WritesPageChartsAndData) {
  const Folder folder("bench_page");
  const Outcome outcome =
      run(folder.path(), {"collision-time", "--pairs", "40", "--seconds", "0.2", "--duration",
                          "0.1", "--class", "generic", "recorded", "-o", "out"});
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("separating_axis (tolerance"), HasSubstr("generic"),
                                    HasSubstr("recorded")));
  const std::filesystem::path out = folder / "out";
  const Json data = Json::parse(content(out / "collision-time.json"));
  EXPECT_GT(data["rows"].size(), 10u);
  EXPECT_GT(data["tolerances"].size(), 10u);
  EXPECT_GT(data["overlap"].size(), 10u);
  EXPECT_GT(data["whole_runs"].size(), 10u);
  ASSERT_EQ(data["scene"][1]["method"], "separating_axis");
  EXPECT_NEAR(data["scene"][1]["time"], 0.08472238582199765, 1e-13);
  EXPECT_THAT(data["provenance"]["command"], HasSubstr("vitrel-bench collision-time --pairs 40"));
  ASSERT_FALSE(data["failures"].empty());
  for (const Json& failure : data["failures"]) {
    EXPECT_NE(failure["method"], "separating_axis");
    EXPECT_THAT(failure["caption"], testing::Not(testing::IsEmpty()));
    ASSERT_FALSE(failure["pictures"].empty());
    EXPECT_EQ(failure["pictures"][0]["title"], "start");
    for (const Json& picture : failure["pictures"]) EXPECT_EQ(picture["ellipses"].size(), 2u);
  }
  const std::string page = content(out / "collision-time.html");
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_EQ(count(page, " src="), 0u);
  EXPECT_EQ(data_of(page), data);
}

TEST(BenchCollisionTimeOfEllipsoids, WritesPageAndData) {
  const Folder folder("bench_ellipsoids");
  const Outcome outcome =
      run(folder.path(), {"collision-time-of-ellipsoids", "--pairs", "20", "--seconds", "0.1",
                          "--class", "generic", "-q", "-o", "out"});
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  const Json data = Json::parse(content(folder / "out/collision-time.json"));
  EXPECT_EQ(data["rows"].size(), 6u);  // three methods, generic at two aspect ratios
  EXPECT_EQ(data["passing_pair"]["eta1"]["curve"]["time"].size(), 401u);
  EXPECT_GE(data["passing_pair"]["eta1"]["scan"]["time"].size(), 3u);
  EXPECT_EQ(data_of(content(folder / "out/collision-time.html")), data);
}

TEST(BenchOverlap, PrintsAndWrites) {
  const Folder folder("bench_overlap");
  const Outcome outcome = run(folder.path(), {"overlap", "--pairs", "200", "--seconds", "0.1",
                                              "--json", "-q", "-o", "out"});
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  const Json rows = Json::parse(outcome.output)["rows"];
  EXPECT_EQ(rows.size(), 60u);  // ten criteria, six classes
  for (const Json& row : rows) {
    for (const char* const key : {"method", "class", "aspect_ratio", "pairs", "wrong_overlap",
                                  "wrong_disjoint", "largest_wrong_gap", "ns_per_call"})
      EXPECT_TRUE(row.contains(key)) << key;
    if (row["method"] == "support_gap") {
      EXPECT_EQ(row["wrong_overlap"].get<int>() + row["wrong_disjoint"].get<int>(), 0);
    }
  }
  EXPECT_TRUE(Json::parse(content(folder / "out/overlap.json")).contains("rows"));
  EXPECT_THAT(content(folder / "out/overlap.html"), HasSubstr("polygon_"));
}

TEST(BenchWholeRun, PrintsAndWrites) {
  const Folder folder("bench_whole_run");
  const Outcome outcome =
      run(folder.path(), {"whole-run", "--duration", "1", "--method", "separating_axis", "psi_root",
                          "--json", "-q", "-o", "out"});
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  const Json rows = Json::parse(outcome.output)["rows"];
  ASSERT_EQ(rows.size(), 12u);  // two methods, six tolerances
  for (const Json& row : rows) {
    for (const char* const key :
         {"method", "tolerance", "simulated_time", "collisions", "correction_moves",
          "collisions_per_second", "energy_drift", "deepest_overlap", "stood_still"})
      EXPECT_TRUE(row.contains(key)) << key;
    EXPECT_NEAR(row["simulated_time"], 1, 1e-9);
    EXPECT_GT(row["collisions"], 100);
    EXPECT_LT(row["energy_drift"], 1e-13);
    EXPECT_FALSE(row["stood_still"]);
    if (row["method"] == "separating_axis") {
      EXPECT_EQ(row["correction_moves"], 0);
      EXPECT_EQ(row["deepest_overlap"], 0);
    }
  }
  EXPECT_EQ(Json::parse(content(folder / "out/whole-run.json"))["rows"], rows);
  EXPECT_EQ(data_of(content(folder / "out/whole-run.html"))["whole_runs"], rows);
}

TEST(BenchWholeRun, PrintsATableOfWholeLinesInAHundredColumns) {
  const Folder folder("bench_whole_run_text");
  const Outcome outcome =
      run(folder.path(), {"whole-run", "--duration", "0.5", "--method", "perram_wertheim_root"});
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("perram_wertheim_root\n"), HasSubstr("corrections")));
  std::istringstream lines(outcome.output);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 104u) << line;
}

TEST(Bench, RefusesUnknownNamesAndSaysWhichThereAre) {
  const Folder folder("bench_names");
  const Outcome method = run(folder.path(), {"collision-time", "--method", "magic"});
  EXPECT_EQ(method.code, 2);
  EXPECT_THAT(method.errors, AllOf(HasSubstr("magic"), HasSubstr("separating_axis")));
  const Outcome of = run(folder.path(), {"collision-time", "--class", "easy"});
  EXPECT_EQ(of.code, 2);
  EXPECT_THAT(of.errors, AllOf(HasSubstr("easy"), HasSubstr("generic,")));
  const Outcome criterion = run(folder.path(), {"overlap", "--method", "magic"});
  EXPECT_EQ(criterion.code, 2);
  EXPECT_THAT(criterion.errors, HasSubstr("vieillard_baron"));
  const Outcome runs = run(folder.path(), {"whole-run", "--method", "nelder_mead"});
  EXPECT_EQ(runs.code, 2);
  EXPECT_THAT(runs.errors, HasSubstr("psi_root"));
  EXPECT_EQ(run(folder.path(), {"whole-run", "--duration", "0"}).code, 2);
  EXPECT_EQ(run(folder.path(), {}).code, 2);
  EXPECT_EQ(run(folder.path(), {"collision-time", "--pairs", "0"}).code, 2);
  folder.write("file", "");
  EXPECT_EQ(run(folder.path(), {"overlap", "--pairs", "10", "-o", "file/out"}).code, 3);
}

TEST(Bench, QuickProgramsPrintWhatTheyMeasure) {
  const Folder folder("bench_quick");
  const auto json = [&](const std::vector<std::string>& words) {
    const Outcome outcome = run(folder.path(), words);
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
    return Json::parse(outcome.output);
  };
  EXPECT_GT(json({"solids", "--quick"})["speed"].size(), 1u);
  const Json engine = json({"engine", "speed", "--quick"});
  EXPECT_TRUE(engine.contains("speed") && engine.contains("flags") && !engine.contains("devices"));
  EXPECT_EQ(run(folder.path(), {"engine", "spede", "--quick"}).code, 2);
  EXPECT_THAT(run(folder.path(), {"calendar", "100", "--repeats", "1"}).output,
              HasSubstr(" near |"));
  EXPECT_THAT(run(folder.path(), {"first-contact", "generic", "6", "--pairs", "50"}).output,
              HasSubstr("ns per prediction"));
  EXPECT_EQ(run(folder.path(), {"first-contact", "easy"}).code, 2);
  const Json growth = json({"analysis-growth", "--quick"});
  for (const char* axis : {"frames", "particles", "lags", "threads"}) {
    EXPECT_GT(growth[axis].back()[axis], growth[axis].front()[axis]);
    for (const Json& row : growth[axis]) EXPECT_LT(row["difference"], 1e-9) << row;
  }
}

TEST(Bench, StopsOnASignalWithTheRowsDone) {
  const Folder folder("bench_stop");
  const Outcome outcome =
      run_and_signal(folder.path(), {"collision-time", "--pairs", "100000000", "-o", "out"},
                     std::chrono::milliseconds(1500), SIGTERM);
  EXPECT_EQ(outcome.code, 5) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("generic"));
  EXPECT_THAT(outcome.errors, HasSubstr("no files were written"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(NumberText, IsShort) {
  EXPECT_EQ(time_text(213.4), "213 ns");
  EXPECT_EQ(time_text(12340), "12.3 µs");
  EXPECT_EQ(time_text(999.7), "1.00 µs");
  EXPECT_EQ(time_text(2.5e9), "2.50 s");
  EXPECT_EQ(count_text(0), "·");
  EXPECT_EQ(ratio_text(41.567), "41.6");
  EXPECT_EQ(ratio_text(1412), "1412");
  EXPECT_EQ(error_text(std::numeric_limits<double>::quiet_NaN()), "–");
}

}  // namespace
}  // namespace vitrel::bench
