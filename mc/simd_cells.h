#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/contact/overlap_look.h"

namespace vitrel {

/// Who is in which cell: the ellipses of a cell lie in the lanes of a chain of groups, all but the last
/// group full. So there is no largest number for a cell, and a look reads few groups.
///
/// The first group of a cell is its own; the others come from the spare groups of the domain that the
/// cell belongs to. A domain of n particles needs at most n/many of those, wherever its particles go:
/// ⌈k/many⌉ − 1 < k/many for a cell of k.
class LaneCells {
 public:
  using Index = std::uint32_t;
  static constexpr Index none = std::numeric_limits<Index>::max();

  struct alignas(64) Group : EllipseGroup {
    Index particle[many] = {};
    Index cell = 0;
    Index next = none;  // of the same cell, or of the spare ones
    int count = 0;
  };

  /// Spare groups of a domain, the next to be used first.
  class Spare {
   public:
    explicit Spare(Index first) : first_(first) {}

   private:
    friend class LaneCells;
    Index first_;
  };

  /// Room for so many cells and particles.
  void resize(std::size_t cells, std::size_t particles) {
    cells_ = cells;
    groups_.resize(cells + particles / many);
    place_.resize(particles);
  }

  /// Empties a cell of a domain that is about to be filled anew.
  void clear(std::size_t cell) {
    groups_[cell] = Group();
    groups_[cell].cell = static_cast<Index>(cell);
  }

  /// The spare groups of the domain that has particles begin … end − 1, counted through all domains.
  Spare spare_groups(std::size_t begin, std::size_t end) {
    Index first = none;
    for (std::size_t k = end / many; k-- > begin / many;) {
      groups_[cells_ + k].next = first;
      first = static_cast<Index>(cells_ + k);
    }
    return Spare(first);
  }

  void insert(std::size_t i, std::size_t cell, const Ellipse& shape, const Vec2& position,
              const Vec2& axis, Spare& spare) {
    Index at = static_cast<Index>(cell);
    while (groups_[at].next != none) at = groups_[at].next;
    if (groups_[at].count == many) at = append(at, spare);
    Group& group = groups_[at];
    const int lane = group.count++;
    group.set(lane, shape, position, axis);
    group.particle[lane] = static_cast<Index>(i);
    place_[i] = at * many + static_cast<Index>(lane);
  }

  /// The last of the cell takes the place of the one that goes.
  void remove(std::size_t i, Spare& spare) {
    const Index group = place_[i] / many;
    Index before = none, last = groups_[group].cell;
    for (; groups_[last].next != none; last = groups_[last].next) before = last;
    Group& from = groups_[last];
    const int lane = --from.count;
    const Index moved = from.particle[lane];
    groups_[group].set(lane_of(i), from.shape(lane), from.position(lane), from.axis(lane));
    groups_[group].particle[lane_of(i)] = moved;
    place_[moved] = place_[i];
    from.clear(lane);
    if (from.count > 0 || before == none) return;
    groups_[before].next = none;
    from.next = spare.first_;
    spare.first_ = last;
  }

  /// Particles i and j of one domain take each other's places, with their axes.
  void exchange(std::size_t i, std::size_t j) {
    Group &group_i = group_of(i), &group_j = group_of(j);
    const int lane_i = lane_of(i), lane_j = lane_of(j);
    const Ellipse shape_i = group_i.shape(lane_i), shape_j = group_j.shape(lane_j);
    group_i.set(lane_i, shape_j, group_i.position(lane_i), group_i.axis(lane_i));
    group_j.set(lane_j, shape_i, group_j.position(lane_j), group_j.axis(lane_j));
    std::swap(group_i.particle[lane_i], group_j.particle[lane_j]);
    std::swap(place_[i], place_[j]);
  }

  const Group& operator[](std::size_t group) const { return groups_[group]; }
  std::size_t group_index(std::size_t i) const { return place_[i] / many; }
  Group& group_of(std::size_t i) { return groups_[group_index(i)]; }
  int lane_of(std::size_t i) const { return static_cast<int>(place_[i] % many); }

  /// The name of the place of lane 0 of a group; those of its other lanes follow.
  static Index first_place(std::size_t group) { return static_cast<Index>(group * many); }
  std::size_t particle_at(Index place) const {
    return groups_[place / many].particle[place % many];
  }

 private:
  Index append(Index to, Spare& spare) {
    const Index added = spare.first_, cell = groups_[to].cell;
    spare.first_ = groups_[added].next;
    groups_[added] = Group();
    groups_[added].cell = cell;
    groups_[to].next = added;
    return added;
  }

  std::size_t cells_ = 0;
  std::vector<Group> groups_;  // the first of every cell, then the spare ones
  std::vector<Index> place_;   // of every particle: group · many + lane
};

}  // namespace vitrel
