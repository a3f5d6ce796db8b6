#include "core/io/h5md.h"
#include "python/bindings/arrays.h"
#include "python/bindings/bindings.h"
#include "python/bindings/interruption.h"
#include "workflow/analyze/analyze.h"
#include "workflow/export/trajectory_export.h"
#include "workflow/picture/picture.h"

namespace vitrel::python {
namespace {

/// Writes states of the same particles, which must be in the order of time.
template <int Dim>
void write_states(const std::filesystem::path& path, const py::list& states, bool velocities) {
  const auto& first = states[0].cast<const Configuration<Dim>&>();
  TrajectoryWriter writer = TrajectoryWriter::create(
      path, first, current_provenance("vitrel (Python)", "", 0), {.velocities = velocities});
  std::int64_t step = 0;
  for (const py::handle& state : states) {
    if (!py::isinstance<Configuration<Dim>>(state))
      throw UserError(fmt::format("state {} has another dimension than the first", step));
    const auto& now = state.cast<const Configuration<Dim>&>();
    if (!same_particles(first, now))
      throw UserError(fmt::format("state {} has other particles than the first", step));
    writer.write(now, step++);
  }
  writer.close();
}

void write_run(const std::filesystem::path& path, const py::list& states, bool velocities) {
  if (states.empty()) throw UserError("there are no states");
  py::isinstance<Configuration2>(states[0]) ? write_states<2>(path, states, velocities)
                                            : write_states<3>(path, states, velocities);
}

KnownSystem known(const std::vector<std::string>& overrides) {
  return known_system(AnalysisChoice{{}, overrides});
}

void export_file(const std::filesystem::path& input, const std::filesystem::path& output,
                 const std::string& format, const std::optional<std::string>& frames,
                 std::optional<double> shrink, std::optional<std::size_t> voxels, bool images,
                 const std::vector<std::string>& overrides) {
  Interruption interruption;
  {
    const Released released;
    export_trajectory({input, format, output, frames, shrink, voxels, images, known(overrides)},
                      {[&] { return interruption.requested(); }, {}, {}});
  }
  interruption.raise();
}

void write_film(const std::filesystem::path& input, const std::filesystem::path& output,
                const std::optional<std::string>& frames, const std::string& colouring, int width,
                std::optional<double> rate, const std::vector<std::string>& overrides) {
  Interruption interruption;
  {
    const Released released;
    write_picture({.input = input,
                   .output = output,
                   .frames = frames,
                   .colouring = colouring,
                   .width = width,
                   .rate = rate,
                   .known = known(overrides)},
                  {[&] { return interruption.requested(); }, {}, {}});
  }
  interruption.raise();
}

}  // namespace

void bind_files(py::module_& module) {
  module.def("write_run", &write_run, py::arg("path"), py::arg("states"), py::arg("velocities"));
  module.def(
      "export_formats",
      [](int dimension) {
        std::vector<std::string> names;
        for (const ExportFormat& format : export_formats())
          if (dimension == 2 ? format.in_the_plane : format.in_space) names.push_back(format.name);
        return names;
      },
      py::arg("dimension"));
  module.def("export_file", &export_file, py::arg("input"), py::arg("output"), py::arg("format"),
             py::arg("frames"), py::arg("shrink"), py::arg("voxels"), py::arg("images"),
             py::arg("overrides"));
  module.def("write_film", &write_film, py::arg("input"), py::arg("output"), py::arg("frames"),
             py::arg("colouring"), py::arg("width"), py::arg("rate"), py::arg("overrides"));
}

}  // namespace vitrel::python
