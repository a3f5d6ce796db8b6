#include "app/commands/commands.h"

#include <nlohmann/json.hpp>

#include "app/commands/common.h"
#include "app/terminal/exit_codes.h"
#include "app/terminal/session.h"
#include "core/io/json.h"
#include "workflow/analyze/analyze.h"
#include "workflow/export/trajectory_export.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

/// The output that the user names, or else `default_output`. It must not exist yet.
fs::path new_output(const ExportOptions& options, const fs::path& default_output) {
  fs::path output = options.output.empty() ? default_output : options.output;
  // The user may write a folder as "folder/".
  if (!output.has_filename()) output = output.parent_path();
  require_new(output);
  return output;
}

}  // namespace

int export_command(const ExportOptions& options) {
  ExportRequest request = {options.input,
                           options.format,
                           {},
                           options.frames,
                           options.shrink,
                           options.voxels,
                           options.images,
                           import_choice(options.import)};
  request.output = new_output(options, default_output(request));
  Session session(options.print.quiet);
  session.say()("export of " + options.input.string());
  const std::optional<ExportedTrajectory> done = export_trajectory(request, session.control());
  session.clear();
  if (!done) return stopped;
  Json summary = {{"output", request.output.string()},
                  {"format", options.format},
                  {"frames", done->frames},
                  {"particles", done->particles},
                  {"bytes", done->bytes}};
  if (!done->import.empty()) summary["import"] = import_json(done->import);
  if (done->bodies > 0) summary["bodies"] = done->bodies;
  remark_import(options.print, options.input, done->import);
  print_summary(options.print, summary);
  if (done->omits_images)
    remark(options.print, request.output.string() +
                              ": has the particles of a packing without their periodic images; "
                              "--images writes a table with them");
  return success;
}

}  // namespace vitrel
