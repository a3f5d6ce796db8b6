#pragma once

#include <cstddef>
#include <cstdint>

#include "core/contact/ellipse_overlap_batch.h"
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

/// The unit vector at an angle, faster than by the standard library.
inline Vec2 axis_at(double angle) {
  PairArray x, y;
  directions<PairArray>({angle, angle}, x, y);
  return {x[0], y[0]};
}

/// Whether particle i, with the shape and axis of `batch`, keeps the margin to all others at this position in this
/// cell.
inline bool clear_of_others(const Checkerboard& board, const SimdCells& cells, std::size_t i,
                            const OverlapBatch& batch, const Vec2& position,
                            const Checkerboard::Cell& cell, OverlapTestCounts& tests) {
  // Skips the particle itself and its images.
  const std::size_t own = cells.group_index(i);
  constexpr OverlapBatch::Lanes all = OverlapBatch::all_lanes;
  const OverlapBatch::Lanes others = all & ~(1u << cells.lane_of(i));
  for (const Checkerboard::NearLine& column : board.near_columns(cell.x))
    for (const Checkerboard::NearLine& row : board.near_rows(cell.y)) {
      const Vec2 offset = Vec2(column.translation, row.translation) - position;
      std::size_t at = board.index(column.cell, row.cell);
      do {
        ++tests.batches;
        const SimdCells::Group& group = cells[at];
        if (!batch.clear_of(group, offset, at == own ? others : all, tests.scalar_pairs))
          return false;
        at = group.next;
      } while (at != SimdCells::none);
    }
  return true;
}

}  // namespace vitrel
