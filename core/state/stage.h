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

/// What a stage may use, and whom it tells; an empty function means: never stop, tell nobody.
struct Budget {
  std::function<bool()> should_stop;
  std::function<void(const Progress&)> report;
  /// Called at moments in which the configuration and the state of the stage, together, are such that
  /// the stage goes on from copies of them bit by bit.
  std::function<void()> resumable;

  bool stop_requested() const { return should_stop && should_stop(); }
  void tell(const Progress& progress) const {
    if (report) report(progress);
  }
  void mark_resumable() const {
    if (resumable) resumable();
  }
};

enum class StageEnd {
  reached,  ///< the goal of the stage was reached
  stuck,    ///< no further progress is possible; `reason` says why
  stopped,  ///< the budget asked to stop; the stage can be resumed
};

struct StageReport {
  StageEnd end = StageEnd::reached;
  std::string reason;  ///< a few words, for a person
};

}  // namespace vitrel
