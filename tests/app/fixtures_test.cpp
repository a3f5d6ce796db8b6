// Files that earlier versions wrote (tests/fixtures/<version>): this one opens them and continues them.

#include <algorithm>

#include "tests/app/end_to_end.h"

namespace vitrel {
namespace {

using Json = nlohmann::json;

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

  void expect_no_overlap(const std::string& file, std::uint64_t frames) const {
    const Json check = folder_.summary("check " + file);
    EXPECT_EQ(check["frames"], frames);
    EXPECT_EQ(check["overlaps"], 0);
  }
  void expect_exports(const std::string& file, const std::vector<std::string>& formats) const {
    for (const std::string& format : formats) {
      const std::string exported = file + "." + format;
      folder_.succeed("export " + file + " -q --to " + format + " -o " + exported);
      EXPECT_GT(fs::file_size(folder_ / exported), 0u) << exported;
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
  const Json done = folder_.summary("run run.toml -o run.h5");
  EXPECT_EQ(done["complete"], true);
  const Datasets after = all_datasets(folder_ / "run.h5");
  EXPECT_EQ(after.at("/particles/all/position/time").size(), all_frames);
  expect_continued(before, after);
  expect_no_overlap("run.h5", all_frames);
}

TEST_P(Fixtures, ARunIsAnalysedShownAndExported) {
  folder_.succeed("analyze run.h5 -q");
  folder_.succeed("report run.h5 -q");
  expect_exports("run.h5", {"csv", "gsd", "xyz"});
}

TEST_P(Fixtures, StatesAndPackingsAreShownExportedAndStartedFrom) {
  const std::vector<std::string> in_plane = {"csv", "gsd", "xyz"};
  const std::vector<std::string> in_space = {"csv", "geo", "vti", "vtp"};
  for (const auto& [name, formats] :
       {std::pair(std::string("state"), in_plane), {std::string("packing"), in_space}}) {
    expect_no_overlap(name + ".h5", 1);
    folder_.succeed("report " + name + ".h5 -q");
    expect_exports(name + ".h5", formats);
    folder_.succeed("run " + name + ".toml --from " + name + ".h5 -o from_" + name + ".h5 -q");
  }
}

INSTANTIATE_TEST_SUITE_P(Versions, Fixtures, testing::ValuesIn(versions()),
                         [](const auto& version) {
                           std::string name = "v" + version.param;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

}  // namespace
}  // namespace vitrel
