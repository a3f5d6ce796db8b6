#include "bench/studies/tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "bench/studies/runner.h"

namespace vitrel::bench {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Two methods on two classes, of which the second is half as dear and sometimes wrong.
const Json rows = Json::parse(R"([
  {"method": "a", "class": "x", "κ": 2, "pairs": 100, "late": 0, "not_converged": 0, "ns": 200, "off": 1e-9},
  {"method": "b", "class": "x", "κ": 2, "pairs": 100, "late": 7, "not_converged": 0, "ns": 100, "off": 1e-3},
  {"method": "a", "class": "y", "κ": 6, "pairs": 100, "late": 0, "not_converged": 0, "ns": 2000, "off": 0},
  {"method": "b", "class": "y", "κ": 6, "pairs": 50, "late": 0, "not_converged": 50, "ns": 1, "off": null}])");

Part part() {
  return {.name = "part",
          .about = "",
          .measure = {},
          .cases = {{"class"}, {"κ"}},
          .cost = {"ns", "time", Shown::time},
          .error = {"off", "error", Shown::error},
          .verdicts = {{"late"}, {"not_converged", "no answer"}},
          .smallest_error = 1e-17};
}

std::vector<std::string> texts(const std::vector<Cell>& cells) {
  std::vector<std::string> all;
  for (const Cell& cell : cells) all.push_back(cell.text);
  return all;
}

TEST(StudyTables, ShowWhereWhichMethodFailsAndWhatItCosts) {
  const std::vector<StudyTable> tables = tables_of(part(), rows);
  ASSERT_EQ(tables.size(), 3u);
  EXPECT_EQ(tables[0].head, (std::vector<std::string>{"", "a", "b"}));
  EXPECT_EQ(texts(tables[0].rows[0]), (std::vector<std::string>{"x, κ = 2", "·", "7 %"}));
  EXPECT_EQ(texts(tables[0].rows[1]), (std::vector<std::string>{"y, κ = 6", "·", "–"}));
  EXPECT_THAT(tables[0].rows[0][2].note, HasSubstr("7 late, 0 no answer"));
  EXPECT_EQ(texts(tables[1].rows[0]), (std::vector<std::string>{"x, κ = 2", "200 ns", "0.5"}));
  EXPECT_EQ(tables[1].rows[0][2].note, "100 ns");
  EXPECT_EQ(tables[2].rows.size(), 4u);
  for (const auto& row : tables[2].rows) EXPECT_EQ(row.size(), tables[2].head.size());
  EXPECT_THAT(markdown(tables[0]), HasSubstr("| x, κ = 2 | · | 7 % |\n"));
}

TEST(StudyTables, AnswerInASentence) {
  EXPECT_EQ(answer_of(part(), rows),
            "Never wrong: a (error up to 1.0e-09). Wrong, at most in: b 7 % (x, κ = 2: 7 %).");
}

TEST(StudyTables, ChartsHaveAPanelForEachClassAndHollowPointsWhereAnswersAreWrong) {
  const Json charts = charts_of(part(), rows);
  ASSERT_EQ(charts.size(), 2u);
  EXPECT_EQ(charts[0]["heading"], "x, κ = 2");
  ASSERT_EQ(charts[0]["curves"].size(), 4u);  // a line and its points for each method
  EXPECT_EQ(charts[0]["curves"][1]["look"], "full");
  EXPECT_EQ(charts[0]["curves"][3]["look"], "hollow");
  EXPECT_EQ(charts[1]["curves"][0]["value"][0], 1e-17);
}

TEST(StudyTables, CompareAtEqualValuesOfWhatIsVariedWithoutAnError) {
  Part grows = part();
  grows.cases = {}, grows.error = {}, grows.verdicts = {}, grows.varied = "particles";
  const Json sizes = Json::parse(
      R"([{"method": "a", "particles": 10, "ns": 1}, {"method": "b", "particles": 10, "ns": 3},
                                     {"method": "a", "particles": 20, "ns": 2}, {"method": "b", "particles": 20, "ns": 12}])");
  EXPECT_EQ(answer_of(grows, sizes), "b (3 to 6 times the cost).");
  EXPECT_EQ(texts(tables_of(grows, sizes)[0].rows[1]).back(), "6");
  EXPECT_EQ(charts_of(grows, sizes)[0]["curves"][0]["x"], Json::array({10, 20}));
}

/// A page of one part with so many classes of two rows.
std::string page_with(const Part& of, int classes) {
  Json all = Json::array();
  for (int k = 0; k < classes; ++k)
    for (const char* const method : {"a", "b"})
      all.push_back(
          {{"class", std::to_string(k)}, {"method", method}, {"ns", 1 + k}, {"off", 1e-9}});
  const Json from = {{"date", "2026-01-01T00:00"}, {"commit", "c"},
                     {"processor", "p"},           {"compiler", "g"},
                     {"wall time", "1 s"},         {"command", "c"}};
  return study_markdown(
      {.name = "s", .aliases = {}, .question = "q", .parts = {of}},
      {{"parts", {{{"name", "part"}, {"about", ""}, {"answer", ""}, {"rows", all}}}},
       {"provenance", from}});
}

TEST(StudyPage, HasAllNumbersIfTheyAreFewElseChartsOrHowCostsCompare) {
  Part of = part();
  of.verdicts = {};
  EXPECT_THAT(page_with(of, 12), HasSubstr("All numbers:"));
  EXPECT_THAT(page_with(of, 13), AllOf(HasSubstr("part-13.svg"), Not(HasSubstr("| ---"))));
  of.error = {};  // no charts
  EXPECT_THAT(page_with(of, 12), Not(HasSubstr("of the first method")));
  EXPECT_THAT(page_with(of, 13),
              AllOf(HasSubstr("of the first method"), Not(HasSubstr("All numbers:"))));
}

TEST(NumberText, IsShort) {
  EXPECT_EQ(time_text(213.4), "213 ns");
  EXPECT_EQ(time_text(12340), "12.3 µs");
  EXPECT_EQ(time_text(999.7), "1.00 µs");
  EXPECT_EQ(time_text(2.5e9), "2.50 s");
  EXPECT_EQ(ratio_text(41.567), "41.6");
  EXPECT_EQ(ratio_text(1412), "1412");
  EXPECT_EQ(error_text(std::numeric_limits<double>::quiet_NaN()), "–");
  EXPECT_EQ(share_text(0.00004), "0.004 %");
}

}  // namespace
}  // namespace vitrel::bench
