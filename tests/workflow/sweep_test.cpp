// Sweeps whose steps are done by a script in place of the program.
#include "workflow/sweep/sweep.h"

#include <cmath>
#include <fstream>
#include <numbers>

#include "core/error.h"
#include "tests/app/end_to_end.h"
#include "workflow/sweep/job_folder.h"
#include "workflow/sweep/seed_averages.h"
#include "workflow/sweep/sweep_status.h"

namespace vitrel {
namespace {

const std::string three_seeds =
    "[dynamics]\nduration = 10\n[sweep.grid]\n\"system.seed\" = [1, 2, 3]\n";

/// A sweep of the file p.toml into the folder s; the script does a step $1 of the job in whose folder it is, with the
/// sweep's folder as $sweep.
class StubbedSweep {
 public:
  explicit StubbedSweep(const std::string& name, const std::string& parameters) : folder_(name) {
    folder_.write("p.toml", parameters);
    make_steps("");
  }

  /// After these lines of shell, which may exit, every step ends well.
  void make_steps(const std::string& script) {
    folder_.write("stub", "#!/bin/sh\nsweep=" + folder_.path().string() +
                              "\nlast=\nfor word; do case $last in -o) product=$word;; esac; "
                              "last=$word; done\ncd \"$(dirname \"$product\")\"\n" +
                              script + "\ntouch \"$product\"; echo '{}'\n");
    fs::permissions(folder_ / "stub", fs::perms::owner_all);
  }

  SweepOutcome run(const RunControl& control = {}) {
    lines_.clear();
    return run_sweep({source(), folder_ / "s", folder_ / "stub"}, control,
                     [this](const std::string& line) { lines_.push_back(line); });
  }

  ParameterSource source() const { return {folder_ / "p.toml", {}, {}}; }
  std::vector<SweepJob> jobs() const { return sweep_jobs(source()); }
  fs::path job(const std::string& id) const { return folder_ / "s" / id; }
  std::string table() const { return sweep_table(jobs(), folder_ / "s"); }
  Json summary() const { return sweep_summary(jobs(), folder_ / "s"); }
  std::vector<std::string> changes() const { return sweep_changes(jobs(), folder_ / "s"); }
  const std::vector<std::string>& lines() const { return lines_; }
  const Folder& folder() const { return folder_; }

