#include "workflow/picture/picture.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "core/error.h"
#include "core/io/atomic_file.h"
#include "core/io/checked.h"
#include "core/io/h5md.h"
#include "core/io/text_file.h"
#include "workflow/export/frame_range.h"
#include "workflow/picture/image_files.h"
#include "workflow/picture/ray_caster.h"

namespace vitrel {
namespace {

/// Starts a program that is found on PATH. Returns the number of the error, or 0.
int start(std::vector<std::string> words, pid_t& process) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  return posix_spawnp(&process, arguments[0], nullptr, nullptr, arguments.data(), environ);
}

/// A film (MP4) written by the program ffmpeg, which is found on PATH and receives the images through a socket. The
/// file appears under its name when it is complete. Throws FileError; ffmpeg writes its own messages to standard
/// error.
class Film {
 public:
  /// Width and height must be even. Throws UserError if ffmpeg cannot be started.
  Film(const std::filesystem::path& path, int width, int height, double images_per_second)
      : path_(path), pending_(path) {
    std::array<int, 2> ends{};
    checked(socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), "socketpair");
    checked(fcntl(ends[0], F_SETFD, FD_CLOEXEC), "fcntl");
    input_ = ends[0];
    // Players require yuv420p.
    const int error = start({"ffmpeg",
                             "-nostdin",
                             "-loglevel",
                             "error",
                             "-y",
                             "-f",
                             "rawvideo",
                             "-pixel_format",
                             "rgb24",
                             "-video_size",
                             fmt::format("{}x{}", width, height),
                             "-framerate",
                             fmt::format("{}", images_per_second),
                             "-i",
                             fmt::format("pipe:{}", ends[1]),
                             "-pix_fmt",
                             "yuv420p",
                             "-f",
                             "mp4",
                             "file:" + pending_.partial().string()},
                            process_);
    static_cast<void>(::close(ends[1]));
    if (error == 0) return;
    static_cast<void>(::close(ends[0]));
    throw UserError(fmt::format(
        "films are made by the program ffmpeg, which cannot be started: {}; install it, or write a "
        "picture (.png)",
        std::generic_category().message(error)));
  }
  /// Kills ffmpeg if the film was not closed.
  ~Film() {
    if (process_ == 0) return;
    static_cast<void>(kill(process_, SIGKILL));
    static_cast<void>(end_input());
  }
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;

  void add(const Image& image) {
    for (std::size_t sent = 0; sent < image.pixels.size();) {
      const ssize_t part =
          send(input_, &image.pixels[sent], image.pixels.size() - sent, MSG_NOSIGNAL);
      if (part < 0 && errno != EINTR) fail(end_input());
      sent += static_cast<std::size_t>(std::max<ssize_t>(part, 0));
    }
  }
  /// Waits until the film is complete, and gives the file its name.
  void close() {
    if (const int status = end_input(); status != 0) fail(status);
    pending_.commit();
  }

 private:
  /// Returns the status from waitpid.
  int end_input() {
    static_cast<void>(::close(input_));
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = 0;
    return status;
  }
  /// `status` is the status from waitpid.
  [[noreturn]] void fail(int status) const {
    throw FileError(fmt::format(
        "{}: cannot be written: ffmpeg {} {}", path_.string(),
        WIFSIGNALED(status) ? "was ended by the signal" : "ended early with the exit code",
        WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status)));
  }

  std::filesystem::path path_;
  AtomicFile pending_;
  pid_t process_ = 0;  ///< 0 if it has ended
  int input_ = -1;
};

using Frames = std::vector<std::uint64_t>;
constexpr double usual_rate = 25;

bool is_film(const PictureRequest& request) {
  return request.output.extension() == ".mp4";
}

void check_request(const PictureRequest& request, int dimension) {
  const std::string suffix = request.output.extension().string();
  if (suffix != ".png" && suffix != ".svg" && suffix != ".mp4")
    throw UserError(
        fmt::format("{}: a picture is called .png or, in two dimensions, .svg, and a film .mp4",
                    request.output.string()));
  if (suffix == ".svg" && dimension == 3)
    throw UserError(fmt::format("{}: is three-dimensional, and drawn as .png or .mp4 only",
                                request.input.string()));
  if (request.view && dimension == 2)
    throw UserError(fmt::format(
        "{}: is two-dimensional; --azimuth, --elevation and --whole are for three dimensions",
        request.input.string()));
  if (request.rate && !is_film(request)) throw UserError("--rate: is for films, .mp4");
}

