// Files that earlier versions wrote (tests/fixtures/<version>): this one opens them and continues them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/app/program.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing_program::all_datasets;
using testing_program::Datasets;
using testing_program::Folder;
using testing_program::Outcome;
using testing_program::run;
using testing_program::succeed;

std::vector<std::string> versions() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(VITREL_FIXTURES))
    if (entry.is_directory()) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// The files of one version, in a folder where commands may write.
class Fixtures : public testing::TestWithParam<std::string> {
 protected:
  Fixtures() : folder_("fixtures_" + GetParam()) {
    fs::copy(fs::path(VITREL_FIXTURES) / GetParam(), folder_.path());
  }

  void expect_success(const std::vector<std::string>& arguments) const {
    succeed(folder_, arguments);
  }
  /// The summary of a command that must succeed.
  Json summary(std::vector<std::string> arguments) const {
    arguments.push_back("--json");
    const std::string output = succeed(folder_, arguments);
    return output.empty() ? Json::object() : Json::parse(output);
  }
  void expect_no_overlap(const std::string& file, std::uint64_t frames) const {
    const Json check = summary({"check", file});
    EXPECT_EQ(check["frames"], frames);
    EXPECT_EQ(check["overlaps"], 0);
  }
  void expect_exports(const std::string& file, const std::vector<std::string>& formats) const {
    for (const std::string& format : formats) {
      expect_success({"export", file, "--to", format, "-o", "exported." + format, "-q"});
      EXPECT_GT(fs::file_size(folder_ / ("exported." + format)), 0u) << format;
    }
  }

  const Folder folder_;
};

/// In every series that both files have, the frames before are the first ones after.
void expect_continued(const Datasets& before, const Datasets& after) {
  for (const auto& [name, values] : before) {
    const auto found = after.find(name);
    ASSERT_NE(found, after.end()) << name;
    ASSERT_GE(found->second.size(), values.size()) << name;
    EXPECT_TRUE(std::equal(values.begin(), values.end(), found->second.begin())) << name;
  }
}

// run.toml asks for frames at the times 0, 100 … 2000.
constexpr std::uint64_t all_frames = 21;

TEST_P(Fixtures, ARunInProgressContinuesToItsEnd) {
  const Datasets before = all_datasets(folder_ / "run.h5");
  const std::uint64_t frames = before.at("/particles/all/position/time").size();
  ASSERT_GT(frames, 1u);
  ASSERT_LT(frames, all_frames);
  expect_no_overlap("run.h5", frames);
  const Json done = summary({"run", "run.toml", "-o", "run.h5"});
  EXPECT_EQ(done["complete"], true);
  const Datasets after = all_datasets(folder_ / "run.h5");
  EXPECT_EQ(after.at("/particles/all/position/time").size(), all_frames);
  expect_continued(before, after);
  expect_no_overlap("run.h5", all_frames);
}

TEST_P(Fixtures, ARunIsAnalysedShownAndExported) {
  expect_success({"analyze", "run.h5", "-q"});
  expect_success({"report", "run.h5", "-q"});
  expect_exports("run.h5", {"csv", "gsd", "xyz"});
}

TEST_P(Fixtures, AStateIsShownExportedAndStartedFrom) {
  expect_no_overlap("state.h5", 1);
  expect_success({"report", "state.h5", "-q"});
  expect_exports("state.h5", {"csv", "gsd", "xyz"});
  expect_success({"run", "state.toml", "--from", "state.h5", "-o", "started.h5", "-q"});
}

TEST_P(Fixtures, APackingIsShownExportedAndStartedFrom) {
  expect_no_overlap("packing.h5", 1);
  expect_success({"report", "packing.h5", "-q"});
  expect_exports("packing.h5", {"csv", "geo", "vti", "vtp"});
  expect_success({"run", "packing.toml", "--from", "packing.h5", "-o", "started.h5", "-q"});
}

INSTANTIATE_TEST_SUITE_P(Versions, Fixtures, testing::ValuesIn(versions()),
                         [](const auto& version) {
                           std::string name = "v" + version.param;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

}  // namespace
}  // namespace vitrel
