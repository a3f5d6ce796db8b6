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
  std::filesystem::path input;             ///< trajectory or state
  std::filesystem::path output;            ///< .png, .svg (in the plane), or .mp4, a film; replaced
  std::optional<std::string> frames = {};  ///< as FrameRange reads it; the last, of a film all
  std::string colouring = {};              ///< one of colourings(); empty: default_colouring
  int width = 1000;                        ///< in pixels; films have even numbers of them
  std::optional<View> view = {};           ///< in space
  std::optional<double> rate = {};         ///< images per second of a film; 25
  KnownSystem known = {};                  ///< of files of other programs
};

struct WrittenPicture {
  std::uint64_t frames = 0;
  std::size_t particles = 0;
  int width = 0, height = 0;
  std::string colouring;
  std::optional<ColourScale> scale = {};  ///< of colours that show numbers
  ImportReport import = {};
};

/// Draws frames of a trajectory; the output appears under its name when it is complete. Nothing if the run control
/// stopped it: then there is no output. Throws UserError and FileError.
std::optional<WrittenPicture> write_picture(const PictureRequest& request,
                                            const RunControl& control);

}  // namespace vitrel
