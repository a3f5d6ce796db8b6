// Runs that end as soon as their relaxation times are known.

#include <cmath>

#include "analysis/dynamics/relaxation.h"
#include "core/error.h"
#include "core/io/h5md.h"
#include "tests/app/end_to_end.h"
#include "workflow/run/correlations_file.h"
#include "workflow/run/run.h"

namespace vitrel {
namespace {

constexpr double at_most = 400;

/// A Brownian fluid with τ of about 2.
Parameters fluid(const std::string& duration, const std::vector<std::string>& more = {}) {
  std::vector<std::string> settings = {"system.particles=60",      "system.packing_fraction=0.3",
                                       "prepare.quality_sweeps=0", "dynamics.kind=brownian",
                                       "dynamics.equilibration=1", "dynamics.duration=" + duration,
                                       "output.samples.interval=1"};
  settings.insert(settings.end(), more.begin(), more.end());
  return load_parameters({{}, settings});
}

const std::string until_known = "{ relaxation_times = 20, at_most = 400.0 }";

/// Stops at the end of every second block after the equilibration, and goes on.
RunOutcome<2> run_in_pieces(const RunRequest& request) {
  while (true) {
    int blocks = 0;
    const RunControl control{
        [&] { return blocks > 1; },
        [&](const Progress& progress) { blocks += std::string_view(progress.quantity) == "time"; },
        {}};
    RunOutcome<2> outcome = run_simulation<2>(request, control, {});
    if (outcome.complete) return outcome;
  }
}

TEST(KnownRelaxation, IsLookedAtAfterHalvesOfTheLongestTime) {
  std::vector<double> times;
  for (int k = 1; k <= 4000; ++k)
    if (is_time_to_look(0.1 * k, 0.1, at_most)) times.push_back(0.1 * k);
  const std::vector<double> wanted = {0.1,  0.2, 0.4, 0.8, 1.6, 3.2, 6.3,
                                      12.5, 25,  50,  100, 200, 400};
  ASSERT_EQ(times.size(), wanted.size());
  for (std::size_t k = 0; k < wanted.size(); ++k) EXPECT_NEAR(times[k], wanted[k], 1e-9);
}

TEST(KnownRelaxation, EndsARunThatHasLastedLongEnough) {
  const Folder folder("known_relaxation");
  const RunRequest request{fluid(until_known), folder / "run.h5"};
  const RunOutcome<2> outcome = run_simulation<2>(request, {}, {});
  ASSERT_TRUE(outcome.complete);
  const double duration = outcome.state.configuration.time;
  EXPECT_LT(duration, at_most);
  EXPECT_NEAR(std::log2(at_most / duration), std::round(std::log2(at_most / duration)), 1e-9);
  EXPECT_EQ(TrajectoryReader(folder / "run.h5").times().back(), duration);
  EXPECT_TRUE(run_simulation<2>(request, {}, {}).was_complete);

  // It lasted so many of the longer of the times that its correlations on the fly give.
  double relaxation = 0;
  for (const Table& table : on_the_fly_tables(folder / "run.h5"))
    for (const char* column : {"fs_1", "l_2"})
      if (const Column* found = table.name == "on_the_fly_all" ? table.find(column) : nullptr)
        relaxation = std::max(
            relaxation,
            relaxation_time({table.find("time")->value, found->value, found->error}).value);
  EXPECT_GT(relaxation, 0.5);
  EXPECT_GE(duration, 20 * relaxation);
  EXPECT_LT(duration, 60 * relaxation);
}

TEST(KnownRelaxation, EndsTheSameRunHoweverOftenItIsStopped) {
  const Folder folder("known_relaxation_stops");
  run_simulation<2>({fluid(until_known), folder / "whole.h5"}, {}, {});
  run_in_pieces({fluid(until_known), folder / "pieces.h5"});
  run_simulation<2>({fluid(until_known), folder / "threads.h5", "", 2}, {}, {});
  for (const char* other : {"pieces.h5", "threads.h5"})
    EXPECT_THAT(differing_datasets(folder / "whole.h5", folder / other), IsEmpty());
}

TEST(KnownRelaxation, IsWaitedForNoLongerThanAllowed) {
  const Folder folder("known_relaxation_slow");
  const RunRequest request{fluid("{ relaxation_times = 20, at_most = 32.0 }"), folder / "run.h5"};
  const RunOutcome<2> outcome = run_simulation<2>(request, {}, {});
  EXPECT_TRUE(outcome.complete);
  EXPECT_EQ(outcome.state.configuration.time, 32);
  // A run that was too short is made longer.
  const RunRequest longer{fluid(until_known), folder / "run.h5"};
  const RunOutcome<2> known = run_simulation<2>(longer, {}, {});
  EXPECT_TRUE(known.complete);
  EXPECT_GT(known.state.configuration.time, 32);
  EXPECT_LT(known.state.configuration.time, at_most);
}

TEST(KnownRelaxation, NeedsSamplesThatDoNotDependOnTheDuration) {
  const auto load = [](const std::vector<std::string>& settings) {
    return load_parameters({{}, settings});
  };
  EXPECT_THAT([&] { load({"dynamics.duration=" + until_known}); },
              testing::ThrowsMessage<UserError>(HasSubstr("'output.samples.interval' is missing")));
  const Parameters given =
      load({"dynamics.duration=" + until_known, "output.samples.spacing=logarithmic"});
  EXPECT_EQ(given.dynamics.relaxation_times, 20);
  EXPECT_EQ(given.dynamics.duration, at_most);
  EXPECT_TRUE(given.output.correlations);
  EXPECT_EQ(effective_parameters(given),
            effective_parameters(parse_parameters(effective_parameters(given), "again")));
}

}  // namespace
}  // namespace vitrel
