// What is being written lies beside its name, in a file that no one else had: nothing of others is overwritten or deleted.
#include <sys/stat.h>

#include <future>

#include "tests/app/end_to_end.h"
#include "tests/support/partial_files.h"

namespace vitrel {
namespace {

constexpr const char* parameters =
    "[system]\nparticles = 30\npacking_fraction = 0.3\n[dynamics]\nduration = 5\nequilibration = "
    "0\n"
    "[output]\nsamples = { spacing = \"linear\", interval = 0.5 }\n"
    "correlations = { interval = 0.1 }\n";

/// All commands that write, with what they write.
const std::vector<std::pair<std::string, std::vector<std::string>>> writers = {
    {"prepare p.toml -o state.h5", {"state.h5", "state.quality.json"}},
    {"run p.toml -o run.h5", {"run.h5", "run.h5.checkpoint", "run.h5.correlations.h5"}},
    {"analyze run.h5", {"run_results.h5", "run_results/energies.csv"}},
    {"report run.h5 -o run.html", {"run.html"}},
    {"picture run.h5", {"run.png"}},
    {"export run.h5 --to csv", {"run.csv"}},
    {"export run.h5 --to gsd", {"run.gsd"}},
    {"run p.toml --set system.dimension=3 -o space.h5", {"space.h5"}},
    {"export space.h5 --to vtp -o folder", {"folder"}},
    {"sweep p.toml -o sweep", {"sweep/job/run.json", "sweep/job/done.json", "sweep/job/state.h5"}}};

class OutputFiles : public testing::Test {
 protected:
  void write_all() const {
    for (const auto& [command, files] : writers) {
      folder_.succeed(command);
      for (const std::string& file : files) EXPECT_TRUE(fs::exists(folder_ / file)) << file;
    }
  }

  const Folder folder_{"output_files", parameters};
};

TEST_F(OutputFiles, LeaveNoPartialOnes) {
  write_all();
  EXPECT_THAT(partial_files(folder_.path()), IsEmpty());
}

TEST_F(OutputFiles, DoNotFollowLinksThatSomeonePutBesideThem) {
  folder_.write("victim", "kept");
  fs::create_directories(folder_ / "sweep/job");
  fs::create_directories(folder_ / "run_results");
  for (const auto& [command, files] : writers)
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
  folder_.succeed("report run.h5 -o own.html");
  folder_.succeed("export space.h5 --to vtp -o own");
  EXPECT_EQ(folder_.read("own.html.partial"), "kept");
  EXPECT_EQ(folder_.read("own.partial/notes.txt"), "kept");
}

TEST_F(OutputFiles, OfTwoProcessesWithOneNameAreWholeOnes) {
  write_all();
  for (const auto& [command, input, ending] : {std::tuple("export", "run.h5 --to csv", ".csv"),
                                               {"analyze", "run.h5", ".h5"},
                                               {"report", "run.h5", ".html"}}) {
    const std::string output = std::string("both") + ending, alone = std::string("alone") + ending;
    folder_.succeed(fmt::format("{} {} -o {}", command, input, alone));
    for (int time = 0; time < 5; ++time) {
      fs::remove(folder_ / output);
      const Folder other("output_files_other");  // the outcomes' own files
      const std::string in_other =
          fmt::format("{} {}/{} -o {}/{}", command, folder_.path().string(), input,
                      folder_.path().string(), output);
      auto second = std::async(std::launch::async, [&] { return other.run(in_other).code; });
      const int first = folder_.run(fmt::format("{} {} -o {}", command, input, output)).code;
      const int code = second.get();
      // An export refuses a file that is there already, unless both have begun before it was.
      EXPECT_EQ(std::min(first, code), 0);
      EXPECT_TRUE(std::max(first, code) == 0 ||
                  (output == "both.csv" && std::max(first, code) == 2));
      if (output == "both.h5")
        folder_.expect_same_datasets(output, alone);
      else if (output == "both.csv")
        EXPECT_EQ(folder_.read(output), folder_.read(alone));
      else
        EXPECT_THAT(folder_.read(output), testing::EndsWith("</html>\n"));
    }
  }
  EXPECT_THAT(partial_files(folder_.path()), IsEmpty());
}

// The disk of the results is often another one than that of the work.
TEST_F(OutputFiles, GoWhereTheUsersOwnLinkLeads) {
  fs::create_directory(folder_ / "disk");
  for (const auto& [command, files] : writers) {
    const std::string& file = files.front();
    if (file.find('/') == std::string::npos && file != "plots")
      fs::create_symlink("disk/" + file, folder_ / file);
  }
  for (const auto& [command, files] : writers) {
    // They write new files and folders.
    if (command.starts_with("export") || command.starts_with("sweep")) continue;
    folder_.succeed(command);
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
  for (const auto& [command, files] : writers)
    folder_.expect_refusal(command.substr(0, command.find(" -o ")) + " -o ''", 2,
                           "--output: the name is empty");
}

}  // namespace
}  // namespace vitrel
