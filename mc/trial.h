#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/contact/resting_bodies.h"
#include "core/geometry/free_flight.h"
#include "core/state/configuration.h"
#include "mc/checkerboard.h"
#include "mc/simd_cells.h"
#include "mc/sweep_state.h"

/// @file
/// Common parts of trial moves of one particle.
namespace vitrel {

/// Returns a number uniform on 0 … n − 1, to 1e-16 n.
inline std::size_t pick(std::uint64_t word, std::size_t n) {
  return static_cast<std::size_t>(static_cast<double>(word >> 11) * 0x1p-53 *
                                  static_cast<double>(n));
}

/// Returns a number uniform on the odd multiples of 2⁻⁵³ between −1 and 1, which is symmetric about 0.
inline double plus_minus_one(std::uint64_t word) {
  return static_cast<double>((static_cast<std::int64_t>(word) >> 10) | 1) * 0x1p-53;
}

/// Returns a number uniform between −1 and 1 and symmetric about 0, for words whose share of 2⁶⁴ is not below `least`.
inline double share_above(std::uint64_t word, double least) {
  const double share = (static_cast<double>(word >> 11) + 0.5) * 0x1p-53;
  return 2 * ((share - least) / (1 - least)) - 1;
}

/// Returns an angle or a quaternion for each particle.
inline std::vector<double>& orientations(Configuration2& configuration) {
  return configuration.angle;
}
inline std::vector<Quaternion>& orientations(Configuration3& configuration) {
  return configuration.orientation;
}

/// Returns the orientation after a rotation. In the plane the angle is the first component of `turn`.
inline double rotated(const ParticleShape<2>&, double angle, const Vec2& turn) {
  return angle + turn[0];
}
/// In space `turn` is a vector in the own frame of the body; a spheroid does not rotate about its axis.
inline Quaternion rotated(const ParticleShape<3>& shape, const Quaternion& orientation, Vec3 turn) {
  if (const int axis = shape.symmetry_axis(); axis != no_axis) turn[axis] = 0;
  return normalized(orientation * rotation(turn));
}

/// Returns the bodies of all particles, in their order.
template <class Shape>
auto resting_bodies(Configuration<Shape::dimension>& configuration) {
  std::vector<typename RestingBodies<Shape>::Body> bodies;
  bodies.reserve(configuration.size());
  for (std::size_t i = 0; i < configuration.size(); ++i)
    bodies.push_back(
        RestingBodies<Shape>::body(Shape(configuration.shape[i]), orientations(configuration)[i]));
  return bodies;
}

/// Returns translation − position, by component (Checkerboard::Translation).
template <int Dim>
VITREL_INLINE Vec<Dim> offset_of(const std::array<double, Dim>& translation,
                                 const Vec<Dim>& position) {
  Vec<Dim> offset;
  for (int k = 0; k < Dim; ++k) offset[k] = translation[k] - position[k];
  return offset;
}

/// Calls visit(group, offset of its positions, lanes) for all particles near a position in this cell, except particle i
/// and its images, nearest cells first, until a call returns false. Returns whether all were visited.
template <int Dim, class Batch, class Visit>
VITREL_INLINE bool for_each_near_group(const Checkerboard<Dim>& board,
                                       const SimdCells<Batch>& cells, std::size_t i,
                                       const Vec<Dim>& position,
                                       const typename Checkerboard<Dim>::Cell& cell,
                                       Visit&& visit) {
  const std::size_t own = cells.group_index(i);
  constexpr unsigned all = (1u << simd_width) - 1;
  const unsigned others = all & ~(1u << cells.lane_of(i));
  return board.for_each_near(cell, [&](std::size_t at, const auto& translation) {
    const Vec<Dim> offset = offset_of<Dim>(translation, position);
    do {
      const auto& group = cells[at];
      if (!visit(group, offset, at == own ? others : all)) return false;
      at = group.next;
    } while (at != SimdCells<Batch>::none);
    return true;
  });
}

/// Returns whether particle i, as this body, keeps the margin to all others at this position in this cell.
template <class Shape>
VITREL_INLINE bool clear_of_others(const Checkerboard<Shape::dimension>& board,
                                   const SimdCells<typename RestingBodies<Shape>::Batch>& cells,
                                   std::size_t i, const typename RestingBodies<Shape>::Body& body,
                                   const std::vector<typename RestingBodies<Shape>::Body>& bodies,
                                   double margin, const Vec<Shape::dimension>& position,
                                   const typename Checkerboard<Shape::dimension>::Cell& cell,
                                   OverlapTestCounts& tests) {
  typename RestingBodies<Shape>::Overlaps overlaps(body, bodies.data(), margin);
  const auto may_be_clear = [&](const auto& group, const Vec<Shape::dimension>& offset,
                                unsigned lanes) {
    ++tests.batches;
    return overlaps.may_be_clear_of(group, offset, lanes, tests.scalar_pairs);
  };
  return for_each_near_group(board, cells, i, position, cell, may_be_clear) &&
         overlaps.rest_is_clear(tests.scalar_pairs);
}

}  // namespace vitrel
