#include "app/terminal/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "workflow/sweep/job_worker.h"

namespace vitrel {
namespace {

using testing::HasSubstr;

/// What is shown of half the work, once the display has waited long enough.
std::string shown(ProgressDisplay display, const std::string& label = "structure") {
  testing::internal::CaptureStderr();
  display.begin(label);
  display.show({0, 0, "frames"});
  std::this_thread::sleep_for(std::chrono::milliseconds(250));
  display.show({0.5, 40, "frames"});
  return testing::internal::GetCapturedStderr();
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

TEST(DurationText, LeavesOutLeadingZeroParts) {
  EXPECT_EQ(duration_text(7), "0:07");
  EXPECT_EQ(duration_text(3 * 3600 + 5 * 60), "3:05:00");
  EXPECT_EQ(duration_text(86400 + 61), "1:00:01:01");
}

}  // namespace
}  // namespace vitrel
