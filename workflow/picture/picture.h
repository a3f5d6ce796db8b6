#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/io/foreign/foreign_file.h"
#include "core/state/stage.h"
#include "workflow/picture/ray_caster.h"

namespace vitrel {

struct PictureRequest {
  std::filesystem::path input;   ///< a trajectory or a state
  std::filesystem::path output;  ///< .png, .svg (in the plane) or .mp4 (a film); is replaced
  std::optional<std::string> frames = {};  ///< for FrameRange; by default the last, for a film all
  std::string colouring = {};              ///< one of colourings(); default_colouring if empty
  int width = 1000;                        ///< in pixels; films round it up to an even number
  std::optional<View> view = {};           ///< in space only
  std::optional<double> rate = {};         ///< images per second of a film; by default 25
  KnownSystem known = {};                  ///< for files of other programs
};

struct WrittenPicture {
  std::uint64_t frames = 0;
  std::size_t particles = 0;
  int width = 0, height = 0;
  std::string colouring;
  std::optional<ColourScale> scale = {};  ///< for colourings that show numbers
  ImportReport import = {};
};

/// Draws frames of a trajectory. The output appears under its name when it is complete. If the run control stops the
/// drawing, there is no output, and the result is empty. Throws UserError and FileError.
std::optional<WrittenPicture> write_picture(const PictureRequest& request,
                                            const RunControl& control);

}  // namespace vitrel
