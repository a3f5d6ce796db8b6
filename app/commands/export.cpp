#include "app/commands/export.h"

#include <nlohmann/json.hpp>

#include "app/commands/common.h"
#include "app/terminal/exit_codes.h"
#include "app/terminal/session.h"
#include "core/error.h"
#include "core/io/json.h"
#include "workflow/export/gnuplot.h"
#include "workflow/export/trajectory_export.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

int export_results(const ExportOptions& options) {
  fs::path output = options.output;
  if (output.empty())
    output = options.input.parent_path() / (options.input.stem().string() + "_gnuplot");
  if (!output.has_filename()) output = output.parent_path();  // a folder given as "folder/"
  require_new(output);
  if (options.frames || options.shrink || options.voxels)
    throw UserError(
        "--frames, --shrink, --voxels: are for trajectories and packings, but --to gnuplot writes "
        "tables of results");
  const std::vector<TextFile> files = gnuplot_files(read_results(options.input));
  write_folder(output, files);
  print_summary(options.print,
                {{"output", output.string()}, {"format", "gnuplot"}, {"files", files.size()}});
  return success;
}

int export_frames(const ExportOptions& options) {
  const fs::path output = options.output.empty()
                              ? fs::path(options.input).replace_extension(options.format)
                              : options.output;
  require_new(output);
  Session session(options.print.quiet);
  session.say()("export of " + options.input.string());
  const std::optional<ExportedTrajectory> done = export_trajectory(
      {options.input, options.format, output, options.frames, options.shrink, options.voxels},
      session.control());
  session.clear();
  if (!done) return stopped;
  Json summary = {{"output", output.string()},
                  {"format", options.format},
                  {"frames", done->frames},
                  {"particles", done->particles},
                  {"bytes", done->bytes}};
  if (done->bodies > 0) summary["bodies"] = done->bodies;
  print_summary(options.print, summary);
  return success;
}

}  // namespace

int export_command(const ExportOptions& options) {
  return options.format == "gnuplot" ? export_results(options) : export_frames(options);
}

}  // namespace vitrel
