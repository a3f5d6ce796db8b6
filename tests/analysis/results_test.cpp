#include "analysis/results.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "core/error.h"
#include "core/special_values.h"
#include "tests/support/files.h"

namespace vitrel {
namespace {

using ResultsTest = Files;

Table displacement_table() {
  return {"msd",
          "Mean squared displacement; rows are time differences.",
          {{"time", "sqrt(m ab/kT)", {0.1, 1.0 / 3}, {}},
           {"all", "ab", {2, 1e-300}, {0.25, -unknown}},
           {"A", "ab", {4, 8}, {}}}};
}

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST_F(ResultsTest, CsvHasPlainNamesAndAllDigits) {
  write_csv(file("msd.csv"), displacement_table());
  EXPECT_EQ(text_of(file("msd.csv")),
            "time,all,all_error,A\n"
            "0.10000000000000001,2,0.25,4\n"
            "0.33333333333333331,1e-300,nan,8\n");
}

Table coded_table() {
  return {"verdicts",
          "Of runs.",
          {{"verdict", "1", {1, 0, unknown}, {}, {"found", "refused, \"why\""}}}};
}

TEST_F(ResultsTest, CodesAreWordsInCsv) {
  write_csv(file("verdicts.csv"), coded_table());
  EXPECT_EQ(text_of(file("verdicts.csv")), "verdict\n\"refused, \"\"why\"\"\"\nfound\nnan\n");
}

TEST_F(ResultsTest, LabelsComeBackFromHdf5) {
  write_results(file("results.h5"), {{coded_table()}, {}});
  const Column column = read_results(file("results.h5")).tables.front().columns.front();
  EXPECT_EQ(column.labels, coded_table().columns.front().labels);
}

TEST_F(ResultsTest, AFolderHasTheTablesAndTheirUnits) {
  write_csv_folder(file("results"), {{displacement_table(), coded_table()}, {}});
  EXPECT_TRUE(std::filesystem::exists(folder_ / "results" / "verdicts.csv"));
  EXPECT_EQ(text_of(folder_ / "results" / csv_columns),
            "table,column,unit,description\n"
            "msd,time,sqrt(m ab/kT),Mean squared displacement; rows are time differences.\n"
            "msd,all,ab,Mean squared displacement; rows are time differences.\n"
            "msd,A,ab,Mean squared displacement; rows are time differences.\n"
            "verdicts,verdict,1,Of runs.\n");
}

TEST_F(ResultsTest, Hdf5RoundTripKeepsEverythingBitByBit) {
  Results written;
  written.tables = {displacement_table(), {"energy", "Per particle.", {{"time", "1", {}, {}}}}};
  written.provenance = {{"version", "0.1.0"}, {"parameters", "[system]\nseed = 7\n"}, {"a", ""}};
  write_results(file("results.h5"), written);
  const Results read = read_results(file("results.h5"));

  EXPECT_EQ(read.provenance, written.provenance);
  EXPECT_EQ(read.text("version"), "0.1.0");
  EXPECT_EQ(read.text("commit"), "");
  ASSERT_EQ(read.tables.size(), 2u);
  ASSERT_NE(read.find("energy"), nullptr);
  EXPECT_EQ(read.find("energy")->rows(), 0u);
  const Table& table = read.tables[0];
  EXPECT_EQ(table.name, "msd");
  EXPECT_EQ(table.description, written.tables[0].description);
  ASSERT_EQ(table.columns.size(), 3u);
  EXPECT_EQ(table.columns[0].name, "time");
  EXPECT_EQ(table.columns[0].unit, "sqrt(m ab/kT)");
  EXPECT_EQ(table.columns[0].value, written.tables[0].columns[0].value);
  ASSERT_NE(table.find("all"), nullptr);
  EXPECT_EQ(table.find("all")->error[0], 0.25);
  EXPECT_TRUE(std::isnan(table.find("all")->error[1]));
  EXPECT_TRUE(table.find("A")->error.empty());
  EXPECT_EQ(table.find("B"), nullptr);
}

TEST_F(ResultsTest, WritingReplacesTheOldFileAndLeavesNoOther) {
  for (int time = 0; time < 2; ++time) {
    write_csv(file("table.csv"), displacement_table());
    write_results(file("results.h5"), {{displacement_table()}, {}});
  }
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) files += entry.exists();
  EXPECT_EQ(files, 2u);
}

TEST_F(ResultsTest, FailuresNameTheFile) {
  const std::filesystem::path nowhere = folder_ / "missing" / "table";
  const auto names_the_file =
      testing::ThrowsMessage<FileError>(testing::HasSubstr(nowhere.string()));
  EXPECT_THAT([&] { write_csv(nowhere, displacement_table()); }, names_the_file);
  EXPECT_THAT([&] { write_results(nowhere, {{displacement_table()}, {}}); }, names_the_file);
  std::ofstream(file("text.h5")) << "not an HDF5 file";
  EXPECT_THROW(read_results(file("text.h5")), FileError);
}

TEST_F(ResultsTest, FormerNamesAreReadAsTodays) {
  Results results;
  results.tables = {{"summary", "", {{"compressibility", "1", {4.5}, {0.1}}}},
                    {"compressibility", "", {{"z", "1", {4.5}, {}}}}};
  write_results(file("results.h5"), results);
  const Results read = read_results(file("results.h5"));
  EXPECT_FALSE(read.find("compressibility"));
  ASSERT_TRUE(read.find("compressibility_factor"));
  EXPECT_EQ(read.find("summary")->find("compressibility_factor")->error[0], 0.1);
}

}  // namespace
}  // namespace vitrel
