#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "core/contact/ellipse_overlap_batch.h"
#include "core/contact/ellipsoid_overlap_batch.h"
#include "core/geometry/free_flight.h"
#include "core/state/configuration.h"
#include "mc/checkerboard.h"
#include "mc/simd_cells.h"
#include "mc/sweep_state.h"

/// @file
/// Common parts of trial moves of one particle.
namespace vitrel {

/// Uniform on 0 … n − 1, to 1e-16 n.
inline std::size_t pick(std::uint64_t word, std::size_t n) {
  return static_cast<std::size_t>(static_cast<double>(word >> 11) * 0x1p-53 *
                                  static_cast<double>(n));
}

/// Uniform on the odd multiples of 2⁻⁵³ between −1 and 1: symmetric about 0.
inline double plus_minus_one(std::uint64_t word) {
  return static_cast<double>((static_cast<std::int64_t>(word) >> 10) | 1) * 0x1p-53;
}

/// Uniform between −1 and 1, symmetric about 0, of the words whose share of 2⁶⁴ is not below `least`.
inline double share_above(std::uint64_t word, double least) {
  const double share = (static_cast<double>(word >> 11) + 0.5) * 0x1p-53;
  return 2 * ((share - least) / (1 - least)) - 1;
}

/// What an overlap test needs of a particle besides its position.
template <int Dim>
using OrientedBody = std::conditional_t<Dim == 2, OrientedEllipse, OrientedEllipsoid>;

inline OrientedEllipse oriented(const ParticleShape<2>& shape, double angle) {
  return {shape, direction(angle)};
}
inline OrientedEllipsoid oriented(const ParticleShape<3>& shape, const Quaternion& orientation) {
  return {shape, orientation};
}

/// Their orientation as the contact functions take it.
inline const Vec2& axes_of(const OrientedEllipse& body) {
  return body.axis;
}
inline const Quaternion& axes_of(const OrientedEllipsoid& body) {
  return body.orientation;
}

/// An angle or a quaternion for each particle.
inline std::vector<double>& orientations(Configuration2& configuration) {
  return configuration.angle;
}
inline std::vector<Quaternion>& orientations(Configuration3& configuration) {
  return configuration.orientation;
}

/// The orientation after a rotation. In the plane by the first component.
inline double rotated(const ParticleShape<2>&, double angle, const Vec2& turn) {
  return angle + turn[0];
}
/// In space by a vector in the own frame; rotations of a spheroid about its axis are none.
inline Quaternion rotated(const ParticleShape<3>& shape, const Quaternion& orientation, Vec3 turn) {
  if (const int axis = shape.symmetry_axis(); axis != no_axis) turn[axis] = 0;
  return normalized(orientation * rotation(turn));
}

/// Bodies of all particles, in their order.
template <int Dim>
std::vector<OrientedBody<Dim>> oriented_bodies(Configuration<Dim>& configuration) {
  std::vector<OrientedBody<Dim>> bodies;
  bodies.reserve(configuration.size());
  for (std::size_t i = 0; i < configuration.size(); ++i)
    bodies.push_back(oriented(configuration.shape[i], orientations(configuration)[i]));
  return bodies;
}

/// translation − position, by component (Checkerboard::Translation).
template <int Dim>
VITREL_INLINE Vec<Dim> offset_of(const std::array<double, Dim>& translation,
                                 const Vec<Dim>& position) {
  Vec<Dim> offset;
  for (int k = 0; k < Dim; ++k) offset[k] = translation[k] - position[k];
  return offset;
}

/// Calls visit(group, offset of its positions, lanes) for all particles near a position in this cell but particle i and
/// its images, nearest cells first, until one returns false; the result tells whether all were visited.
template <int Dim, class Visit>
VITREL_INLINE bool for_each_near_group(const Checkerboard<Dim>& board, const SimdCells<Dim>& cells,
                                       std::size_t i, const Vec<Dim>& position,
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
    } while (at != SimdCells<Dim>::none);
    return true;
  });
}

/// Whether particle i, with this shape and orientation, keeps the margin to all others at this position in this cell.
VITREL_FLATTEN inline bool clear_of_others(const Checkerboard<2>& board, const SimdCells<2>& cells,
                                           std::size_t i, const OrientedEllipse& body,
                                           const std::vector<OrientedEllipse>& /*bodies*/,
                                           double margin, const Vec2& position,
                                           const Checkerboard<2>::Cell& cell,
                                           OverlapTestCounts& tests) {
  const OverlapBatch batch(body.shape, body.axis, margin);
  return for_each_near_group(board, cells, i, position, cell,
                             [&](const auto& group, const Vec2& offset, unsigned lanes) {
                               ++tests.batches;
                               return batch.clear_of(group, offset, lanes, tests.scalar_pairs);
                             });
}
VITREL_FLATTEN inline bool clear_of_others(const Checkerboard<3>& board, const SimdCells<3>& cells,
                                           std::size_t i, const OrientedEllipsoid& body,
                                           const std::vector<OrientedEllipsoid>& bodies,
                                           double margin, const Vec3& position,
                                           const Checkerboard<3>::Cell& cell,
                                           OverlapTestCounts& tests) {
  EllipsoidOverlapBatch batch(body, bodies.data(), margin);
  return for_each_near_group(board, cells, i, position, cell,
                             [&](const auto& group, const Vec3& offset, unsigned lanes) {
                               ++tests.batches;
                               return batch.may_be_clear_of(group, group.particle, offset, lanes,
                                                            tests.scalar_pairs);
                             }) &&
         batch.rest_is_clear(tests.scalar_pairs);
}

}  // namespace vitrel
