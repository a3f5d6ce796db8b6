#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "analysis/trajectory.h"
#include "core/io/json.h"
#include "core/state/configuration.h"

/// @file
/// The moving particles of a run, or those of a single state, packed small enough to travel inside a page.
namespace vitrel {

struct MovieLimits {
  std::size_t characters = 1'600'000;  ///< of a page; a pose takes 8, in space 19
  std::size_t particles = 4'000;  ///< shown; of more, those that begin in the middle of the box
  std::size_t frames = 500;
  bool images_known = true;  ///< false: files without image counts; see Movie::jumps
};

/// A pose is some integers of 16 bits: the coordinates as fractions of the box, modulo one; then in the plane
/// the angle as a fraction of π (half a turn leaves an ellipse as it is), modulo one, and in space the
/// quaternion w, x, y, z as fractions of 1 with a sign. A step is 1/65536, in a box of 60 units a thousandth of
/// a unit; of quaternions it is 1/32767.
template <int Dim>
struct Movie {
  static constexpr std::size_t pose_size = Dim == 2 ? 3 : 7;

  std::size_t run_particles = 0, run_frames = 0;  ///< of the run that it shows a part of
  Vec<Dim> window = Vec<Dim>::Ones();  ///< sides of the part of the box that is shown, in fractions
  std::vector<double> time;            ///< of every shown frame
  std::vector<Vec<Dim>> box;           ///< side lengths, for every shown frame
  std::vector<ParticleShape<Dim>> shape;  ///< of every shown particle
  std::vector<std::int32_t> species;
  std::vector<std::string> species_names;
  std::vector<std::uint16_t> poses;  ///< of every particle in frame 0, in frame 1 …

  /// Particles travel to the next frame by the shortest way, except these, which travel further by
  /// so many boxes. None if the image counts are not known.
  struct Jump {
    std::size_t frame, particle;
    Shift<Dim> shift;
  };
  std::vector<Jump> jumps;

  /// In space, for every shown frame: the images, other than the particles themselves, whose bodies meet
  /// the window. In the plane the page draws whole boxes side by side.
  struct Image {
    std::size_t particle;
    Shift<Dim> shift;
  };
  std::vector<std::vector<Image>> images;

  /// For every shown frame: number of overlapping pairs, and the shown particles that are part of
  /// one, ascending. They come from the exact check (core/state/check.h) of the stored doubles, not
  /// from the rounded poses.
  std::vector<std::size_t> overlapping_pairs;
  std::vector<std::vector<std::size_t>> overlapping;

  std::size_t particles() const { return shape.size(); }
  std::size_t frames() const { return time.size(); }
};

using Movie2 = Movie<2>;
using Movie3 = Movie<3>;
using AnyMovie = std::variant<Movie2, Movie3>;

/// Frames evenly thinned, the first and the last among them (with room for one, the last). Reads
/// one frame at a time. If particles travel so far between frames that the jumps would take more
/// than a tenth of the room, fewer frames are shown. Of more particles than the limit those are shown that are
/// in the middle of the box in the first frame: in the plane their centres, in space any part of them.
template <int Dim>
Movie<Dim> film(Trajectory<Dim>& trajectory, const MovieLimits& limits = {});

/// For the script of the page; null without particles.
Json movie_data(const AnyMovie& movie);

}  // namespace vitrel
