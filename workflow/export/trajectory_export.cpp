#include "workflow/export/trajectory_export.h"

#include <fmt/format.h>

#include <memory>

#include "core/error.h"
#include "core/io/atomic_file.h"
#include "core/io/h5md.h"
#include "workflow/export/csv.h"
#include "workflow/export/frame_range.h"
#include "workflow/export/gsd.h"
#include "workflow/export/packing.h"
#include "workflow/export/xyz.h"

namespace vitrel {
namespace {

[[noreturn]] void refuse_format(const std::string& format, int dimension) {
  throw UserError(
      fmt::format("--to {}: there is no such format, but {} for {} and gnuplot for results", format,
                  fmt::join(dimension == 2 ? trajectory_formats : packing_formats, ", "),
                  dimension == 2 ? "trajectories" : "packings in three dimensions"));
}

std::unique_ptr<FrameSink> sink(const std::string& format, const std::filesystem::path& path,
                                const TrajectoryReader& reader) {
  const StoredMotion motion{reader.has("velocity"), reader.has("angular_velocity")};
  if (format == "gsd") return std::make_unique<GsdSink>(path, motion);
  if (format == "xyz") return std::make_unique<XyzSink>(path, motion);
  if (format == "csv") return std::make_unique<CsvSink>(path, motion);
  refuse_format(format, reader.dimension());
}

std::optional<ExportedTrajectory> export_frames(const TrajectoryReader& reader,
                                                const ExportRequest& request,
                                                const RunControl& control) {
  if (request.shrink) throw UserError("--shrink: is for packings in three dimensions");
  if (request.voxels) throw UserError("--voxels: is for --to vti, in three dimensions");
  const std::vector<std::uint64_t> chosen =
      FrameRange(request.frames.value_or(":")).of(reader.frames(), request.input.string());
  AtomicFile pending(request.output);
  const std::unique_ptr<FrameSink> file = sink(request.format, pending.partial(), reader);
  Configuration2 configuration;
  ExportedTrajectory done;
  for (const std::uint64_t frame : chosen) {
    if (control.stop_requested()) return std::nullopt;
    reader.read(frame, configuration);
    file->write({frame, reader.steps()[frame], configuration});
    ++done.frames;
    const auto count = static_cast<double>(done.frames);
    control.report_progress({count / static_cast<double>(chosen.size()), count, "frame"});
  }
  file->close();
  done.particles = configuration.size();
  done.bytes = std::filesystem::file_size(pending.partial());
  pending.commit();
  return done;
}

void write_packing(const std::filesystem::path& path, const Packing& packing,
                   const ExportRequest& request) {
  if (request.format == "geo") return write_geo(path, packing);
  if (request.format == "vti") return write_vti(path, packing, request.voxels.value_or(100));
  if (request.format == "vtp") return write_vtp(path, packing);
  if (request.format == "csv") return write_packing_csv(path, packing);
  refuse_format(request.format, 3);
}

ExportedTrajectory export_packing(const TrajectoryReader& reader, const ExportRequest& request) {
  if (request.voxels && request.format != "vti") throw UserError("--voxels: is for --to vti");
  const std::vector<std::uint64_t> chosen =
      FrameRange(request.frames.value_or("-1")).of(reader.frames(), request.input.string());
  if (chosen.size() != 1)
    throw UserError(fmt::format("--frames {}: selects {} frames, but a packing is one",
                                *request.frames, chosen.size()));
  const Packing packing(reader.read<3>(chosen.front()), request.shrink.value_or(1));
  AtomicFile pending(request.output);
  write_packing(pending.partial(), packing, request);
  const std::uintmax_t bytes = std::filesystem::file_size(pending.partial());
  pending.commit();
  return {1, packing.configuration.size(), packing.bodies.size(), bytes};
}

}  // namespace

const std::vector<std::string> trajectory_formats = {"gsd", "xyz", "csv"};
const std::vector<std::string> packing_formats = {"geo", "vti", "vtp", "csv"};

std::optional<ExportedTrajectory> export_trajectory(const ExportRequest& request,
                                                    const RunControl& control) {
  const TrajectoryReader reader(request.input);
  if (reader.dimension() == 3) return export_packing(reader, request);
  return export_frames(reader, request, control);
}

}  // namespace vitrel
