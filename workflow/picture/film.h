#pragma once

#include <sys/types.h>

#include <filesystem>

#include "core/io/atomic_file.h"
#include "workflow/picture/ray_caster.h"

namespace vitrel {

/// A film (MP4), written by the program ffmpeg of PATH, which gets the images through a socket. It appears under its
/// name when it is complete. Throws FileError; what ffmpeg complains about is on standard error.
class Film {
 public:
  /// Width and height must be even. UserError if there is no ffmpeg.
  Film(const std::filesystem::path& path, int width, int height, double images_per_second);
  /// Ends ffmpeg, if the film is not closed.
  ~Film();
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;

  void add(const Image& image);
  /// Waits until the film is complete, and gives it its name.
  void close();

 private:
  int end_input();
  /// `status` as of waitpid.
  [[noreturn]] void fail(int status) const;

  std::filesystem::path path_;
  AtomicFile pending_;
  pid_t process_ = 0;  ///< 0: ended
  int input_ = -1;
};

}  // namespace vitrel
