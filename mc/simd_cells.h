#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "core/contact/simd.h"

namespace vitrel {

/// Cell lists for SIMD batches (`Batch` of resting_bodies.h). The particles of a cell fill the lanes of a linked list
/// of groups, all of which are full except the last. A cell has no capacity limit, and a test reads few groups.
///
/// The first group of a cell belongs to it; the others come from the free list of the cell's domain. A domain of n
/// particles needs at most n/simd_width groups of its free list, wherever its particles are, since a cell of k
/// particles needs ⌈k/simd_width⌉ − 1 < k/simd_width.
template <class Batch>
class SimdCells {
 public:
  using Index = std::uint32_t;
  static constexpr Index none = std::numeric_limits<Index>::max();

  struct alignas(64) Group : Batch {
    Index particle[simd_width] = {};
    Index cell = 0;
    Index next = none;  // next group of the same cell, or of the free list
    int count = 0;
  };

  /// The free groups of a domain, as a linked list.
  class FreeList {
   public:
    explicit FreeList(Index first) : first_(first) {}

   private:
    friend class SimdCells;
    Index first_;
  };

  /// Allocates memory for these numbers of cells and particles.
  void resize(std::size_t cells, std::size_t particles) {
    cells_ = cells;
    groups_.resize(cells + particles / simd_width);
    slot_.resize(particles);
  }

  /// Empties a cell before it is refilled.
  void clear(std::size_t cell) { empty(static_cast<Index>(cell), static_cast<Index>(cell)); }

  /// Returns the free groups of a domain that holds the particles begin … end − 1 in the order of all domains.
  FreeList free_groups(std::size_t begin, std::size_t end) {
    Index first = none;
    for (std::size_t k = end / simd_width; k-- > begin / simd_width;) {
      groups_[cells_ + k].next = first;
      first = static_cast<Index>(cells_ + k);
    }
    return FreeList(first);
  }

  void insert(std::size_t i, std::size_t cell, const auto& body, const auto& position,
              FreeList& free_list) {
    Index at = static_cast<Index>(cell);
    while (groups_[at].next != none) at = groups_[at].next;
    if (groups_[at].count == simd_width) at = append(at, free_list);
    Group& group = groups_[at];
    const int lane = group.count++;
    group.set(lane, body, position);
    group.particle[lane] = static_cast<Index>(i);
    slot_[i] = at * simd_width + static_cast<Index>(lane);
  }

  /// Removes particle i. The last particle of the cell takes its slot.
  void remove(std::size_t i, FreeList& free_list) {
    const Index group = slot_[i] / simd_width;
    Index before = none, last = groups_[group].cell;
    for (; groups_[last].next != none; last = groups_[last].next) before = last;
    Group& from = groups_[last];
    const int lane = --from.count;
    const Index moved = from.particle[lane];
    groups_[group].copy(lane_of(i), from, lane);
    groups_[group].particle[lane_of(i)] = moved;
    slot_[moved] = slot_[i];
    from.clear(lane);
    if (from.count > 0 || before == none) return;
    groups_[before].next = none;
    from.next = free_list.first_;
    free_list.first_ = last;
  }

  /// Exchanges the slots of particles i and j of one domain; the orientations stay in the slots.
  void exchange(std::size_t i, std::size_t j) {
    Group &group_i = group_of(i), &group_j = group_of(j);
    const int lane_i = lane_of(i), lane_j = lane_of(j);
    group_i.swap_shapes(lane_i, group_j, lane_j);
    std::swap(group_i.particle[lane_i], group_j.particle[lane_j]);
    std::swap(slot_[i], slot_[j]);
  }

  const Group& operator[](std::size_t group) const { return groups_[group]; }
  std::size_t group_index(std::size_t i) const { return slot_[i] / simd_width; }
  Group& group_of(std::size_t i) { return groups_[group_index(i)]; }
  int lane_of(std::size_t i) const { return static_cast<int>(slot_[i] % simd_width); }

  /// Returns the slot of lane 0 of a group; the slots of its other lanes follow.
  static Index first_slot(std::size_t group) { return static_cast<Index>(group * simd_width); }
  std::size_t particle_in(Index place) const {
    return groups_[place / simd_width].particle[place % simd_width];
  }

 private:
  // The group is constructed in place, since a new one would be copied.
  void empty(Index group, Index cell) { std::construct_at(&groups_[group])->cell = cell; }

  Index append(Index to, FreeList& free_list) {
    const Index added = free_list.first_, cell = groups_[to].cell;
    free_list.first_ = groups_[added].next;
    empty(added, cell);
    groups_[to].next = added;
    return added;
  }

  std::size_t cells_ = 0;
  std::vector<Group> groups_;  // the first group of each cell, then the free ones
  std::vector<Index> slot_;    // slot of each particle: group · simd_width + lane
};

}  // namespace vitrel
