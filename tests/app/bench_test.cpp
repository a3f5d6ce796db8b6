// vitrel bench from outside, and the charts it draws.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "app/workflow/bench/chart.h"
#include "app/workflow/bench/figures.h"
#include "tests/app/program.h"

namespace vitrel {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
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

/// Well-formed enough: every element is closed in order, and no attribute comes twice.
void expect_well_formed(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t at = 0; (at = xml.find('<', at)) != std::string::npos;) {
    const std::size_t end = xml.find('>', at);
    ASSERT_NE(end, std::string::npos);
    const std::string tag = xml.substr(at + 1, end - at - 1);
    at = end;
    if (tag.front() == '/') {
      ASSERT_FALSE(open.empty());
      EXPECT_EQ(tag.substr(1), open.back());
      open.pop_back();
      continue;
    }
    if (tag.back() != '/') open.push_back(tag.substr(0, tag.find(' ')));
    std::set<std::string> names;
    for (std::size_t quote = 0; (quote = tag.find("=\"", quote)) != std::string::npos;) {
      const std::size_t begin = tag.rfind(' ', quote) + 1;
      EXPECT_TRUE(names.insert(tag.substr(begin, quote - begin)).second) << tag;
      quote = tag.find('"', quote + 2);
      ASSERT_NE(quote, std::string::npos) << tag;
    }
  }
  EXPECT_TRUE(open.empty());
}

TEST(BenchCollisionTime, PrintsRowsWithTheKeysOfTheManual) {
  const Folder folder("bench_rows");
  const Outcome outcome =
      run(folder.path(), {"bench", "collision-time", "--pairs", "30", "--class", "generic",
                          "--method", "separating_axis", "slsqp", "--json", "-q"});
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

TEST(BenchCollisionTime, JudgesTimesAndGapsByTheirTolerances) {
  const Folder folder("bench_tolerance");
  const auto row = [&](const std::vector<std::string>& tolerances) {
    std::vector<std::string> words = {
        "bench", "collision-time", "--pairs",         "60",     "--class",
        "slow",  "--method",       "separating_axis", "--json", "-q"};
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
      run(folder.path(), {"bench", "collision-time", "--pairs", "40", "--seconds", "0.2",
                          "--duration", "0.1", "--class", "generic", "recorded", "-o", "out"});
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
  EXPECT_THAT(data["provenance"]["command"], HasSubstr("bench collision-time --pairs 40"));
  ASSERT_FALSE(data["failures"].empty());
  for (const Json& failure : data["failures"]) {
    EXPECT_NE(failure["method"], "separating_axis");
    EXPECT_THAT(failure["caption"], testing::Not(testing::IsEmpty()));
    EXPECT_TRUE(std::filesystem::exists(out / failure["picture"].get<std::string>()));
  }
  for (const char* const name : {"collision-time.svg", "collision-time-largest.svg",
                                 "scene_gap.svg", "scene_psi.svg", "overlap.svg", "whole-run.svg"})
    expect_well_formed(content(out / name));
  for (const auto& entry : std::filesystem::directory_iterator(out))
    if (entry.path().extension() == ".svg") expect_well_formed(content(entry.path()));
  const std::string page = content(out / "collision-time.html");
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_EQ(count(page, " src="), 0u);
  EXPECT_EQ(count(page, "<script"), 0u);
  EXPECT_EQ(count(page, "http"), count(page, "http://www.w3.org/2000/svg") + 1);  // http-equiv
  EXPECT_GE(count(page, "<svg "), 5u);
  EXPECT_THAT(page, AllOf(Not(HasSubstr(">nan")), Not(HasSubstr("\"nan")), Not(HasSubstr(" nan"))));
}

TEST(BenchOverlap, PrintsAndWrites) {
  const Folder folder("bench_overlap");
  const Outcome outcome = run(folder.path(), {"bench", "overlap", "--pairs", "200", "--seconds",
                                              "0.1", "--json", "-q", "-o", "out"});
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
  expect_well_formed(content(folder / "out/overlap.svg"));
  EXPECT_THAT(content(folder / "out/overlap.html"), HasSubstr("polygon_"));
}

TEST(BenchWholeRun, PrintsAndWrites) {
  const Folder folder("bench_whole_run");
  const Outcome outcome =
      run(folder.path(), {"bench", "whole-run", "--duration", "1", "--method", "separating_axis",
                          "psi_root", "--json", "-q", "-o", "out"});
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
  const std::string chart = content(folder / "out/whole-run.svg");
  expect_well_formed(chart);
  EXPECT_THAT(chart, HasSubstr(">none<"));  // no correction move
  const std::string page = content(folder / "out/whole-run.html");
  EXPECT_THAT(page, AllOf(HasSubstr("default-src 'none'"), HasSubstr("psi_root")));
  EXPECT_EQ(count(page, "<script"), 0u);
}

TEST(BenchWholeRun, PrintsATableOfWholeLinesInAHundredColumns) {
  const Folder folder("bench_whole_run_text");
  const Outcome outcome = run(folder.path(), {"bench", "whole-run", "--duration", "0.5", "--method",
                                              "perram_wertheim_root"});
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("perram_wertheim_root\n"), HasSubstr("corrections")));
  std::istringstream lines(outcome.output);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 104u) << line;
}

