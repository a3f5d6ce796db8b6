#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/io/json.h"
#include "core/state/check.h"
#include "core/state/configuration.h"

/// @file
/// A packing, packed small enough to travel inside a page.
namespace vitrel {

/// A pose is seven integers of 16 bits: x, y, z as fractions of the box, modulo one, and the quaternion
/// w, x, y, z as fractions of 1 with a sign. A step is 1/65536 of the box, or 1/32767.
struct PackingScene {
  std::size_t particles = 0;   ///< of the packing; more than are shown if only a part is
  Vec3 box = Vec3::Ones();     ///< side lengths
  Vec3 window = Vec3::Ones();  ///< side lengths of the part in the middle that is shown

  // One entry per shown particle.
  std::vector<Ellipsoid> shape;
  std::vector<std::int32_t> species;
  std::vector<std::uint16_t> poses;
  std::vector<std::string> species_names;

  /// The images, other than the particles themselves, whose bodies meet the window.
  struct Image {
    std::size_t particle;
    Shift<3> shift;
  };
  std::vector<Image> images;

  /// From the exact check of the stored doubles, not of the rounded poses: number of overlapping pairs in
  /// the packing, and the shown particles that are part of one, ascending.
  std::size_t overlapping_pairs = 0;
  std::vector<std::size_t> overlapping;
};

/// Of more than `max_particles` those that meet a part in the middle of the box, of a volume for about
/// as many. `check` is that of the packing.
PackingScene packing_scene(const Configuration3& packing, const ExactCheck<3>& check,
                           std::size_t max_particles = 10'000);

/// For the script of the page.
Json scene_data(const PackingScene& scene);

}  // namespace vitrel
