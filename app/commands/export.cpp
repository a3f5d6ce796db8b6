#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands/common.h"
#include "core/error.h"
#include "workflow/export/gnuplot.h"
#include "workflow/export/trajectory_export.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

int export_results(const Arguments& arguments) {
  fs::path output = arguments.output;
  if (output.empty())
    output = arguments.input.parent_path() / (arguments.input.stem().string() + "_gnuplot");
  if (!output.has_filename()) output = output.parent_path();  // a folder given as "folder/"
  require_new(output);
  if (arguments.frames || arguments.shrink || arguments.voxels)
    throw UserError(
        "--frames, --shrink, --voxels: are for trajectories and packings, but --to gnuplot writes "
        "tables of results");
  const std::vector<TextFile> files = gnuplot_files(read_results(arguments.input));
  write_folder(output, files);
  print_summary(arguments,
                {{"output", output.string()}, {"format", "gnuplot"}, {"files", files.size()}});
  return success;
}

int export_frames(const Arguments& arguments) {
  const fs::path output = arguments.output.empty()
                              ? fs::path(arguments.input).replace_extension(arguments.format)
                              : arguments.output;
  require_new(output);
  Session session(arguments.quiet, arguments.wall_time);
  session.say()("export of " + arguments.input.string());
  const std::optional<ExportedTrajectory> done =
      export_trajectory({arguments.input, arguments.format, output, arguments.frames,
                         arguments.shrink, arguments.voxels},
                        session.budget());
  session.clear();
  if (!done) return stopped;
  nlohmann::ordered_json summary = {{"output", output.string()},
                                    {"format", arguments.format},
                                    {"frames", done->frames},
                                    {"particles", done->particles},
                                    {"bytes", done->bytes}};
  if (done->bodies > 0) summary["bodies"] = done->bodies;
  print_summary(arguments, summary);
  return success;
}

}  // namespace

int export_command(const Arguments& arguments) {
  return arguments.format == "gnuplot" ? export_results(arguments) : export_frames(arguments);
}

}  // namespace vitrel
