#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace vitrel {

/// Many short lists, one after the other in one piece of memory. A list that outgrows its room moves
/// to the end, where it gets twice as much; the room that it leaves is not used again.
template <class T>
class ListPool {
 public:
  /// Number of lists.
  explicit ListPool(std::size_t lists = 0) : rooms_(lists) {}

  /// Empty lists with room for as many entries as counted and a few more.
  void reserve(std::span<const std::uint32_t> counts) {
    constexpr std::uint32_t more = 3;
    rooms_.clear();
    std::size_t end = 0;
    for (const std::uint32_t count : counts) {
      rooms_.push_back({end, 0, count + more});
      end += count + more;
    }
    entries_.assign(end, {});
  }

  std::span<T> operator[](std::size_t list) {
    return {entries_.data() + rooms_[list].begin, rooms_[list].count};
  }
  std::span<const T> operator[](std::size_t list) const {
    return {entries_.data() + rooms_[list].begin, rooms_[list].count};
  }

  void add(std::size_t list, const T& entry) {
    Room& room = rooms_[list];
    if (room.count == room.capacity) move_to_end(room);
    entries_[room.begin + room.count++] = entry;
  }

  /// `entries` must lie elsewhere.
  void assign(std::size_t list, std::span<const T> entries) {
    rooms_[list].count = 0;
    for (const T& entry : entries) add(list, entry);
  }

  /// Removes the entries for which `unwanted` holds; the others keep their order.
  template <class Predicate>
  void remove_if(std::size_t list, Predicate unwanted) {
    const std::span<T> entries = (*this)[list];
    rooms_[list].count -=
        static_cast<std::uint32_t>(std::ranges::remove_if(entries, unwanted).size());
  }

 private:
  struct Room {
    std::size_t begin = 0;
    std::uint32_t count = 0, capacity = 0;
  };

  void move_to_end(Room& room) {
    const std::size_t begin = entries_.size();
    const std::uint32_t capacity = 2 * room.capacity + 1;
    entries_.resize(begin + capacity);
    for (std::uint32_t k = 0; k < room.count; ++k)
      entries_[begin + k] = std::move(entries_[room.begin + k]);
    room = {begin, room.count, capacity};
  }

  std::vector<Room> rooms_;
  std::vector<T> entries_;
};

}  // namespace vitrel
