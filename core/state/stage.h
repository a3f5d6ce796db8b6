#pragma once

#include <functional>
#include <string>

namespace vitrel {

/// The progress of a stage, for the front end.
struct Progress {
  double fraction = 0;   ///< 0 … 1
  double value = 0;      ///< the quantity that changes (simulated time, packing fraction, …)
  const char* quantity;  ///< its name
};

/// How a stage is stopped and how it reports. An empty `should_stop` never stops the stage, and other empty functions
/// are not called.
struct RunControl {
  std::function<bool()> should_stop;
  std::function<void(const Progress&)> on_progress;
  /// Called when the configuration and the state of the stage are consistent, so that continuing from copies of them
  /// gives bit-identical results.
  std::function<void()> on_resumable;

  bool stop_requested() const { return should_stop && should_stop(); }
  void report_progress(const Progress& progress) const {
    if (on_progress) on_progress(progress);
  }
  void notify_resumable() const {
    if (on_resumable) on_resumable();
  }
};

enum class StageEnd {
  reached,  ///< the stage reached its goal
  stalled,  ///< no further progress is possible; `reason` says why
  stopped,  ///< a stop was requested; the stage can be resumed
};

struct StageReport {
  StageEnd end = StageEnd::reached;
  std::string reason;  ///< for the user, in a few words
};

}  // namespace vitrel
