#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace vitrel {

/// How far a piece of work has come; handed to the front end now and then.
struct Progress {
  double fraction = 0;   ///< 0 … 1
  double value = 0;      ///< the quantity that moves (simulated time, packing fraction, …)
  const char* quantity;  ///< its name
};

/// What a stage may use, and whom it tells. Stages ask `should_stop` only at points from which they can
/// be resumed; an empty function means: never stop, tell nobody.
struct Budget {
  std::function<bool()> should_stop;
  std::function<void(const Progress&)> report;

  bool stop_requested() const { return should_stop && should_stop(); }
  void tell(const Progress& progress) const {
    if (report) report(progress);
  }
};

enum class StageEnd {
  reached,  ///< the goal of the stage was reached
  stuck,    ///< no further progress is possible; `reason` says why
  stopped,  ///< the budget asked to stop; the stage can be resumed
};

struct StageReport {
  StageEnd end = StageEnd::reached;
  std::string reason;  ///< one sentence, for a person
  std::uint64_t translations_tried = 0, translations_accepted = 0;
  std::uint64_t rotations_tried = 0, rotations_accepted = 0;

  void add_counts(const StageReport& other) {
    translations_tried += other.translations_tried;
    translations_accepted += other.translations_accepted;
    rotations_tried += other.rotations_tried;
    rotations_accepted += other.rotations_accepted;
  }
};

}  // namespace vitrel
