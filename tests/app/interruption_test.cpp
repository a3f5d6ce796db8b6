// Runs that are killed, stopped or run out of disk, and continued by the same command.
#include <signal.h>
#include <sys/mount.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <system_error>
#include <utility>

#include "core/io/checked.h"
#include "core/random/stream.h"
#include "tests/app/end_to_end.h"
#include "tests/support/partial_files.h"

namespace vitrel {
namespace {

using std::chrono::milliseconds;

// A checkpoint at the end of every block, and many frames between two of them.
const std::string system_text =
    "[system]\nparticles = 30\n[dynamics]\nequilibration = 5\nduration = 300\n"
    "[output]\nsamples = { spacing = \"linear\", interval = 0.5 }\ncheckpoint_interval = 0\n";

// Disks so soft that some are in contact, and some close, at any time.
const std::string soft_text =
    "[[species]]\naspect_ratio = 1\n[dynamics.contact]\nlaw = \"linear_dashpot\"\n"
    "stiffness = \"1e5 N/m\"\ndamping = \"200 kg/s\"\n";

struct Kind {
  const char* name;
  std::string dynamics;
  std::string more = {};  ///< of the parameter file
};
const Kind newtonian{"newtonian", "newtonian"}, brownian{"brownian", "brownian"},
    soft{"soft", "brownian", soft_text};

std::string run_command(const std::string& output, const Kind& kind) {
  return "run p.toml -q --set dynamics.kind=" + kind.dynamics + " -o " + output;
}

/// Runs to the end without interruption and returns how long that took.
milliseconds run_uninterrupted(const Folder& folder, const std::string& output, const Kind& kind) {
  const auto start = std::chrono::steady_clock::now();
  folder.succeed(run_command(output, kind));
  return std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - start);
}

class Interruption : public testing::TestWithParam<Kind> {};

/// Starts the same run once for each signal, which comes after a share between `earliest` and `latest`
/// of an uninterrupted run's time; then lets it end. How long a run takes depends on what else the
/// machine does, so one that ends before its signal counts as a run of its own, and the next begins.
void expect_same_datasets_despite(const std::vector<int>& signals, const Kind& kind,
                                  const Folder& folder, double earliest, double latest) {
  checked(setenv("XDG_CACHE_HOME", folder.path().c_str(), 1), "setenv");  // of tables of contacts
  folder.write("p.toml", system_text + "correlations = { interval = 0.05 }\n" + kind.more);
  run_uninterrupted(folder, "first.h5", kind);  // which computes the tables of contacts
  const milliseconds whole = run_uninterrupted(folder, "whole.h5", kind);
  Stream moments(11, Purpose::tests);
  int round = 0;
  const auto output = [&round] { return "interrupted_" + std::to_string(round) + ".h5"; };
  const auto expect_same = [&] {
    folder.expect_same_datasets("whole.h5", output());
    folder.expect_same_datasets("whole.h5.correlations.h5", output() + ".correlations.h5");
  };
  std::size_t delivered = 0;
  for (std::size_t starts = 0; delivered < signals.size(); ++starts) {
    ASSERT_LT(starts, 10 * signals.size()) << "the run is too short for this test";
    const int signal = signals[delivered];
    const milliseconds delay(
        static_cast<int>(moments.uniform(earliest, latest) * static_cast<double>(whole.count())));
    const Outcome outcome =
        run_and_signal(folder.path(), words_of(run_command(output(), kind)), delay, signal);
    if (outcome.code == (signal == SIGKILL ? 128 + SIGKILL : 5)) {
      ++delivered;
    } else {
      ASSERT_EQ(outcome.code, 0) << outcome.errors;
      expect_same();
      ++round;
    }
  }
  folder.succeed(run_command(output(), kind));
  expect_same();
}

// Ten kills at moments spread over the run, so that preparation, checkpoints and frames all get their
// share.
TEST_P(Interruption, KilledAtTenRandomMomentsTheDatasetsAreTheSame) {
  const Folder folder(std::string("kill_") + GetParam().name);
  expect_same_datasets_despite(std::vector<int>(10, SIGKILL), GetParam(), folder, 0, 0.2);
}

TEST_P(Interruption, StoppedBySignalItExitsWithFiveAndContinues) {
  const Folder folder(std::string("stop_") + GetParam().name);
  expect_same_datasets_despite({SIGTERM, SIGINT, SIGUSR1}, GetParam(), folder, 0.2, 0.3);
}

/// True once a file has been written so many times.
std::function<bool()> written(const fs::path& file, int times) {
  const auto time_of = [file] {
    std::error_code none;
    return fs::last_write_time(file, none);
  };
  return [=, last = time_of(), left = times]() mutable {
    const auto now = time_of();
    left -= now != std::exchange(last, now);
    return left <= 0;
  };
}

/// The same for a preparation, every stage of which is killed some time, and stopped: now and then after a checkpoint,
/// however fast the machine.
TEST(InterruptedPreparation, KilledAndStoppedItsStateIsTheSame) {
  const Folder folder(
      "kill_prepare",
      "[system]\nparticles = 200\npacking_fraction = 0.75\n[prepare]\nquality_sweeps = 50\n"
      "[[prepare.stage]]\nmethod = \"insert\"\n"
      "[[prepare.stage]]\nmethod = \"swell\"\npacking_fraction = 0.6\n"
      "[[prepare.stage]]\nmethod = \"compress\"\npressure = 30\npacking_fraction = 0.65\n"
      "[[prepare.stage]]\nmethod = \"hybrid\"\npacking_fraction = 0.7\n"
      "[[prepare.stage]]\nmethod = \"grow\"\n"
      "[[prepare.stage]]\nmethod = \"sample\"\nsweeps = 500\n"
      "[output]\ncheckpoint_interval = 0.01\n");
  folder.succeed("prepare p.toml -o whole.h5 -q");
  const std::string prepare_parts = "prepare p.toml -o parts.h5 -q";
  int interrupted = 0;
  for (int round = 0; round < 12; ++round) {
    const int code = run_and_signal(folder.path(), words_of(prepare_parts),
                                    written(folder / "parts.h5.preparation", 1 + round % 4),
                                    round % 3 == 0 ? SIGTERM : SIGKILL)
                         .code;
    if (fs::exists(folder / "parts.h5")) break;
    EXPECT_THAT(code, testing::AnyOf(5, 128 + SIGKILL));
    ++interrupted;
  }
  EXPECT_GE(interrupted, 3);
  if (!fs::exists(folder / "parts.h5")) folder.succeed(prepare_parts);
  folder.expect_same_datasets("whole.h5", "parts.h5");
}

INSTANTIATE_TEST_SUITE_P(Dynamics, Interruption, testing::Values(newtonian, brownian, soft),
                         [](const auto& kind) { return std::string(kind.param.name); });

TEST(DifferingDatasets, SeesASingleChangedSeed) {
  const Folder folder("different", system_text);
  for (const std::string seed : {"1", "2"})
    folder.succeed(
        fmt::format("run p.toml -o {}.h5 -q --set dynamics.duration=1 --seed {}", seed, seed));
  EXPECT_THAT(differing_datasets(folder / "1.h5", folder / "2.h5"),
              testing::Contains("/particles/all/position/value"));
}

// The children of a killed sweep die with it, and the same command finishes the sweep.
TEST(Sweep, KilledAndContinuedItIsTheSame) {
  const Folder folder("kill_sweep", system_text + "[sweep.grid]\n\"system.seed\" = [1, 2, 3]\n");
  const std::string sweep = "sweep p.toml -j 2 -q -o ";
  const auto start = std::chrono::steady_clock::now();
  folder.succeed(sweep + "whole");
  const auto whole =
      std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - start);
  for (const double moment : {0.15, 0.3, 0.45})
    run_and_signal(folder.path(), words_of(sweep + "killed"),
                   milliseconds(static_cast<int>(moment * whole.count())), SIGKILL);
  folder.succeed(sweep + "killed");
  for (const std::string file : {"/seed-1/run.h5", "/seed-2/run.h5", "/seed-3/run.h5"})
    folder.expect_same_datasets("whole" + file, "killed" + file);
}

