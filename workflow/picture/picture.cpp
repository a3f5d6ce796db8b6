#include "workflow/picture/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "core/io/h5md.h"
#include "core/io/text_file.h"
#include "workflow/export/frame_range.h"
#include "workflow/picture/film.h"
#include "workflow/picture/image_files.h"

namespace vitrel {
namespace {

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

/// How far each particle has gone.
template <int Dim>
std::vector<double> displacements(const Configuration<Dim>& first, const Configuration<Dim>& now) {
  std::vector<double> result;
  for (std::size_t i = 0; i < now.size(); ++i)
    result.push_back(norm(Vec<Dim>(now.unwrapped(i) - first.unwrapped(i))));
  return result;
}

/// Gives the particles of all frames their colours.
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

/// One picture, or the pictures of a film.
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
