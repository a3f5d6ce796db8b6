#pragma once

#include <functional>
#include <string>

namespace vitrel {

/// How far a piece of work has come; handed to the front end now and then.
struct Progress {
  double fraction = 0;   ///< 0 … 1
  double value = 0;      ///< the quantity that moves (simulated time, packing fraction, …)
  const char* quantity;  ///< its name
};

/// What a stage may use, and whom it tells; an empty function means: never stop, report_progress nobody.
struct RunControl {
  std::function<bool()> should_stop;
  std::function<void(const Progress&)> on_progress;
  /// Called at moments in which the configuration and the state of the stage, together, are such that
  /// the stage goes on from copies of them bit by bit.
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
  reached,  ///< the goal of the stage was reached
  stalled,  ///< no further progress is possible; `reason` says why
  stopped,  ///< the control asked to stop; the stage can be resumed
};

struct StageReport {
  StageEnd end = StageEnd::reached;
  std::string reason;  ///< a few words, for a person
};

}  // namespace vitrel
