#include "workflow/export/trajectory_export.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "core/io/atomic_file.h"
#include "core/io/h5md.h"
#include "workflow/export/frame_range.h"
#include "workflow/export/gsd.h"
#include "workflow/export/packing.h"
#include "workflow/export/text_formats.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

using Frames = std::vector<std::uint64_t>;

/// Whether the export contains all images that meet the box.
bool is_of_packing(const ExportRequest& request) {
  const std::string& format = request.format;
  return format == "geo" || format == "vti" || format == "vtp" || request.images;
}

void check_format(const ExportRequest& request, int dimension) {
  std::vector<std::string> suitable;
  for (const ExportFormat& format : export_formats())
    if (dimension == 2 ? format.in_the_plane : format.in_space) suitable.push_back(format.name);
  if (std::ranges::find(suitable, request.format) == suitable.end())
    throw UserError(fmt::format("{}: is {}-dimensional, for which --to takes {}, but not {}",
                                request.input.string(), dimension == 2 ? "two" : "three",
                                fmt::join(suitable, ", "), request.format));
}

void check_options(const ExportRequest& request, int dimension) {
  if (request.images && (request.format != "csv" || dimension == 2))
    throw UserError(
        "--images: is for --to csv in three dimensions; geo, vti and vtp always have all images");
  if (request.shrink && !is_of_packing(request))
    throw UserError(
        "--shrink: is for packings in three dimensions, --to geo, vti, vtp, or csv with --images");
  if (request.voxels && request.format != "vti")
    throw UserError("--voxels: is for --to vti, in three dimensions");
}

Frames chosen_frames(const TrajectoryReader& reader, const ExportRequest& request) {
  const bool is_single = is_of_packing(request) && request.format != "vtp";
  const FrameRange range(request.frames.value_or(is_single ? "-1" : ":"));
  Frames chosen = range.of(reader.frames(), request.input.string());
  if (is_single && chosen.size() > 1)
    throw UserError(fmt::format("--frames {}: selects {} frames, but --to {}{} takes one",
                                *request.frames, chosen.size(), request.format,
                                request.images ? " --images" : ""));
  return chosen;
}

StoredMotion stored_motion(const TrajectoryReader& reader) {
  return {reader.has("velocity"), reader.has("angular_velocity")};
}

/// Returns no value if the run control stopped the export.
template <int Dim>
std::optional<ExportedTrajectory> copy_frames(const TrajectoryReader& reader, const Frames& chosen,
                                              FrameSink<Dim>& sink, const RunControl& control) {
  Configuration<Dim> configuration;
  ExportedTrajectory done;
  for (const std::uint64_t frame : chosen) {
    if (control.stop_requested()) return std::nullopt;
    reader.read(frame, configuration);
    sink.write({frame, reader.steps()[frame], configuration});
    ++done.frames;
    const auto count = static_cast<double>(done.frames);
    control.report_progress({count / static_cast<double>(chosen.size()), count, "frame"});
  }
  sink.close();
  done.particles = configuration.size();
  return done;
}

template <int Dim>
std::optional<ExportedTrajectory> export_file(const TrajectoryReader& reader, const Frames& chosen,
                                              const ExportRequest& request,
                                              const RunControl& control) {
  AtomicFile pending(request.output);
  const StoredMotion motion = stored_motion(reader);
  const auto sink = request.format == "gsd"
                        ? gsd_sink<Dim>(pending.partial(), motion)
                        : text_sink<Dim>(request.format, pending.partial(), motion);
  std::optional<ExportedTrajectory> done = copy_frames(reader, chosen, *sink, control);
  if (!done) return done;
  done->bytes = fs::file_size(pending.partial());
  done->omits_images = Dim == 3 && request.format == "csv" && reader.frames() == 1;
  pending.commit();
  return done;
}

void write_packing(const fs::path& path, const Packing& packing, const ExportRequest& request,
                   StoredMotion motion) {
  if (request.format == "geo") return write_geo(path, packing);
  if (request.format == "vti") return write_vti(path, packing, request.voxels.value_or(100));
  if (request.format == "vtp") return write_vtp(path, packing, motion);
  write_packing_csv(path, packing);
}

ExportedTrajectory export_packing(const TrajectoryReader& reader, std::uint64_t frame,
                                  const ExportRequest& request) {
  const Packing packing(reader.read<3>(frame), request.shrink.value_or(1));
  AtomicFile pending(request.output);
  write_packing(pending.partial(), packing, request, stored_motion(reader));
  const std::uintmax_t bytes = fs::file_size(pending.partial());
  pending.commit();
  return {1, packing.configuration.size(), packing.bodies.size(), bytes};
}

std::optional<ExportedTrajectory> export_series(const TrajectoryReader& reader,
                                                const Frames& chosen, const ExportRequest& request,
                                                const RunControl& control) {
  if (request.output.extension() == ".vtp")
    throw UserError(fmt::format(
        "{}: {} frames make a folder of .vtp files, which should not be named like one of them; "
        "--frames -1 writes the last frame as a file",
        request.output.string(), chosen.size()));
  AtomicFile pending(request.output, make_partial_folder);
  VtpSeries series(pending.partial(), request.input.stem().string(), request.shrink.value_or(1),
                   stored_motion(reader));
  std::optional<ExportedTrajectory> done = copy_frames(reader, chosen, series, control);
  if (!done) return done;
  for (const auto& file : fs::directory_iterator(pending.partial()))
    done->bytes += file.file_size();
  pending.commit();
  return done;
}

}  // namespace

const std::vector<ExportFormat>& export_formats() {
  static const std::vector<ExportFormat> formats = {
      {"gsd", true, true},  {"xyz", true, true},  {"csv", true, true}, {"xytheta", true, false},
      {"geo", false, true}, {"vti", false, true}, {"vtp", false, true}};
  return formats;
}

fs::path default_output(const ExportRequest& request) {
  fs::path output = request.input;
  if (request.format == "vtp" &&
      chosen_frames(TrajectoryReader(request.input, request.known), request).size() > 1)
    return output.replace_extension() += "_vtp";
  return output.replace_extension(request.format == "xytheta" ? "dat" : request.format);
}

namespace {

std::optional<ExportedTrajectory> export_frames(const TrajectoryReader& reader,
                                                const ExportRequest& request,
                                                const RunControl& control) {
  check_format(request, reader.dimension());
  check_options(request, reader.dimension());
  const Frames chosen = chosen_frames(reader, request);
  if (request.format == "vtp" && chosen.size() > 1)
    return export_series(reader, chosen, request, control);
  if (is_of_packing(request)) return export_packing(reader, chosen.front(), request);
  return reader.dimension() == 2 ? export_file<2>(reader, chosen, request, control)
                                 : export_file<3>(reader, chosen, request, control);
}

}  // namespace

std::optional<ExportedTrajectory> export_trajectory(const ExportRequest& request,
                                                    const RunControl& control) {
  const TrajectoryReader reader(request.input, request.known);
  std::optional<ExportedTrajectory> done = export_frames(reader, request, control);
  if (done) done->import = reader.import_report();
  return done;
}

}  // namespace vitrel
