#pragma once

#include <cstddef>
#include <cstdint>

#include "core/contact/ellipse_overlap_batch.h"
#include "mc/checkerboard.h"
#include "mc/simd_cells.h"

/// What the trial moves of one particle have in common.
namespace vitrel {

/// Uniform on 0 … n − 1, but for 1e-16 n.
inline std::size_t pick(std::uint64_t word, std::size_t n) {
  return static_cast<std::size_t>(static_cast<double>(word >> 11) * 0x1p-53 *
                                  static_cast<double>(n));
}

/// Uniform on the odd multiples of 2⁻⁵³ between −1 and 1: x as likely as −x.
inline double plus_minus_one(std::uint64_t word) {
  return static_cast<double>((static_cast<std::int64_t>(word) >> 10) | 1) * 0x1p-53;
}

/// The unit vector at an angle, in less time than the library's.
inline Vec2 axis_at(double angle) {
  PairArray x, y;
  directions<PairArray>({angle, angle}, x, y);
  return {x[0], y[0]};
}

/// What the decisions took.
struct OverlapTestCounts {
  std::uint64_t batches = 0;       ///< of up to `simd_width` others looked at
  std::uint64_t scalar_pairs = 0;  ///< pairs that were decided one by one
};

/// Whether particle i, as `batch` has it, at this position in this cell, is clear of all others.
inline bool clear_of_others(const Checkerboard& board, const SimdCells& cells, std::size_t i,
                            const OverlapBatch& batch, const Vec2& position,
                            const Checkerboard::Cell& cell, OverlapTestCounts& tests) {
  // It is not in its own way, nor are its images.
  const std::size_t own = cells.group_index(i);
  const OverlapBatch::Mask all(true);
  OverlapBatch::Mask others(true);
  others[static_cast<std::size_t>(cells.lane_of(i))] = false;
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
