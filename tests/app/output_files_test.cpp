// What is being written lies beside its name, in a file that no one else had: nothing of others is overwritten or deleted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <future>

#include "tests/app/program.h"
#include "tests/support/partial_files.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;
using testing_program::differing_datasets;
using testing_program::expect_refusal;
using testing_program::Folder;
using testing_program::Outcome;
using testing_program::run;

using Words = std::vector<std::string>;

constexpr const char* parameters =
    "[system]\nparticles = 30\npacking_fraction = 0.3\n[dynamics]\nduration = 5\nequilibration = "
    "0\n"
    "[output]\nsamples = { spacing = \"linear\", interval = 0.5 }\n"
    "correlations = { interval = 0.1 }\n";

/// All commands that write, with what they write.
const std::vector<std::pair<Words, Words>> writers = {
    {{"prepare", "p.toml", "-o", "state.h5"}, {"state.h5", "state.quality.json"}},
    {{"run", "p.toml", "-o", "run.h5"}, {"run.h5", "run.h5.checkpoint", "run.h5.correlations.h5"}},
    {{"analyze", "run.h5"}, {"run_results.h5", "run_results/energies.csv"}},
    {{"report", "run.h5", "-o", "run.html"}, {"run.html"}},
    {{"picture", "run.h5"}, {"run.png"}},
    {{"export", "run.h5", "--to", "csv"}, {"run.csv"}},
    {{"export", "run.h5", "--to", "gsd"}, {"run.gsd"}},
    {{"run", "p.toml", "--set", "system.dimension=3", "-o", "space.h5"}, {"space.h5"}},
    {{"export", "space.h5", "--to", "vtp", "-o", "folder"}, {"folder"}},
    {{"sweep", "p.toml", "-o", "sweep"},
     {"sweep/job/run.json", "sweep/job/done.json", "sweep/job/state.h5"}}};

class OutputFiles : public testing::Test {
 protected:
  OutputFiles() : folder_("output_files") { folder_.write("p.toml", parameters); }

  void write_all() const {
    for (const auto& [words, files] : writers) {
      const Outcome outcome = run(folder_.path(), words);
      ASSERT_EQ(outcome.code, 0) << outcome.errors;
      for (const std::string& file : files) EXPECT_TRUE(fs::exists(folder_ / file)) << file;
    }
  }

  const Folder folder_;
};

TEST_F(OutputFiles, LeaveNoPartialOnes) {
  write_all();
  EXPECT_THAT(partial_files(folder_.path()), IsEmpty());
}

TEST_F(OutputFiles, DoNotFollowLinksThatSomeonePutBesideThem) {
  folder_.write("victim", "kept");
  fs::create_directories(folder_ / "sweep/job");
  fs::create_directories(folder_ / "run_results");
  for (const auto& [words, files] : writers)
    for (const std::string& file : files)
      fs::create_symlink(folder_ / "victim", folder_ / (file + ".partial"));
  write_all();
  EXPECT_EQ(folder_.read("victim"), "kept");
}

TEST_F(OutputFiles, LeaveTheUsersOwnFilesAlone) {
  write_all();
  folder_.write("own.html.partial", "kept");
  fs::create_directory(folder_ / "own.partial");
  folder_.write("own.partial/notes.txt", "kept");
  for (const Words& words : {Words{"report", "run.h5", "-o", "own.html"},
                             Words{"export", "space.h5", "--to", "vtp", "-o", "own"}})
    EXPECT_EQ(run(folder_.path(), words).code, 0);
  EXPECT_EQ(folder_.read("own.html.partial"), "kept");
  EXPECT_EQ(folder_.read("own.partial/notes.txt"), "kept");
}

TEST_F(OutputFiles, OfTwoProcessesWithOneNameAreWholeOnes) {
  write_all();
  for (const Words& words : {Words{"export", "run.h5", "--to", "csv", "-o", "both.csv"},
                             Words{"analyze", "run.h5", "-o", "both.h5"},
                             Words{"report", "run.h5", "-o", "both.html"}}) {
    const std::string output = words.back();
    Words alone = words;
    alone.back() = "alone" + fs::path(output).extension().string();
    ASSERT_EQ(run(folder_.path(), alone).code, 0);
    for (int time = 0; time < 5; ++time) {
      fs::remove(folder_ / output);
      const Folder other("output_files_other");  // the outcomes' own files
      const auto in_other = [&] {
        Words absolute = words;
        absolute[1] = (folder_ / absolute[1]).string();
        absolute.back() = (folder_ / output).string();
        return run(other.path(), absolute).code;
      };
      auto second = std::async(std::launch::async, in_other);
      const int first = run(folder_.path(), words).code, code = second.get();
      // An export refuses a file that is there already, unless both have begun before it was.
      EXPECT_EQ(std::min(first, code), 0);
      EXPECT_TRUE(std::max(first, code) == 0 ||
                  (words[0] == "export" && std::max(first, code) == 2));
      if (words[0] == "analyze")
        EXPECT_THAT(differing_datasets(folder_ / output, folder_ / alone.back()), IsEmpty());
      else if (words[0] == "export")
        EXPECT_EQ(folder_.read(output), folder_.read(alone.back()));
      else
        EXPECT_THAT(folder_.read(output), testing::EndsWith("</html>\n"));
    }
  }
  EXPECT_THAT(partial_files(folder_.path()), IsEmpty());
}

// The disk of the results is often another one than that of the work.
TEST_F(OutputFiles, GoWhereTheUsersOwnLinkLeads) {
  fs::create_directory(folder_ / "disk");
  for (const auto& [words, files] : writers) {
    const std::string& file = files.front();
    if (file.find('/') == std::string::npos && file != "plots")
      fs::create_symlink("disk/" + file, folder_ / file);
  }
  for (const auto& [words, files] : writers) {
    if (words[0] == "export" || words[0] == "sweep") continue;  // they write new files and folders
    const Outcome outcome = run(folder_.path(), words);
    ASSERT_EQ(outcome.code, 0) << outcome.errors;
    EXPECT_TRUE(fs::is_symlink(folder_ / files.front())) << files.front();
    EXPECT_TRUE(fs::is_regular_file(folder_ / "disk" / files.front())) << files.front();
  }
  EXPECT_THAT(partial_files(folder_.path()), IsEmpty());
}

TEST_F(OutputFiles, HaveTheRightsThatTheUserGivesNewFiles) {
  const mode_t before = umask(027);
  write_all();
  umask(before);
  for (const char* file : {"state.h5", "run.h5", "run.csv", "run.html", "run_results.h5"}) {
    struct stat status;
    ASSERT_EQ(stat((folder_ / file).c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0640u) << file;
  }
}

TEST_F(OutputFiles, HaveANameInAllCommands) {
  for (auto [words, files] : writers) {
    if (std::ranges::find(words, "-o") == words.end()) words.insert(words.end(), {"-o", ""});
    words.back() = "";
    expect_refusal(run(folder_.path(), words), 2, "--output: the name is empty");
  }
}

}  // namespace
}  // namespace vitrel