// An analysis that takes long: a stop comes as soon as it has begun.
TEST(Sweep, StoppedDuringTheAnalysisItContinues) {
  const Folder folder("stop_analysis",
                      system_text + "[analysis.structure]\nframes = 600\nwave_number_max = 150\n");
  folder.succeed("sweep p.toml -o sweep");
  const auto job = folder / "sweep/job";
  fs::copy_file(job / "results.h5", folder / "before.h5");
  for (const char* file : {"done.json", "analyze.json", "results.h5"}) fs::remove(job / file);
  const auto begins = [&job] {
    return std::ranges::any_of(partial_files(job), [](const std::string& name) {
      return name.starts_with("analyze.json");
    });
  };
  for (const int signal : {SIGTERM, SIGINT, SIGUSR1}) {
    const Outcome stopped =
        run_and_signal(folder.path(), words_of("sweep p.toml -o sweep"), begins, signal);
    EXPECT_EQ(stopped.code, 5);
    EXPECT_THAT(stopped.errors,
                AllOf(HasSubstr("the same command continues"), Not(HasSubstr("failed"))));
    EXPECT_FALSE(fs::exists(job / "done.json"));
    EXPECT_THAT(partial_files(job), IsEmpty());
  }
  folder.succeed("sweep p.toml -o sweep");
  folder.expect_same_datasets("before.h5", "sweep/job/results.h5");
}

// A real full disk: a tmpfs too small for the run. The frames written stay readable, and with room made
// the same command continues to the same datasets. Mounting needs rights that not every machine gives.
TEST(FullDisk, ExitsWithThreeLosesNothingAndContinues) {
  const Folder folder("full_disk", system_text);
  fs::create_directory(folder / "disk");
  if (mount("tmpfs", (folder / "disk").c_str(), "tmpfs", 0, "size=800k") != 0)
    GTEST_SKIP() << "mounting a tmpfs needs root";
  run_uninterrupted(folder, "whole.h5", newtonian);
  const Outcome full = folder.run(run_command("disk/run.h5", newtonian));
  EXPECT_EQ(full.code, 3);
  EXPECT_THAT(full.errors, HasSubstr("disk/run.h5"));
  EXPECT_GT(folder.summary("check disk/run.h5").value("frames", 0), 10);
  EXPECT_EQ(mount("tmpfs", (folder / "disk").c_str(), "tmpfs", MS_REMOUNT, "size=100m"), 0);
  folder.succeed(run_command("disk/run.h5", newtonian));
  folder.expect_same_datasets("whole.h5", "disk/run.h5");
  umount((folder / "disk").c_str());
}

}  // namespace
}  // namespace vitrel