 private:
  Folder folder_;
  std::vector<std::string> lines_;
};

TEST(SweepStatus, TellsFailedAndStoppedJobsFromWaitingOnes) {
  StubbedSweep sweep("ends", three_seeds);
  EXPECT_EQ(sweep.summary()["jobs"][0]["stage"], "waiting");
  sweep.make_steps(
      "case $PWD$1 in *seed-1run) echo 'particles 3 and 7 overlap' >&2; exit 4;; "
      "*seed-2prepare) exit 5;; esac");
  const SweepOutcome outcome = sweep.run();
  EXPECT_EQ(outcome.done, 1u);
  EXPECT_EQ(outcome.failed, 1u);
  EXPECT_EQ(outcome.first_failure, 4);
  const Json jobs = sweep.summary()["jobs"];
  EXPECT_EQ(jobs[0]["stage"], "failed");
  EXPECT_EQ(jobs[0]["end"]["step"], "run");
  EXPECT_EQ(jobs[0]["end"]["exit_code"], 4);
  EXPECT_EQ(jobs[0]["end"]["message"], "particles 3 and 7 overlap");
  EXPECT_EQ(jobs[1]["stage"], "stopped");
  EXPECT_EQ(jobs[1]["end"]["step"], "prepare");
  EXPECT_EQ(jobs[2]["stage"], "done");
  EXPECT_THAT(sweep.table(),
              HasSubstr("seed-1: failed in run with exit code 4: particles 3 and 7 overlap\n"));
  // The next attempt forgets it.
  sweep.make_steps("if [ -e end.json ]; then exit 4; fi");
  EXPECT_EQ(sweep.run().done, 3u);
  EXPECT_EQ(sweep.summary()["jobs"][0]["stage"], "done");
  EXPECT_FALSE(fs::exists(sweep.job("seed-1") / "end.json"));
}

TEST(SweepStatus, SaysWhatHasChangedInTheParameterFile) {
  StubbedSweep sweep("changes", three_seeds);
  EXPECT_THAT(sweep.changes(), IsEmpty());
  sweep.run();
  EXPECT_THAT(sweep.changes(), IsEmpty());
  sweep.folder().write("p.toml",
                       "[dynamics]\nduration = 20\n[sweep.grid]\n\"system.seed\" = [1, 2]\n");
  EXPECT_THAT(sweep.changes(),
              ElementsAre("the parameters have changed since seed-1, seed-2 were begun: "
                          "dynamics.duration was 10.0 and is 20.0 now",
                          "no longer among the jobs of the parameter file: seed-3"));
  sweep.folder().write("p.toml",
                       "[dynamics]\nduration = 5\n[sweep.grid]\n\"system.seed\" = [1, 2]\n");
  EXPECT_THROW(sweep.run(), UserError);
  // The analysis may change: it is made anew.
  sweep.folder().write("p.toml", "[analysis]\nlongest_lag = 0.25\n" + three_seeds);
  EXPECT_THAT(sweep.changes(),
              ElementsAre("the parameters have changed since seed-1, seed-2, seed-3 were begun: "
                          "analysis.longest_lag was 0.5 and is 0.25 now"));
  sweep.make_steps("echo $1 >>steps");
  EXPECT_EQ(sweep.run().done, 3u);
  EXPECT_EQ(sweep.folder().read("s/seed-1/steps"), "run\nanalyze\n");
}

// A run that has not begun may still be changed.
TEST(Sweep, APreparedJobTakesOtherDynamics) {
  StubbedSweep sweep("other_dynamics", three_seeds);
  sweep.make_steps("if [ $1 = run ]; then exit 5; fi");
  EXPECT_TRUE(sweep.run().stopped);
  sweep.folder().write("p.toml",
                       "[dynamics]\nduration = 20\n[sweep.grid]\n\"system.seed\" = [1]\n");
  sweep.make_steps("");
  EXPECT_EQ(sweep.run().done, 1u);
}

/// The steps that a job of these parameters takes.
std::string steps_of(const std::string& name, const std::string& parameters) {
  StubbedSweep sweep(name, parameters);
  sweep.make_steps("echo $1 $2 >>steps");
  EXPECT_EQ(sweep.run().done, 1u);
  std::string steps = sweep.folder().read("s/job/steps");
  const std::string job = sweep.job("job").string() + "/";
  for (std::size_t at; (at = steps.find(job)) != std::string::npos;) steps.erase(at, job.size());
  return steps;
}

TEST(Sweep, WithoutDynamicsAJobIsAState) {
  EXPECT_EQ(steps_of("plane_state", "[system]\nparticles = 10\n"), "prepare parameters.toml\n");
  EXPECT_EQ(steps_of("packing", "[system]\ndimension = 3\n"),
            "prepare parameters.toml\nanalyze state.h5\n");
  EXPECT_EQ(steps_of("run_of_solids", "[system]\ndimension = 3\n[dynamics]\nduration = 1\n"),
            "prepare parameters.toml\nrun parameters.toml\nanalyze run.h5\n");
}

TEST(Sweep, AJobThatWasAStateBecomesARun) {
  StubbedSweep sweep("state_becomes_run", "[system]\nparticles = 10\n");
  EXPECT_EQ(sweep.run().done, 1u);
  sweep.folder().write("p.toml", "[system]\nparticles = 10\n[dynamics]\nduration = 1\n");
  sweep.make_steps("echo $1 >>steps");
  EXPECT_EQ(sweep.run().done, 1u);
  EXPECT_EQ(sweep.folder().read("s/job/steps"), "run\nanalyze\n");
}

TEST(Sweep, AFullDiskStopsIt) {
  StubbedSweep sweep("full_disk", three_seeds);
  sweep.make_steps("echo 'run.h5: cannot write: No space left on device' >&2; exit 3");
  const SweepOutcome outcome = sweep.run();
  EXPECT_EQ(outcome.failed, 1u);
  EXPECT_EQ(outcome.first_failure, 3);
  EXPECT_TRUE(outcome.stopped);
  EXPECT_THAT(sweep.lines().back(), HasSubstr("the disk is full"));
  EXPECT_EQ(sweep.summary()["jobs"][1]["stage"], "waiting");
  // The others know nothing of another mistake with files.
  sweep.make_steps("echo 'state.h5: cannot be read' >&2; exit 3");
  EXPECT_EQ(sweep.run().failed, 3u);
}

// Two jobs of 20 + 20 and 20 + 60 units of time. Each is half done until that has been reported.
TEST(Sweep, ProgressIsTheShareOfTheSimulatedTime) {
  StubbedSweep sweep("progress",
                     "[dynamics]\nequilibration = 20\n[sweep.grid]\n\"dynamics.duration\" = [20, "
                     "60]\n");
  sweep.make_steps(
      "if [ $1 = run ]; then echo 'run 50.0 %, time 20 (1/s)' >&2; "
      "while [ ! -e go ]; do sleep 0.01; done; fi");
  std::vector<double> fractions;
  RunControl control;
  control.on_progress = [&](const Progress& progress) {
    if (!fractions.empty() && fractions.back() == progress.fraction) return;
    fractions.push_back(progress.fraction);
    if (progress.fraction > 0.1) std::ofstream(sweep.job("duration-20") / "go");
    if (progress.fraction > 0.5) std::ofstream(sweep.job("duration-60") / "go");
  };
  EXPECT_EQ(sweep.run(control).done, 2u);
  std::erase_if(fractions, [](double f) { return f == 0 || f == 1 || f == 40.0 / 120; });
  EXPECT_THAT(fractions, ElementsAre(0.5 * 40 / 120, (40 + 0.5 * 80) / 120));
}

// The standard error of the mean of two values d apart is d/2; Student's quantiles for one degree of freedom are
// tan(πp/2). These two differ by more than their errors explain, and so their scatter alone counts.
TEST(SeedAverages, AreMeansWithIntervals) {
  const auto job = [](const char* density, const char* seed, double z) {
    return JobResult{{{"system.packing_fraction", density}, {"system.seed", seed}},
                     {{"z", z}, {"z_error", 0.1}, {"particles", 100}}};
  };
  const std::vector<SeedAverage> averages =
      seed_averages({job("0.4", "1", 2), job("0.5", "1", 7), job("0.4", "2", 3)});
  ASSERT_EQ(averages.size(), 2u);
  EXPECT_EQ(averages[0].name(), "packing_fraction 0.4");
  EXPECT_EQ(averages[0].seeds, 2u);
  EXPECT_EQ(averages[0].figures.size(), 2u);  // errors are not averaged
  EXPECT_EQ(averages[0].find("z").mean, 2.5);
  EXPECT_NEAR(averages[0].find("z").error, 0.5 * std::tan(0.6827 * std::numbers::pi / 2), 1e-9);
  EXPECT_NEAR(averages[0].find("z").half_width, 0.5 * std::tan(0.95 * std::numbers::pi / 2), 1e-9);
  EXPECT_TRUE(averages[0].find("z").is_excessive);
  EXPECT_NEAR(averages[0].find("z").scatter, std::sqrt(0.5) / 0.1, 1e-12);
  EXPECT_EQ(averages[0].find("particles").half_width, 0);
  EXPECT_EQ(averages[1].seeds, 1u);
  EXPECT_EQ(averages[1].find("z").mean, 7);
  EXPECT_TRUE(std::isnan(averages[1].find("z").error));
  const SeedAverage soft{{{"dynamics.contact.youngs_modulus", "\"1 GPa\""}}, 1, {}};
  EXPECT_EQ(soft.name(), "youngs_modulus 1 GPa");
}

TEST(SeedAverages, AreUnknownIfASeedLacksTheNumber) {
  const std::vector<SeedAverage> averages =
      seed_averages({{{}, {{"diffusion", 1}}}, {{}, {{"diffusion", std::nan("")}}}});
  EXPECT_EQ(averages[0].name(), "all");
  EXPECT_TRUE(std::isnan(averages[0].find("diffusion").mean));
  EXPECT_TRUE(std::isnan(averages[0].find("no such number").mean));
}

TEST(SweepStatus, GivesResultsAndAveragesOverSeeds) {
  StubbedSweep sweep("averages",
                     "[sweep.grid]\n\"system.seed\" = [1, 2]\n\"system.particles\" = [10]\n");
  sweep.make_steps(
      "touch \"$product\"; case $PWD in *seed-1*) z=2;; *) z=3;; esac\n"
      "echo \"{\\\"packing_fraction\\\": 0.5, \\\"reduced_pressure\\\": $z, \\\"overlaps\\\": "
      "null}\"; exit");
  sweep.run();
  EXPECT_EQ(sweep.table(),
            "job                  stage     phi  Z\n"
            "seed-1_particles-10  done   0.5000  2\n"
            "seed-2_particles-10  done   0.5000  3\n"
            "\n"
            "mean over seeds ± 95 %  seeds  phi          Z\n"
            "particles 10                2  0.5  2.5 ± 6.4\n");
  const Json seeds = sweep.summary()["seeds"];
  EXPECT_EQ(seeds[0]["seeds"], 2);
  EXPECT_EQ(json_text(seeds[0]["values"]), R"({"system.particles":10})");
  EXPECT_EQ(seeds[0]["figures"]["reduced_pressure"]["mean"], 2.5);
  EXPECT_NEAR(seeds[0]["figures"]["reduced_pressure"]["interval"][1],
              2.5 + 0.5 * std::tan(0.95 * std::numbers::pi / 2), 1e-9);
}

// The step that is asked to stop may be about to end; the next one does not begin.
TEST(Sweep, AskedToStopItBeginsNoStep) {
  StubbedSweep sweep("sweep_last_moment",
                     "[dynamics]\nduration = 10\n[sweep.grid]\n\"system.seed\" = [1]\n");
  sweep.make_steps("trap '' TERM INT USR1; echo $1 >> $sweep/begun; sleep 0.3");
  RunControl control;
  control.should_stop = [&] {
    return fs::exists(sweep.job("seed-1").parent_path().parent_path() / "begun");
  };
  const SweepOutcome outcome = sweep.run(control);
  EXPECT_TRUE(outcome.stopped);
  EXPECT_EQ(outcome.done + outcome.failed, 0u);
  std::ifstream begun(sweep.job("seed-1").parent_path().parent_path() / "begun");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(begun), {}), "prepare\n");
}

}  // namespace
}  // namespace vitrel
