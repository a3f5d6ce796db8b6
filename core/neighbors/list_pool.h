#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/neighbors/prefetch.h"

namespace vitrel {

/// Many short lists, one after the other in one piece of memory. A list that outgrows its slot moves
/// to the end, where it gets twice as much; the slot that it leaves is not used again.
template <class T>
class ListPool {
 public:
  /// Number of lists.
  explicit ListPool(std::size_t lists = 0) : slots_(lists) {}

  /// Empty lists with slot for as many entries as counted and a few more. There is slot for 2³²
  /// entries in all.
  void reserve(std::span<const std::uint32_t> counts) {
    constexpr std::uint32_t more = 2;
    slots_.clear();
    std::uint32_t end = 0;
    for (const std::uint32_t count : counts) {
      const std::uint32_t capacity = count + more;
      slots_.push_back({end, 0, capacity});
      end += capacity;
    }
    entries_.assign(end, {});
  }

  std::span<T> operator[](std::size_t list) {
    return {entries_.data() + slots_[list].begin, slots_[list].count};
  }
  std::span<const T> operator[](std::size_t list) const {
    return {entries_.data() + slots_[list].begin, slots_[list].count};
  }

  void add(std::size_t list, const T& entry) {
    Slot& slot = slots_[list];
    if (slot.count == slot.capacity) move_to_end(slot);
    entries_[slot.begin + slot.count++] = entry;
  }

  /// Asks the memory for where a list is, and, once that is known, for the list.
  void prefetch_slot(std::size_t list) const { prefetch_line(&slots_[list]); }
  void prefetch_list_header(std::size_t list) const {
    constexpr std::size_t line = 64;
    const std::span<const T> entries = (*this)[list];
    const auto* begin = reinterpret_cast<const std::byte*>(entries.data());
    for (std::size_t at = 0; at < entries.size_bytes() + line; at += line)
      prefetch_line(begin + at);
  }

  void clear(std::size_t list) { slots_[list].count = 0; }

  /// Removes the entries for which `unwanted` holds; the others keep their order.
  template <class Predicate>
  void remove_if(std::size_t list, Predicate unwanted) {
    const std::span<T> entries = (*this)[list];
    slots_[list].count -=
        static_cast<std::uint32_t>(std::ranges::remove_if(entries, unwanted).size());
  }

 private:
  struct Slot {
    std::uint32_t begin = 0, count = 0, capacity = 0;
  };

  void move_to_end(Slot& slot) {
    const auto begin = static_cast<std::uint32_t>(entries_.size());
    const std::uint32_t capacity = 2 * slot.capacity + 1;
    entries_.resize(begin + capacity);
    for (std::uint32_t k = 0; k < slot.count; ++k)
      entries_[begin + k] = std::move(entries_[slot.begin + k]);
    slot = {begin, slot.count, capacity};
  }

  std::vector<Slot> slots_;
  std::vector<T> entries_;
};

}  // namespace vitrel
