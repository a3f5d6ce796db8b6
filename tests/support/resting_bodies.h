#pragma once

#include <vector>

#include "core/contact/resting_bodies.h"
#include "core/contact/round_free_path_batch.h"
#include "tests/support/free_paths.h"

/// Overlaps and free paths of bodies at rest, by any of their implementations.
namespace vitrel {

/// Shapes that the product knows nothing of but what it must of every shape, so that its general algorithms run.
struct PlainEllipse : Ellipse {
  explicit PlainEllipse(const Ellipse& ellipse) : Ellipse(ellipse) {}
};
struct PlainEllipsoid : Ellipsoid {
  explicit PlainEllipsoid(const Ellipsoid& ellipsoid) : Ellipsoid(ellipsoid) {}
};

/// Round bodies, as event chains know them.
template <class Shape>
struct RoundBodies : RestingBodies<Shape> {
  template <int direction>
  using FreePaths = RoundFreePathBatch<direction, Shape::dimension>;
};

/// A batch with the numbers of its bodies among all.
template <class Batch>
struct NumberedBatch : Batch {
  std::uint32_t particle[simd_width] = {};
};

/// Whether one body keeps the margin to all others, which are spread over batches.
template <class Bodies, int Dim>
bool all_look_clear(const typename Bodies::Body& one,
                    const std::vector<typename Bodies::Body>& others,
                    const std::vector<Vec<Dim>>& d, double margin, int first_lane,
                    std::uint64_t& scalar_tests) {
  const Vec<Dim> offset = Vec<Dim>::LinSpaced(0.3, -0.2);
  typename Bodies::Overlaps overlaps(one, others.data(), margin);
  for (std::size_t k = 0; k < others.size(); ++k) {
    NumberedBatch<typename Bodies::Batch> group;
    const int lane = (first_lane + static_cast<int>(k)) % simd_width;
    group.set(lane, others[k], d[k] - offset);
    group.particle[lane] = static_cast<std::uint32_t>(k);
    if (!overlaps.may_be_clear_of(group, offset, (1u << simd_width) - 1, scalar_tests))
      return false;
  }
  return overlaps.rest_is_clear(scalar_tests);
}

/// The free path of a scene along an axis.
template <class Bodies, int along, int Dim>
FreePath path_end(const FreePathScene<Dim>& scene, double max_length) {
  using Paths = typename Bodies::template FreePaths<along>;
  using Shape = decltype(Bodies::Body::shape);
  const auto body = [](const PlacedBody<Dim>& placed) {
    return Bodies::body(Shape(placed.shape), orientation_of(placed.pose));
  };
  std::vector<typename Bodies::Body> bodies;
  for (const PlacedBody<Dim>& other : scene.others) bodies.push_back(body(other));
  const auto moving = body(scene.moving);
  Paths paths(moving, bodies.data(), free_path_gap, max_length);
  const Vec<Dim> offset = Vec<Dim>::LinSpaced(0.25, -0.5);
  for (std::size_t begin = 0; begin < bodies.size(); begin += simd_width) {
    NumberedBatch<typename Bodies::Batch> group;
    for (std::size_t k = begin; k < std::min(begin + simd_width, bodies.size()); ++k) {
      const int lane = static_cast<int>(k - begin);
      group.set(lane, bodies[k], scene.others[k].pose.position - offset);
      group.particle[lane] = static_cast<std::uint32_t>(k);
    }
    paths.add(group, static_cast<std::uint32_t>(begin), offset, SimdBatch::Mask(true));
  }
  return paths.end();
}

template <class Bodies, int along, int Dim>
void check_path(const FreePathScene<Dim>& scene, double max_length, FreePathTally& tally) {
  check_free_path(scene, path_end<Bodies, along>(scene, max_length), along, max_length, tally);
}

}  // namespace vitrel
