#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace vitrel {

/// The next event time of every particle, and the earliest of them all: an indexed 4-ary heap.
/// Equal times are ordered by particle, so the order never depends on the history of the heap.
/// Cost: O(log N) per change, O(1) for the earliest.
class Calendar {
 public:
  explicit Calendar(std::size_t particles = 0)
      : time_(particles, std::numeric_limits<double>::infinity()),
        heap_(particles),
        place_(particles) {
    for (std::size_t k = 0; k < particles; ++k) heap_[k] = place_[k] = static_cast<Index>(k);
  }

  std::size_t size() const { return time_.size(); }
  double time(std::size_t particle) const { return time_[particle]; }
  std::size_t earliest() const { return heap_.front(); }

  void set(std::size_t particle, double time) {
    assert(time == time);
    const bool sooner = time < time_[particle];
    time_[particle] = time;
    if (sooner)
      rise(place_[particle]);
    else
      sink(place_[particle]);
  }

 private:
  using Index = std::uint32_t;
  static constexpr std::size_t arity = 4;

  bool before(Index one, Index two) const {
    return time_[one] < time_[two] || (time_[one] == time_[two] && one < two);
  }

  void put(std::size_t slot, Index particle) {
    heap_[slot] = particle;
    place_[particle] = static_cast<Index>(slot);
  }

  void rise(std::size_t slot) {
    const Index particle = heap_[slot];
    while (slot > 0) {
      const std::size_t parent = (slot - 1) / arity;
      if (!before(particle, heap_[parent])) break;
      put(slot, heap_[parent]);
      slot = parent;
    }
    put(slot, particle);
  }

  void sink(std::size_t slot) {
    const Index particle = heap_[slot];
    while (true) {
      const std::size_t first = slot * arity + 1;
      if (first >= heap_.size()) break;
      const std::size_t last = std::min(first + arity, heap_.size());
      std::size_t best = first;
      for (std::size_t child = first + 1; child < last; ++child)
        if (before(heap_[child], heap_[best])) best = child;
      if (!before(heap_[best], particle)) break;
      put(slot, heap_[best]);
      slot = best;
    }
    put(slot, particle);
  }

  std::vector<double> time_;
  std::vector<Index> heap_;   // particles in heap order
  std::vector<Index> place_;  // where each particle stands in heap_
};

}  // namespace vitrel
