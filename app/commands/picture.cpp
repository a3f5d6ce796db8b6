#include "workflow/picture/picture.h"

#include <nlohmann/json.hpp>

#include "app/commands/commands.h"
#include "app/commands/common.h"
#include "app/terminal/exit_codes.h"
#include "app/terminal/session.h"
#include "core/io/json.h"
#include "workflow/analyze/analyze.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

/// Returns no value if the options do not mention the view.
std::optional<View> view_of(const PictureOptions& options) {
  if (!options.azimuth && !options.elevation && !options.whole) return std::nullopt;
  const View usual;
  return View{options.azimuth.value_or(usual.azimuth), options.elevation.value_or(usual.elevation),
              options.whole};
}

}  // namespace

int picture_command(const PictureOptions& options) {
  const fs::path output =
      options.output.empty() ? fs::path(options.input).replace_extension("png") : options.output;
  require_output_file(output, {options.input, options.import.file});
  Session session(options.print.quiet);
  session.say()("picture of " + options.input.string());
  const std::optional<WrittenPicture> done =
      write_picture({options.input, output, options.frames, options.colouring, options.width,
                     view_of(options), options.rate, import_choice(options.import)},
                    session.control());
  session.clear();
  if (!done) return stopped;
  Json summary = {{"output", output.string()},    {"frames", done->frames},
                  {"particles", done->particles}, {"width", done->width},
                  {"height", done->height},       {"colour", done->colouring}};
  if (done->scale) summary["colour_scale"] = {done->scale->low, done->scale->high};
  if (!done->import.empty()) summary["import"] = import_json(done->import);
  remark_import(options.print, options.input, done->import);
  print_summary(options.print, summary);
  return success;
}

}  // namespace vitrel