TEST(Bench, RefusesUnknownNamesAndSaysWhichThereAre) {
  const Folder folder("bench_names");
  const Outcome method = run(folder.path(), {"bench", "collision-time", "--method", "magic"});
  EXPECT_EQ(method.code, 2);
  EXPECT_THAT(method.errors, AllOf(HasSubstr("magic"), HasSubstr("separating_axis")));
  const Outcome of = run(folder.path(), {"bench", "collision-time", "--class", "easy"});
  EXPECT_EQ(of.code, 2);
  EXPECT_THAT(of.errors, AllOf(HasSubstr("easy"), HasSubstr("generic,")));
  const Outcome criterion = run(folder.path(), {"bench", "overlap", "--method", "magic"});
  EXPECT_EQ(criterion.code, 2);
  EXPECT_THAT(criterion.errors, HasSubstr("vieillard_baron"));
  const Outcome runs = run(folder.path(), {"bench", "whole-run", "--method", "nelder_mead"});
  EXPECT_EQ(runs.code, 2);
  EXPECT_THAT(runs.errors, HasSubstr("psi_root"));
  EXPECT_EQ(run(folder.path(), {"bench", "whole-run", "--duration", "0"}).code, 2);
  EXPECT_EQ(run(folder.path(), {"bench"}).code, 2);
  EXPECT_EQ(run(folder.path(), {"bench", "collision-time", "--pairs", "0"}).code, 2);
  folder.write("file", "");
  EXPECT_EQ(run(folder.path(), {"bench", "overlap", "--pairs", "10", "-o", "file/out"}).code, 3);
}

TEST(Bench, StopsOnASignalWithTheRowsDone) {
  const Folder folder("bench_stop");
  const Outcome outcome = run_and_signal(
      folder.path(), {"bench", "collision-time", "--pairs", "100000000", "-o", "out"},
      std::chrono::milliseconds(1500), SIGTERM);
  EXPECT_EQ(outcome.code, 5) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("generic"));
  EXPECT_THAT(outcome.errors, HasSubstr("no files were written"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

Chart chart_of(const std::vector<ChartPoint>& points) {
  Chart chart;
  chart.title = "a < b & \"c\"";
  chart.x = {"time per call", true, ChartAxis::Quantity::nanoseconds};
  chart.y = {"error", true, {}};
  chart.floor = 1e-17;
  chart.series = {{"one", points, true}, {"two", {{3e6, 1e-3, true, "note"}}, true}};
  return chart;
}

TEST(Chart, LogarithmicAxesCoverWholeDecadesAndZeroSitsOnTheFloor) {
  const std::string svg = chart_svg(chart_of({{150, 1e-12, false, ""}, {900, 0, false, ""}}));
  expect_well_formed(svg);
  EXPECT_THAT(svg, AllOf(HasSubstr(">100 ns<"), HasSubstr(">10 ms<"), HasSubstr(">≤ 10⁻¹⁷<"),
                         HasSubstr("a &lt; b &amp; &quot;c&quot;")));
  // The point with error 0 lies on the horizontal axis.
  EXPECT_THAT(svg, HasSubstr(",444.00 \" fill=\"none\""));
}

TEST(Chart, TheFloorMayHaveANameOfItsOwn) {
  Chart chart = chart_of({{150, 1e-12, false, ""}, {900, 0, false, ""}});
  chart.floor_label = "none";
  EXPECT_THAT(chart_svg(chart), AllOf(HasSubstr(">none<"), Not(HasSubstr("≤"))));
}

TEST(Chart, WithoutZerosTheFloorIsNotDrawn) {
  EXPECT_THAT(chart_svg(chart_of({{150, 1e-9, false, ""}})), Not(HasSubstr("≤")));
}

TEST(Chart, LeavesOutWhatIsNotANumberAndCopesWithNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string svg = chart_svg(chart_of({{150, nan, false, ""}, {nan, 1, false, ""}}));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_EQ(count(svg, "<title>"), 1u);
  Chart empty;
  expect_well_formed(chart_svg(empty));
  empty.x.logarithmic = empty.y.logarithmic = true;
  expect_well_formed(chart_svg(empty));
}

TEST(Chart, LinearAxesHaveRoundNumbers) {
  Chart chart;
  chart.series = {{"curve", {{0, -27.3, false, ""}, {2, 124.6, false, ""}}, false}};
  const std::string svg = chart_svg(chart);
  for (const char* const label : {">−50<", ">0<", ">150<", ">0.5<", ">2<"})
    EXPECT_THAT(svg, HasSubstr(label));
}

TEST(Figures, AreShortAndNeverHideAFailure) {
  EXPECT_EQ(power_of_ten(-12), "10⁻¹²");
  EXPECT_EQ(power_of_ten(0), "1");
  EXPECT_EQ(time_text(213.4), "213 ns");
  EXPECT_EQ(time_text(12340), "12.3 µs");
  EXPECT_EQ(time_text(999.7), "1.00 µs");
  EXPECT_EQ(time_text(2.5e9), "2.50 s");
  EXPECT_EQ(count_text(0), "·");
  EXPECT_EQ(ratio_text(41.567), "41.6");
  EXPECT_EQ(ratio_text(1412), "1412");
  EXPECT_EQ(share_text(0, 100), "·");
  EXPECT_EQ(share_text(1, 800000), "0.0001 %");
  EXPECT_EQ(share_text(2, 100), "2 %");
  EXPECT_EQ(share_text(799999, 800000), "100 %");
  EXPECT_EQ(error_text(std::numeric_limits<double>::quiet_NaN()), "–");
}

}  // namespace
}  // namespace vitrel
