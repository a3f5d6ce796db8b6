#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace vitrel::bench {

/// An alternative to Calendar: an indexed 4-ary heap of (time, particle). The four children of a node fill one cache
/// line. A change costs O(log N), the earliest entry O(1), and a particle 20 bytes of memory.
class HeapCalendar {
 public:
  explicit HeapCalendar(std::size_t particles)
      : families_((root + particles) / arity + 2), place_(particles), end_(root + particles) {
    for (std::size_t i = 0; i < particles; ++i)
      put(root + i, {never, static_cast<std::uint32_t>(i)});
  }

  std::size_t size() const { return place_.size(); }
  double time(std::size_t particle) const { return at(place_[particle]).time; }
  std::size_t earliest() const { return at(root).particle; }

  void set(std::size_t particle, double time) {
    const Entry entry{time, static_cast<std::uint32_t>(particle)};
    const std::size_t place = place_[particle];
    put(time < at(place).time ? risen(place, entry) : sunk(place, entry), entry);
  }

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();
  static constexpr std::size_t arity = 4;
  static constexpr std::size_t root = arity - 1;  // makes the first child begin a cache line

  struct Entry {
    double time = never;
    std::uint32_t particle = std::numeric_limits<std::uint32_t>::max();
  };
  struct alignas(64) Family {
    std::array<Entry, arity> entry;
  };

  static bool before(const Entry& one, const Entry& two) {
    return one.time < two.time || (one.time == two.time && one.particle < two.particle);
  }

  static std::size_t parent_of(std::size_t place) { return place / arity + root - 1; }
  static std::size_t first_child_of(std::size_t place) { return (place - root + 1) * arity; }

  const Entry& at(std::size_t place) const { return families_[place / arity].entry[place % arity]; }

  void put(std::size_t place, const Entry& entry) {
    families_[place / arity].entry[place % arity] = entry;
    place_[entry.particle] = static_cast<std::uint32_t>(place);
  }

  // Finds the place where the entry comes to rest, and moves the entries that it passes.
  std::size_t risen(std::size_t place, const Entry& entry) {
    while (place > root && before(entry, at(parent_of(place)))) {
      put(place, at(parent_of(place)));
      place = parent_of(place);
    }
    return place;
  }

  std::size_t sunk(std::size_t place, const Entry& entry) {
    for (std::size_t first = first_child_of(place); first < end_; first = first_child_of(place)) {
      std::size_t best = first;
      for (std::size_t child = first + 1; child < first + arity; ++child)
        if (before(at(child), at(best))) best = child;
      if (!before(at(best), entry)) break;
      put(place, at(best));
      place = best;
    }
    return place;
  }

  std::vector<Family> families_;  // unused entries have later times than any particle
  std::vector<std::uint32_t> place_;
  std::size_t end_;
};

}  // namespace vitrel::bench
