#include "app/workflow/export/trajectory_export.h"

#include <fmt/format.h>

#include <memory>

#include "app/workflow/export/csv.h"
#include "app/workflow/export/frame_range.h"
#include "app/workflow/export/gsd.h"
#include "app/workflow/export/xyz.h"
#include "core/error.h"
#include "core/io/h5md.h"
#include "core/io/pending_file.h"

namespace vitrel {
namespace {

std::unique_ptr<FrameSink> sink(const std::string& format, const std::filesystem::path& path,
                                const TrajectoryReader& reader) {
  const StoredMotion motion{reader.has("velocity"), reader.has("angular_velocity")};
  if (format == "gsd") return std::make_unique<GsdSink>(path, motion);
  if (format == "xyz") return std::make_unique<XyzSink>(path, motion);
  if (format == "csv") return std::make_unique<CsvSink>(path, motion);
  throw UserError(fmt::format(
      "--to {}: there is no such format, but {} for trajectories and gnuplot for results", format,
      fmt::join(trajectory_formats, ", ")));
}

}  // namespace

const std::vector<std::string> trajectory_formats = {"gsd", "xyz", "csv"};

std::optional<ExportedTrajectory> export_trajectory(const ExportRequest& request,
                                                    const Budget& budget) {
  const TrajectoryReader reader(request.input);
  const std::vector<std::uint64_t> chosen =
      FrameRange(request.frames).of(reader.frames(), request.input.string());
  PendingFile pending(request.output);
  const std::unique_ptr<FrameSink> file = sink(request.format, pending.partial(), reader);
  Configuration2 configuration;
  ExportedTrajectory done;
  for (const std::uint64_t frame : chosen) {
    if (budget.stop_requested()) return std::nullopt;
    reader.read(frame, configuration);
    file->write({frame, reader.steps()[frame], configuration});
    ++done.frames;
    const auto count = static_cast<double>(done.frames);
    budget.tell({count / static_cast<double>(chosen.size()), count, "frame"});
  }
  file->close();
  done.particles = configuration.size();
  done.bytes = std::filesystem::file_size(pending.partial());
  pending.commit();
  return done;
}

}  // namespace vitrel
