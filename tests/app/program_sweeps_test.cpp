// Sweeps from outside: jobs, their order, and what becomes of those that fail.
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <future>
#include <thread>

#include "analysis/results.h"
#include "core/io/checked.h"
#include "tests/app/end_to_end.h"
#include "tests/app/systems.h"

namespace vitrel {
namespace {

using Json = nlohmann::json;

TEST(Program, ASweepOfThreeDimensions) {
  const Folder folder("sweep_of_packings",
                      small_packing + "[sweep.grid]\n\"system.seed\" = [1, 2]\n");
  const Json packings = folder.summary("sweep p.toml -o packings");
  for (const Json& job : packings["jobs"]) {
    expect_keys(job["prepare"], {"packing_fraction", "orientation_ratio", "reduced_pressure",
                                 "collisions", "wall_seconds"});
    EXPECT_EQ(job["analyze"]["orientation_ratio"], job["prepare"]["orientation_ratio"]);
    EXPECT_FALSE(job.contains("run"));
  }
  EXPECT_EQ(packings["seeds"][0]["seeds"], 2);
  folder.succeed("analyze packings -q");
  const Results results = read_results(folder / "packings/results.h5");
  EXPECT_EQ(results.find("runs")->find("reduced_pressure")->value[1],
            packings["jobs"][1]["prepare"]["reduced_pressure"]);
  EXPECT_EQ(results.find("seeds")->rows(), 1u);
  folder.succeed("analyze packings/seed-1 -o a.h5 -q");

  const Json runs = folder.summary("sweep p.toml -o runs --set dynamics.duration=1");
  for (const Json& job : runs["jobs"]) {
    EXPECT_EQ(job["run"]["overlaps"], 0);
    EXPECT_NEAR(job["run"]["packing_fraction"], 0.2, 1e-12);
    EXPECT_TRUE(job["analyze"].contains("packing_fraction"));
  }
}

// What only the runs know stands beside the averages of the analysis.
TEST(Program, ASweepAveragesTheExceptionsOfSoftParticles) {
  const Folder folder("soft_sweep", soft_system + "[sweep.grid]\n\"system.seed\" = [1, 2]\n");
  checked(setenv("XDG_CACHE_HOME", folder.path().c_str(), 1), "setenv");
  const Json jobs = folder.summary("sweep p.toml -o sweep")["jobs"];
  folder.succeed("analyze sweep -q");
  const Results results = read_results(folder / "sweep/results.h5");
  for (const char* name : {"early_releases_per_collision", "blocked_rotations_per_collision"}) {
    const double first = jobs[0]["run"][name], second = jobs[1]["run"][name];
    EXPECT_THAT(results.find("runs")->find(name)->value, ElementsAre(first, second));
    EXPECT_DOUBLE_EQ(results.find("seeds")->find(name)->value[0], (first + second) / 2);
  }
  EXPECT_THAT(folder.run("sweep p.toml -o sweep --status").output,
              testing::ContainsRegex("seeds .* early +blocked +seconds\n"));
}

// However slow the machine, one block is done before the control is asked.
TEST(Program, TheWallTimeBudgetStopsCleanly) {
  const Folder folder("wall_time", small_system);
  folder.succeed("prepare p.toml -o state.h5 -q");
  const std::string command =
      "run p.toml -o run.h5 --from state.h5 --wall-time 0.1 --set dynamics.duration=1e6 "
      "--set output.samples.interval=1e5";
  for (const char* told : {"the same command continues", "continuing at time"}) {
    const Outcome stopped = folder.run(command);
    EXPECT_EQ(stopped.code, 5);
    EXPECT_THAT(stopped.errors, HasSubstr(told));
  }
}

TEST(Program, ASweepWorksOffItsJobsAndContinues) {
  const Folder folder("sweep",
                      small_system + "[sweep.grid]\n\"system.packing_fraction\" = [0.3, 0.4]\n");
  const std::string sweep = "sweep p.toml -o sweep -j 2 -q";
  const std::string status = "sweep p.toml -o sweep --status";
  EXPECT_EQ(folder.summary(status)["jobs"][0]["stage"], "waiting");
  folder.succeed(sweep);
  const Json jobs = folder.summary(status)["jobs"];
  ASSERT_EQ(jobs.size(), 2u);
  for (const Json& job : jobs) {
    EXPECT_EQ(job["stage"], "done");
    EXPECT_EQ(job["run"]["overlaps"], 0);
    EXPECT_NEAR(job["run"]["packing_fraction"], job["values"]["system.packing_fraction"], 1e-12);
  }
  const auto file = folder / "sweep/packing_fraction-0.3/run.h5";
  const auto written = fs::last_write_time(file);
  folder.succeed(sweep);
  EXPECT_EQ(fs::last_write_time(file), written);
  folder.succeed("analyze sweep -q");
  EXPECT_TRUE(fs::exists(folder / "sweep/results/runs.csv"));
  folder.succeed("report sweep -q");
  EXPECT_TRUE(fs::exists(folder / "sweep/report.html"));
  folder.expect_refusal(sweep + " --set dynamics.duration=9", 2,
                        "was begun with dynamics.duration = 10.0, but now it is 9.0");
}

TEST(Program, AFailedJobDoesNotStopTheOthers) {
  // No square lattice of ellipses of aspect ratio 6 along x is as dense as 0.85.
  const Folder folder("failed_job",
                      small_system +
                          "[[species]]\naspect_ratio = 6\n[[prepare.stage]]\n"
                          "method = \"lattice\"\narrangement = \"square\"\n"
                          "[sweep.grid]\n\"system.packing_fraction\" = [0.85, 0.1]\n");
  const Outcome outcome = folder.run("sweep p.toml -o sweep");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.errors, AllOf(HasSubstr("packing_fraction-0.85: failed with exit code 2"),
                                    HasSubstr("packing_fraction-0.1: done")));
}

const std::string three_seeds = small_system + "[sweep.grid]\n\"system.seed\" = [1, 2, 3]\n";

TEST(Program, AJobOfASweepIsWorkedOffAlone) {
  const Folder folder("one_job", three_seeds);
  folder.succeed("sweep p.toml -o whole -q");
  const std::string part = "sweep p.toml -o parts --job ";
  EXPECT_EQ(folder.summary(part + "seed-2")["jobs"].size(), 1u);
  EXPECT_FALSE(fs::exists(folder / "parts/seed-1"));
  folder.expect_same_datasets("whole/seed-2/run.h5", "parts/seed-2/run.h5");
  folder.expect_refusal(
      part + "seed-4 -q", 2,
      "no job of the sweep has the name 'seed-4'; its jobs: seed-1, seed-2, seed-3");
}

// Two processes given the same job wait for who holds its folder. Then one works, and the other finds the job
// done. One that is given the whole sweep meanwhile is refused.
TEST(Program, AJobIsWorkedOffOnceHoweverManyProcessesGetIt) {
  const Folder folder("same_job", three_seeds);
  fs::create_directories(folder / "sweep/seed-1");
  const auto start = [&](const fs::path& own_folder, const std::string& options) {
    fs::create_directory(folder.path() / own_folder);
    return std::async(std::launch::async, [=, &folder] {
      return testing_program::run(folder.path() / own_folder,
                                  words_of("sweep ../p.toml -o ../sweep " + options));
    });
  };
  // Not a FolderLock, which the processes to be started would inherit.
  const int held = checked(
      open((folder / "sweep/seed-1/lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666), "open");
  checked(flock(held, LOCK_EX), "flock");
  auto first = start("a", "--job seed-1"), second = start("b", "--job seed-1");
  for (const char* errors : {"a/standard_error", "b/standard_error"})
    while (folder.read(errors).find("waiting for another process") == std::string::npos)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  testing_program::expect_refusal(start("c", "-q").get(), 2, "another process works on this sweep");
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
  const Folder folder("state_without_summary", small_system);
  folder.succeed("sweep p.toml -o sweep -q");
  const auto job = folder / "sweep/job";
  fs::copy(job, folder / "before", fs::copy_options::recursive);
  for (const auto& entry : fs::directory_iterator(folder / "before"))
    if (const auto name = entry.path().filename();
        name != "state.h5" && name != "state.quality.json" && name != "parameters.toml")
      fs::remove_all(job / name);
  folder.succeed("sweep p.toml -o sweep -q");
  for (const std::string file : {"/state.h5", "/run.h5"})
    folder.expect_same_datasets("before" + file, "sweep/job" + file);
}

TEST(Program, AFinishedJobIsAnalyzedAnewWithOtherParametersOfTheAnalysis) {
  const Folder folder("analyzed_anew", small_system);
  folder.succeed("sweep p.toml -o sweep -q");
  const auto job = folder / "sweep/job";
  fs::copy(job, folder / "before", fs::copy_options::recursive);
  folder.succeed("sweep p.toml -o sweep -q --set analysis.longest_lag=0.1");
  folder.expect_same_datasets("before/run.h5", "sweep/job/run.h5");
  // Fewer time differences.
  const char* table = "results/displacements_all.csv";
  EXPECT_LT(fs::file_size(job / table), fs::file_size(folder / "before" / table) / 2);
}

}  // namespace
}  // namespace vitrel
