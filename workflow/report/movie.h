#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "analysis/trajectory.h"
#include "core/io/json.h"
#include "core/state/configuration.h"

/// @file
/// The moving particles of a run, packed small enough to travel inside a page.
namespace vitrel {

struct MovieLimits {
  std::size_t poses = 200'000;  ///< particles × frames shown; a pose takes 8 characters of a page
  std::size_t particles = 4'000;  ///< shown; of more, those that begin in the middle of the box
  std::size_t frames = 500;
  bool images_known = true;  ///< false: files without image counts; see Movie::jumps
};

/// A pose is three integers of 16 bits: x and y as fractions of the box, the angle as a fraction of
/// π (half a turn leaves an ellipse as it is), all modulo one. A step is 1/65536, in a box of 60
/// units a thousandth of a unit.
struct Movie {
  std::size_t run_particles = 0, run_frames = 0;  ///< of the run that it shows a part of
  Vec2 window = Vec2::Ones();  ///< sides of the part of the box that is shown, in fractions
  std::vector<double> time;    ///< of every shown frame
  std::vector<Vec2> box;       ///< side lengths, for every shown frame
  std::vector<Ellipse> shape;  ///< of every shown particle
  std::vector<std::int32_t> species;
  std::vector<std::string> species_names;
  std::vector<std::uint16_t> poses;  ///< x, y, angle of every particle in frame 0, in frame 1 …

  /// Particles travel to the next frame by the shortest way, except these, which travel further by
  /// so many boxes. None if the image counts are not known.
  struct Jump {
    std::size_t frame, particle;
    Shift<2> shift;
  };
  std::vector<Jump> jumps;

  /// For every shown frame: number of overlapping pairs, and the shown particles that are part of
  /// one, ascending. They come from the exact check (core/state/check.h) of the stored doubles, not
  /// from the rounded poses.
  std::vector<std::size_t> overlapping_pairs;
  std::vector<std::vector<std::size_t>> overlapping;

  std::size_t particles() const { return shape.size(); }
  std::size_t frames() const { return time.size(); }
};

/// Frames evenly thinned, the first and the last among them (with room for one, the last). Reads
/// one frame at a time. If particles travel so far between frames that the jumps would take more
/// than a tenth of the room, fewer frames are shown.
Movie film(Trajectory2& trajectory, const MovieLimits& limits = {});

/// For the script of the page; null without particles.
Json movie_data(const Movie& movie);

}  // namespace vitrel
