#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/state/observer.h"
#include "core/state/stage.h"
#include "python/bindings/arrays.h"
#include "python/bindings/bindings.h"
#include "python/bindings/interruption.h"
#include "workflow/configuration/parameters.h"
#include "workflow/prepare/prepare.h"
#include "workflow/run/run.h"
#include "workflow/sweep/sweep.h"
#include "workflow/sweep/sweep_export.h"

namespace vitrel::python {
namespace {

/// Reports the work to Python by `say(line)` and `show(fraction, quantity, value)`, both of which may be None. It
/// stops the work at its next block if Python has a signal to handle, such as that of Ctrl-C.
class Listener {
 public:
  Listener(py::object say, py::object show) : say_(std::move(say)), show_(std::move(show)) {}

  Log log() const {
    return [this](const std::string& line) {
      const py::gil_scoped_acquire acquire;
      if (!say_.is_none()) say_(line);
    };
  }
  RunControl control() {
    return {
        [this] { return interruption_.requested(); }, [this](const Progress& p) { show(p); }, {}};
  }
  /// Raises, once the work has ended, KeyboardInterrupt or whatever else the handler of the signal raised.
  void raise() const { interruption_.raise(); }

 private:
  void show(const Progress& progress) {
    if (!display_.passed()) return;
    const py::gil_scoped_acquire acquire;
    if (!show_.is_none()) show_(progress.fraction, progress.quantity, progress.value);
  }

  py::object say_, show_;
  Interval display_{std::chrono::milliseconds(100)};
  Interruption interruption_;
};

/// Calls `see(state)` with a copy of every frame.
template <int Dim>
class FrameListener final : public Observer<Dim> {
 public:
  explicit FrameListener(const py::object& see) : see_(see) {}
  void observe(const Frame<Dim>& frame) override {
    auto copy = std::make_unique<Configuration<Dim>>(frame.configuration);
    const py::gil_scoped_acquire acquire;
    see_(py::cast(std::move(copy)));
  }

 private:
  const py::object& see_;
};

Parameters parameters_of(const std::filesystem::path& file,
                         const std::vector<std::string>& overrides,
                         const std::optional<std::filesystem::path>& start, bool shrink) {
  ParameterSource source{file, overrides, std::nullopt};
  if (start) source.start = StartFile{*start, shrink};
  return load_parameters(source);
}

template <int Dim>
py::object prepared(const PrepareRequest& request, Listener& listener) {
  Preparation<Dim> preparation = [&] {
    const Released released;
    return prepare<Dim>(request, listener.control(), listener.log());
  }();
  listener.raise();
  return py::make_tuple(std::move(preparation.configuration),
                        effective_parameters(preparation.parameters));
}

/// Returns the state and the parameters that made it.
py::object prepare_state(const std::filesystem::path& file,
                         const std::vector<std::string>& overrides,
                         const std::optional<std::filesystem::path>& start, bool shrink,
                         int threads, py::object say, py::object show) {
  Listener listener{std::move(say), std::move(show)};
  const PrepareRequest request{
      parameters_of(file, overrides, start, shrink), {}, "vitrel.prepare", threads};
  return prepared_dimension(request) == 2 ? prepared<2>(request, listener)
                                          : prepared<3>(request, listener);
}

template <int Dim>
std::string run_of(const RunRequest& request, Listener& listener, const py::object& see) {
  FrameListener<Dim> frames(see);
  const RunOutcome<Dim> outcome = [&] {
    const Released released;
    return run_simulation<Dim>(request, listener.control(), listener.log(),
                               see.is_none() ? nullptr : &frames);
  }();
  listener.raise();
  return run_summary(request, outcome).dump();
}

/// Returns the summary of the run as JSON.
std::string run_file(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                     const std::optional<std::filesystem::path>& start,
                     const std::filesystem::path& output, int threads, py::object say,
                     py::object show, const py::object& see) {
  Listener listener{std::move(say), std::move(show)};
  const RunRequest request{parameters_of(file, overrides, start, false), output, "vitrel.run",
                           threads};
  return run_dimension(request) == 2 ? run_of<2>(request, listener, see)
                                     : run_of<3>(request, listener, see);
}

/// Returns the numbers of jobs that are done and that failed.
py::tuple sweep_folder(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                       const std::filesystem::path& folder, const std::filesystem::path& program,
                       int parallel, py::object say, py::object show) {
  Listener listener{std::move(say), std::move(show)};
  const SweepRequest request{{file, overrides}, folder, program, parallel};
  const SweepOutcome outcome = [&] {
    const Released released;
    return run_sweep(request, listener.control(), listener.log());
  }();
  listener.raise();
  return py::make_tuple(outcome.done, outcome.failed);
}

/// Returns the command that runs the jobs, to be given in the folder.
std::string exported_sweep(const std::filesystem::path& file,
                           const std::vector<std::string>& overrides,
                           const std::filesystem::path& folder,
                           const std::filesystem::path& program, int parallel,
                           const std::string& name) {
  const SweepExport& to = sweep_export(name);
  export_sweep({{file, overrides}, folder, program, parallel}, to);
  return to.use;
}

}  // namespace

void bind_work(py::module_& module) {
  module.def("prepare", &prepare_state, py::arg("file"), py::arg("overrides"), py::arg("start"),
             py::arg("shrink"), py::arg("threads"), py::arg("say"), py::arg("show"));
  module.def("run", &run_file, py::arg("file"), py::arg("overrides"), py::arg("start"),
             py::arg("output"), py::arg("threads"), py::arg("say"), py::arg("show"),
             py::arg("see"));
  module.def("sweep", &sweep_folder, py::arg("file"), py::arg("overrides"), py::arg("folder"),
             py::arg("program"), py::arg("parallel"), py::arg("say"), py::arg("show"));
  module.def("export_sweep", &exported_sweep, py::arg("file"), py::arg("overrides"),
             py::arg("folder"), py::arg("program"), py::arg("parallel"), py::arg("name"));
}

}  // namespace vitrel::python
