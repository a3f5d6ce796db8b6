#include "python/bindings/interruption.h"

#include <atomic>
#include <condition_variable>
#include <mutex>

namespace vitrel::python {
namespace {

std::atomic<bool> exits = false;
std::mutex counting;
std::condition_variable changed;
int at_work = 0;

[[noreturn]] void end_thread() {
  PyErr_SetNone(PyExc_SystemExit);
  throw pybind11::error_already_set();
}

void add_at_work(int change) {
  const std::lock_guard lock(counting);
  at_work += change;
  changed.notify_all();
}

void wait_for_all() {
  exits = true;
  const pybind11::gil_scoped_release release;
  std::unique_lock lock(counting);
  changed.wait(lock, [] { return at_work == 0; });
}

}  // namespace

bool interpreter_exits() {
  return exits;
}

void wait_at_exit() {
  pybind11::module_::import("atexit").attr("register")(pybind11::cpp_function(&wait_for_all));
}

Released::Counted::Counted() {
  if (exits) end_thread();
  add_at_work(1);
}
Released::Counted::~Counted() {
  add_at_work(-1);
}

void Interruption::raise() const {
  if (raised_) throw pybind11::error_already_set(*raised_);
  if (!interpreter_exits()) return;
  const pybind11::gil_scoped_acquire acquire;
  end_thread();
}

}  // namespace vitrel::python
