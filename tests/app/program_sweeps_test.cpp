// Sweeps from outside: jobs, their order, and what becomes of those that fail.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <future>
#include <nlohmann/json.hpp>
#include <thread>

#include "analysis/results.h"
#include "core/io/checked.h"
#include "tests/app/program.h"
#include "tests/app/systems.h"

namespace vitrel {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing_program::differing_datasets;
using testing_program::expect_keys;
using testing_program::expect_refusal;
using testing_program::Folder;
using testing_program::Outcome;
using testing_program::run;
using testing_program::small_packing;
using testing_program::small_system;
using testing_program::soft_system;
using Json = nlohmann::json;

TEST(Program, ASweepOfThreeDimensions) {
  const Folder folder("sweep_of_packings");
  folder.write("p.toml", small_packing + "[sweep.grid]\n\"system.seed\" = [1, 2]\n");
  const auto summary_of = [&folder](const std::string& sweep, std::vector<std::string> more) {
    more.insert(more.begin(), {"sweep", "p.toml", "-o", sweep, "--json", "-q"});
    const Outcome outcome = run(folder.path(), more);
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
    return Json::parse(outcome.output);
  };
  const Json packings = summary_of("packings", {});
  for (const Json& job : packings["jobs"]) {
    expect_keys(job["prepare"], {"packing_fraction", "orientation_ratio", "reduced_pressure",
                                 "collisions", "wall_seconds"});
    EXPECT_EQ(job["analyze"]["orientation_ratio"], job["prepare"]["orientation_ratio"]);
    EXPECT_FALSE(job.contains("run"));
  }
  EXPECT_EQ(packings["seeds"][0]["seeds"], 2);
  ASSERT_EQ(run(folder.path(), {"analyze", "packings", "-q"}).code, 0);
  const Results results = read_results(folder / "packings/results.h5");
  EXPECT_EQ(results.find("runs")->find("reduced_pressure")->value[1],
            packings["jobs"][1]["prepare"]["reduced_pressure"]);
  EXPECT_EQ(results.find("seeds")->rows(), 1u);
  EXPECT_EQ(run(folder.path(), {"analyze", "packings/seed-1", "-o", "a.h5", "-q"}).code, 0);

  const Json runs = summary_of("runs", {"--set", "dynamics.duration=1"});
  for (const Json& job : runs["jobs"]) {
    EXPECT_EQ(job["run"]["overlaps"], 0);
    EXPECT_NEAR(job["run"]["packing_fraction"], 0.2, 1e-12);
    EXPECT_TRUE(job["analyze"].contains("packing_fraction"));
  }
}

// What only the runs know stands beside the averages of the analysis.
TEST(Program, ASweepAveragesTheExceptionsOfSoftParticles) {
  const Folder folder("soft_sweep");
  checked(setenv("XDG_CACHE_HOME", folder.path().c_str(), 1), "setenv");
  folder.write("p.toml", soft_system + std::string("[sweep.grid]\n\"system.seed\" = [1, 2]\n"));
  const Outcome sweep = run(folder.path(), {"sweep", "p.toml", "-o", "sweep", "--json", "-q"});
  ASSERT_EQ(sweep.code, 0) << sweep.errors;
  const Json jobs = Json::parse(sweep.output)["jobs"];
  ASSERT_EQ(run(folder.path(), {"analyze", "sweep", "-q"}).code, 0);
  const Results results = read_results(folder / "sweep/results.h5");
  for (const char* name : {"early_releases_per_collision", "blocked_rotations_per_collision"}) {
    const double first = jobs[0]["run"][name], second = jobs[1]["run"][name];
    EXPECT_THAT(results.find("runs")->find(name)->value, testing::ElementsAre(first, second));
    EXPECT_DOUBLE_EQ(results.find("seeds")->find(name)->value[0], (first + second) / 2);
  }
  const Outcome status = run(folder.path(), {"sweep", "p.toml", "-o", "sweep", "--status"});
  EXPECT_THAT(status.output, testing::ContainsRegex("seeds .* early +blocked +seconds\n"));
}

// However slow the machine, one block is done before the control is asked.
TEST(Program, TheWallTimeBudgetStopsCleanly) {
  const Folder folder("wall_time");
  folder.write("p.toml", small_system);
  ASSERT_EQ(run(folder.path(), {"prepare", "p.toml", "-o", "state.h5", "-q"}).code, 0);
  const std::vector<std::string> arguments = {"run",         "p.toml",
                                              "-o",          "run.h5",
                                              "--from",      "state.h5",
                                              "--wall-time", "0.1",
                                              "--set",       "dynamics.duration=1e6",
                                              "--set",       "output.samples.interval=1e5"};
  const Outcome stopped = run(folder.path(), arguments);
  EXPECT_EQ(stopped.code, 5);
  EXPECT_THAT(stopped.errors, HasSubstr("the same command continues"));
  const Outcome continued = run(folder.path(), arguments);
  EXPECT_EQ(continued.code, 5);
  EXPECT_THAT(continued.errors, HasSubstr("continuing at time"));
}

TEST(Program, ASweepWorksOffItsJobsAndContinues) {
  const Folder folder("sweep");
  folder.write("p.toml", small_system + "[sweep.grid]\n\"system.packing_fraction\" = [0.3, 0.4]\n");
  const std::vector<std::string> sweep = {"sweep", "p.toml", "-o", "sweep", "-j", "2", "-q"};
  std::vector<std::string> status = {"sweep", "p.toml", "-o", "sweep", "--status", "--json"};
  EXPECT_EQ(Json::parse(run(folder.path(), status).output)["jobs"][0]["stage"], "waiting");
  ASSERT_EQ(run(folder.path(), sweep).code, 0);
  const Json jobs = Json::parse(run(folder.path(), status).output)["jobs"];
  ASSERT_EQ(jobs.size(), 2u);
  for (const Json& job : jobs) {
    EXPECT_EQ(job["stage"], "done");
    EXPECT_EQ(job["run"]["overlaps"], 0);
    EXPECT_NEAR(job["run"]["packing_fraction"], job["values"]["system.packing_fraction"], 1e-12);
  }
  const auto file = folder / "sweep/packing_fraction-0.3/run.h5";
  const auto written = std::filesystem::last_write_time(file);
  EXPECT_EQ(run(folder.path(), sweep).code, 0);
  EXPECT_EQ(std::filesystem::last_write_time(file), written);
  EXPECT_EQ(run(folder.path(), {"analyze", "sweep", "-q"}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "sweep/results/runs.csv"));
  EXPECT_EQ(run(folder.path(), {"report", "sweep", "-q"}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "sweep/report.html"));
  std::vector<std::string> other = sweep;
  other.insert(other.end(), {"--set", "dynamics.duration=9"});
  expect_refusal(run(folder.path(), other), 2,
                 "was begun with dynamics.duration = 10.0, but now it is 9.0");
}

TEST(Program, AFailedJobDoesNotStopTheOthers) {
  const Folder folder("failed_job");
  // No square lattice of ellipses of aspect ratio 6 along x is as dense as 0.85.
  folder.write("p.toml", small_system +
                             "[[species]]\naspect_ratio = 6\n[[prepare.stage]]\n"
                             "method = \"lattice\"\narrangement = \"square\"\n"
                             "[sweep.grid]\n\"system.packing_fraction\" = [0.85, 0.1]\n");
  const Outcome outcome = run(folder.path(), {"sweep", "p.toml", "-o", "sweep"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.errors, AllOf(HasSubstr("packing_fraction-0.85: failed with exit code 2"),
                                    HasSubstr("packing_fraction-0.1: done")));
}

const std::string three_seeds = small_system + "[sweep.grid]\n\"system.seed\" = [1, 2, 3]\n";

TEST(Program, AJobOfASweepIsWorkedOffAlone) {
  const Folder folder("one_job");
  folder.write("p.toml", three_seeds);
  const std::vector<std::string> whole = {"sweep", "p.toml", "-o", "whole", "-q"};
  ASSERT_EQ(run(folder.path(), whole).code, 0);
  const auto job = [](const std::string& id) {
    return std::vector<std::string>{"sweep", "p.toml", "-o", "parts", "--job", id, "--json", "-q"};
  };
  const Outcome second = run(folder.path(), job("seed-2"));
  ASSERT_EQ(second.code, 0) << second.errors;
  EXPECT_EQ(Json::parse(second.output)["jobs"].size(), 1u);
  EXPECT_FALSE(std::filesystem::exists(folder / "parts/seed-1"));
  EXPECT_THAT(differing_datasets(folder / "whole/seed-2/run.h5", folder / "parts/seed-2/run.h5"),
              testing::IsEmpty());
  expect_refusal(run(folder.path(), job("seed-4")), 2,
                 "no job of the sweep has the name 'seed-4'; its jobs: seed-1, seed-2, seed-3");
}

// Two processes given the same job wait for who holds its folder. Then one works, and the other finds the job
// done. One that is given the whole sweep meanwhile is refused.
TEST(Program, AJobIsWorkedOffOnceHoweverManyProcessesGetIt) {
  const Folder folder("same_job");
  folder.write("p.toml", three_seeds);
  std::filesystem::create_directories(folder / "sweep/seed-1");
  const auto start = [&](const std::string& own_folder, std::vector<std::string> more) {
    std::filesystem::create_directory(folder / own_folder);
    std::vector<std::string> words = {"sweep", "../p.toml", "-o", "../sweep"};
    words.insert(words.end(), more.begin(), more.end());
    return std::async(std::launch::async,
                      [&folder, own_folder, words] { return run(folder / own_folder, words); });
  };
  // Not a FolderLock, which the processes to be started would inherit.
  const int held = checked(
      open((folder / "sweep/seed-1/lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666), "open");
  checked(flock(held, LOCK_EX), "flock");
  auto first = start("a", {"--job", "seed-1"}), second = start("b", {"--job", "seed-1"});
  for (const char* errors : {"a/standard_error", "b/standard_error"})
    while (folder.read(errors).find("waiting for another process") == std::string::npos)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  expect_refusal(start("c", {"-q"}).get(), 2, "another process works on this sweep");
  checked(close(held), "close");
  int worked = 0, found_done = 0;
  for (const Outcome& outcome : {first.get(), second.get()}) {
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
    const bool found = outcome.errors.find("1 of 1 jobs are done already") != std::string::npos;
    ++(found ? found_done : worked);
  }
  EXPECT_EQ(worked, 1);
  EXPECT_EQ(found_done, 1);
}

// A kill may fall between the last act of a preparation and the summary that says it is done.
TEST(Program, AStateWithoutItsSummaryIsMadeAgain) {
  const Folder folder("state_without_summary");
  folder.write("p.toml", small_system);
  const std::vector<std::string> sweep = {"sweep", "p.toml", "-o", "sweep", "-q"};
  ASSERT_EQ(run(folder.path(), sweep).code, 0);
  const auto job = folder / "sweep/job";
  std::filesystem::copy(job, folder / "before", std::filesystem::copy_options::recursive);
  for (const auto& entry : std::filesystem::directory_iterator(folder / "before"))
    if (const auto name = entry.path().filename();
        name != "state.h5" && name != "state.quality.json" && name != "parameters.toml")
      std::filesystem::remove_all(job / name);
  const Outcome again = run(folder.path(), sweep);
  ASSERT_EQ(again.code, 0) << again.errors;
  for (const char* file : {"state.h5", "run.h5"})
    EXPECT_THAT(differing_datasets(folder / "before" / file, job / file), testing::IsEmpty());
}

TEST(Program, AFinishedJobIsAnalyzedAnewWithOtherParametersOfTheAnalysis) {
  const Folder folder("analyzed_anew");
  folder.write("p.toml", small_system);
  std::vector<std::string> sweep = {"sweep", "p.toml", "-o", "sweep", "-q"};
  ASSERT_EQ(run(folder.path(), sweep).code, 0);
  const auto job = folder / "sweep/job";
  std::filesystem::copy(job, folder / "before", std::filesystem::copy_options::recursive);
  sweep.insert(sweep.end(), {"--set", "analysis.longest_lag=0.1"});
  ASSERT_EQ(run(folder.path(), sweep).code, 0);
  EXPECT_THAT(differing_datasets(folder / "before/run.h5", job / "run.h5"), testing::IsEmpty());
  // Fewer time differences.
  const char* table = "results/displacements_all.csv";
  EXPECT_LT(std::filesystem::file_size(job / table),
            std::filesystem::file_size(folder / "before" / table) / 2);
}

}  // namespace
}  // namespace vitrel
