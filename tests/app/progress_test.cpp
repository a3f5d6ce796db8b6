#include "app/terminal/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "workflow/sweep/job_worker.h"

namespace vitrel {
namespace {

using testing::HasSubstr;

/// What is printed to standard error meanwhile.
template <class Work>
std::string errors_of(Work work) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), std::fclose);
  const int terminal = dup(STDERR_FILENO);
  EXPECT_EQ(dup2(fileno(file.get()), STDERR_FILENO), STDERR_FILENO);
  work();
  EXPECT_EQ(dup2(terminal, STDERR_FILENO), STDERR_FILENO);
  EXPECT_EQ(close(terminal), 0);
  std::rewind(file.get());
  std::string text(4096, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file.get()));
  return text;
}

/// What is shown of half the work, once the display has waited long enough.
std::string shown(ProgressDisplay display, const std::string& label = "structure") {
  return errors_of([&] {
    display.begin(label);
    display.show({0, 0, "frames"});
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
    display.show({0.5, 40, "frames"});
  });
}

TEST(ProgressDisplay, NamesThePhase) {
  EXPECT_THAT(shown(ProgressDisplay(ProgressDisplay::Mode::terminal)),
              HasSubstr("\rstructure 50.0 %, frames 40 ("));
  EXPECT_EQ(shown(ProgressDisplay(ProgressDisplay::Mode::silent)), "");
}

// In the logs of its jobs.
TEST(ProgressDisplay, IsWhatASweepReads) {
  const std::string line = shown(ProgressDisplay(ProgressDisplay::Mode::terminal), "run").substr(1);
  EXPECT_EQ(share_of_run(line), 0.5);
  EXPECT_EQ(share_of_run("run of rotating ellipses"), 0);
}

/// What is left after `seconds` of work whose share done is fraction(seconds), noted once a second.
template <class Fraction>
std::optional<double> left_after(int seconds, Fraction fraction) {
  const auto mark = [&](int t) {
    return Pace::Mark{1.0 * t, {fraction(t), 0, "packing fraction"}};
  };
  Pace pace(mark(0));
  for (int t = 1; t <= seconds; ++t) pace.note(mark(t));
  return pace.left();
}

TEST(Pace, OfSteadyWorkIsExact) {
  for (const int seconds : {1, 2, 10, 99})
    EXPECT_NEAR(*left_after(seconds, [](int t) { return 0.01 * t; }), 100 - seconds, 1e-9);
}

// The share comes ever closer to 0.95, as of particles that jam. By the mean since the start, 3 to 7 s are left.
TEST(Pace, OfWorkThatStallsAnnouncesNoEnd) {
  const auto stalling = [](int t) { return 0.95 * (1 - std::exp(-0.1 * t)); };
  for (const int seconds : {60, 90, 120, 150})
    EXPECT_GT(*left_after(seconds, stalling), 0.5 * seconds);
}

TEST(Pace, OfWorkThatStartsAgainIsUnknown) {
  EXPECT_EQ(left_after(10, [](int t) { return t < 8 ? 0.1 * t : 0.3; }), std::nullopt);
}

TEST(DurationText, LeavesOutLeadingZeroParts) {
  EXPECT_EQ(duration_text(7), "0:07");
  EXPECT_EQ(duration_text(3 * 3600 + 5 * 60), "3:05:00");
  EXPECT_EQ(duration_text(86400 + 61), "1:00:01:01");
}

}  // namespace
}  // namespace vitrel
