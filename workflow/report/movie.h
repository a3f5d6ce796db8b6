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
/// The moving particles of a run, or the particles of a single state, compact enough to be part of a page.
namespace vitrel {

struct MovieLimits {
  std::size_t characters = 1'600'000;  ///< in the page; a pose takes 8, in space 19
  /// The largest number that is shown. If there are more, those that begin in the middle of the box are shown.
  std::size_t particles = 4'000;
  std::size_t frames = 500;
  bool images_known = true;  ///< false for files without image counts (Movie::jumps)
};

/// The poses of particles as integers of 16 bits. A pose holds the coordinates as fractions of the box, modulo one.
/// In the plane, the angle follows as a fraction of π, modulo one, because half a turn leaves an ellipse unchanged.
/// In space, the quaternion w, x, y, z follows as signed fractions of 1. A step of a fraction is 1/65536, which in a
/// box of 60 units is a thousandth of a unit; a step of a quaternion is 1/32767.
template <int Dim>
struct Movie {
  static constexpr std::size_t pose_size = Dim == 2 ? 3 : 7;

  /// Numbers of the whole run, of which the movie may show a part.
  std::size_t run_particles = 0, run_frames = 0;
  /// The sides of the part of the box that is shown, as fractions of the box.
  Vec<Dim> window = Vec<Dim>::Ones();
  std::vector<double> time;               ///< of every shown frame
  std::vector<Vec<Dim>> box;              ///< side lengths in every shown frame
  std::vector<ParticleShape<Dim>> shape;  ///< of every shown particle
  std::vector<std::int32_t> species;
  std::vector<std::string> species_names;
  std::vector<std::uint16_t> poses;  ///< of every particle in frame 0, then in frame 1 …

  /// Particles move to the next frame along the shortest path, except for these, which move by so many boxes more.
  /// There are none if the image counts are not known.
  struct Jump {
    std::size_t frame, particle;
    Shift<Dim> shift;
  };
  std::vector<Jump> jumps;

  /// In space, the images whose bodies meet the window, other than the particles themselves, for every shown frame.
  /// In the plane there are none, because the page draws whole boxes side by side.
  struct Image {
    std::size_t particle;
    Shift<Dim> shift;
  };
  std::vector<std::vector<Image>> images;

  /// The number of overlapping pairs in every shown frame, and the shown particles that overlap, in ascending order.
  /// They come from the exact check (core/state/check.h) of the stored doubles, not from the rounded poses.
  std::vector<std::size_t> overlapping_pairs;
  std::vector<std::vector<std::size_t>> overlapping;

  std::size_t particles() const { return shape.size(); }
  std::size_t frames() const { return time.size(); }
};

using Movie2 = Movie<2>;
using Movie3 = Movie<3>;
using AnyMovie = std::variant<Movie2, Movie3>;

/// Films a trajectory. Frames are thinned evenly and include the first and the last, or only the last if there is
/// room for one. One frame is in memory at a time. If particles move so far between frames that the jumps would take
/// more than a tenth of the room, fewer frames are shown. If there are more particles than the limit, the movie shows
/// those that lie in the middle of the box in the first frame: in the plane their centres, in space any part of them.
template <int Dim>
Movie<Dim> film(Trajectory<Dim>& trajectory, const MovieLimits& limits = {});

/// The movie for the script of the page; null if there are no particles.
Json movie_data(const AnyMovie& movie);

}  // namespace vitrel
