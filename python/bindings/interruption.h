#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <optional>

#include "core/state/stage.h"

namespace vitrel::python {

/// Whether an interval has passed since it was last so: the interpreter is not asked at every block.
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

/// Whether the interpreter exits: the threads of Python that are at work then, daemons, end their work.
bool interpreter_exits();
/// Lets the exit of the interpreter wait until no thread is at work without its lock: to take the lock later would end the
/// process.
void wait_at_exit();

/// Releases the lock of the interpreter for work without it. Throws SystemExit if the interpreter exits.
class Released {
  struct Counted {
    Counted();
    ~Counted();
    Counted(const Counted&) = delete;
    Counted& operator=(const Counted&) = delete;
  };
  Counted counted_;  // until the lock is taken again
  pybind11::gil_scoped_release release_;
};

/// What ends such work before its time: Ctrl-C, another signal whose handler raises, or the exit of the interpreter.
class Interruption {
 public:
  /// Asks the interpreter, now and then.
  bool requested() {
    if (interpreter_exits()) return true;
    if (raised_ || !check_.passed()) return raised_.has_value();
    const pybind11::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) raised_.emplace();
    return raised_.has_value();
  }
  /// Throws what the handler raised, or SystemExit.
  void raise() const;
  /// For work that can be thrown out of, and that may report its progress.
  void raise_if_requested() {
    if (requested()) raise();
  }
  void operator()(const Progress&) { raise_if_requested(); }

 private:
  Interval check_{std::chrono::milliseconds(50)};
  std::optional<pybind11::error_already_set> raised_;
};

}  // namespace vitrel::python