Frames chosen_frames(const TrajectoryReader& reader, const PictureRequest& request) {
  const FrameRange range(request.frames.value_or(is_film(request) ? ":" : "-1"));
  Frames chosen = range.of(reader.frames(), request.input.string());
  if (!is_film(request) && chosen.size() > 1)
    throw UserError(
        fmt::format("--frames {}: selects {} frames, but {} shows one; a film is called .mp4",
                    *request.frames, chosen.size(), request.output.string()));
  return chosen;
}

/// The distance that each particle has moved since the first frame.
template <int Dim>
std::vector<double> displacements(const Configuration<Dim>& first, const Configuration<Dim>& now) {
  std::vector<double> result;
  for (std::size_t i = 0; i < now.size(); ++i)
    result.push_back(norm(Vec<Dim>(now.unwrapped(i) - first.unwrapped(i))));
  return result;
}

/// Colours the particles of all frames.
template <int Dim>
class Colourist {
 public:
  Colourist(const TrajectoryReader& reader, const std::string& colouring)
      : first_(reader.read<Dim>(0)),
        colouring_(colouring.empty() ? default_colouring(first_) : colouring) {
    if (!by_displacement()) return;
    if (const std::string obstacle = reader.obstacle_to_motion(); !obstacle.empty())
      throw UserError(
          fmt::format("{}: displacements are not known: {}", reader.path().string(), obstacle));
    scale_ = displacement_scale(displacements(first_, reader.read<Dim>(reader.frames() - 1)));
  }

  std::vector<Colour> colours(const Configuration<Dim>& frame) {
    return by_displacement() ? sequential_colours(displacements(first_, frame), *scale_)
                             : particle_colours(frame, colouring_, scale_);
  }
  const std::string& colouring() const { return colouring_; }
  const std::optional<ColourScale>& scale() const { return scale_; }

 private:
  bool by_displacement() const { return colouring_ == "displacement"; }

  Configuration<Dim> first_;
  std::string colouring_;
  std::optional<ColourScale> scale_;
};

Scene scene_of(const PictureRequest&, const Configuration2& frame,
               const std::vector<Colour>& colours) {
  return scene_of(frame, colours);
}
Scene scene_of(const PictureRequest& request, const Configuration3& frame,
               const std::vector<Colour>& colours) {
  return scene_of(frame, colours, request.view.value_or(View{}));
}

/// A file with one picture, or with the pictures of a film.
class PictureFile {
 public:
  explicit PictureFile(const PictureRequest& request) : request_(request), width_(request.width) {}

  void add(const Scene& scene) {
    if (height_ == 0) begin(scene);
    if (film_) return film_->add(cast_rays(scene, width_, height_));
    write_text(request_.output, request_.output.extension() == ".svg"
                                    ? svg_of(scene, width_)
                                    : png_of(cast_rays(scene, width_, height_)));
  }
  void close() {
    if (film_) film_->close();
  }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  void begin(const Scene& scene) {
    if (is_film(request_)) width_ += width_ % 2;
    height_ = height_of(scene, width_);
    if (!is_film(request_)) return;
    height_ += height_ % 2;
    film_.emplace(request_.output, width_, height_, request_.rate.value_or(usual_rate));
  }

  const PictureRequest& request_;
  int width_, height_ = 0;
  std::optional<Film> film_;
};

template <int Dim>
std::optional<WrittenPicture> write_frames(const TrajectoryReader& reader,
                                           const PictureRequest& request,
                                           const RunControl& control) {
  const Frames chosen = chosen_frames(reader, request);
  Colourist<Dim> colourist(reader, request.colouring);
  PictureFile file(request);
  Configuration<Dim> frame;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    if (control.stop_requested()) return std::nullopt;
    reader.read_places(chosen[k], frame);
    file.add(scene_of(request, frame, colourist.colours(frame)));
    const auto count = static_cast<double>(k + 1);
    control.report_progress({count / static_cast<double>(chosen.size()), count, "frame"});
  }
  file.close();
  return WrittenPicture{chosen.size(), frame.size(),          file.width(),
                        file.height(), colourist.colouring(), colourist.scale()};
}

}  // namespace

std::optional<WrittenPicture> write_picture(const PictureRequest& request,
                                            const RunControl& control) {
  const TrajectoryReader reader(request.input, request.known);
  check_request(request, reader.dimension());
  std::optional<WrittenPicture> done = reader.dimension() == 2
                                           ? write_frames<2>(reader, request, control)
                                           : write_frames<3>(reader, request, control);
  if (done) done->import = reader.import_report();
  return done;
}

}  // namespace vitrel
