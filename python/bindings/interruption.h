#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <optional>

#include "core/state/stage.h"

namespace vitrel::python {

/// Tells whether an interval has passed since it last returned true, so that work need not ask the interpreter at
/// every block.
class Interval {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Interval(Clock::duration length) : length_(length) {}
  bool passed() {
    const Clock::time_point now = Clock::now();
    if (now - last_ < length_) return false;
    last_ = now;
    return true;
  }

 private:
  Clock::duration length_;
  Clock::time_point last_ = Clock::now();
};

/// Whether the interpreter is exiting. Daemon threads that are at work then end their work.
bool interpreter_exits();
/// Makes the exit of the interpreter wait until no thread works without its lock, because taking the lock later would
/// end the process.
void wait_at_exit();

/// Releases the lock of the interpreter during work that does not need it. Throws SystemExit if the interpreter is
/// exiting.
class Released {
  struct Counted {
    Counted();
    ~Counted();
    Counted(const Counted&) = delete;
    Counted& operator=(const Counted&) = delete;
  };
  Counted counted_;  // lives until the lock is taken again
  pybind11::gil_scoped_release release_;
};

/// Ends work without the lock early: at Ctrl-C, at another signal whose handler raises, or when the interpreter
/// exits.
class Interruption {
 public:
  /// Whether the work must end. The interpreter is asked only from time to time.
  bool requested() {
    if (interpreter_exits()) return true;
    if (raised_ || !check_.passed()) return raised_.has_value();
    const pybind11::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) raised_.emplace();
    return raised_.has_value();
  }
  /// Throws what the handler raised, or SystemExit.
  void raise() const;
  /// Ends work that an exception may leave; as a call operator it can take the place of a report of progress.
  void raise_if_requested() {
    if (requested()) raise();
  }
  void operator()(const Progress&) { raise_if_requested(); }

 private:
  Interval check_{std::chrono::milliseconds(50)};
  std::optional<pybind11::error_already_set> raised_;
};

}  // namespace vitrel::python
