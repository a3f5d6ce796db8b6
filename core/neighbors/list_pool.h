#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "core/large_vector.h"
#include "core/neighbors/prefetch.h"

namespace vitrel {

/// Many short lists in one array. A list that exceeds its capacity moves to the end and gets twice the capacity; its
/// old memory is not reused.
template <class T>
class ListPool {
 public:
  /// Makes so many empty lists.
  explicit ListPool(std::size_t lists = 0) : headers_(lists) {}

  /// Empties all lists and gives each the capacity for its count and a few more entries. There may be at most 2³²
  /// entries in total.
  void reserve(std::span<const std::uint32_t> counts) {
    constexpr std::uint32_t more = 2;
    headers_.clear();
    std::uint32_t end = 0;
    for (const std::uint32_t count : counts) {
      const std::uint32_t capacity = count + more;
      headers_.push_back({end, 0, capacity});
      end += capacity;
    }
    entries_.assign(end, {});
  }

  std::span<T> operator[](std::size_t list) {
    return {entries_.data() + headers_[list].begin, headers_[list].count};
  }
  std::span<const T> operator[](std::size_t list) const {
    return {entries_.data() + headers_[list].begin, headers_[list].count};
  }

  void add(std::size_t list, const T& entry) {
    Header& header = headers_[list];
    if (header.count == header.capacity) move_to_end(header);
    entries_[header.begin + header.count++] = entry;
  }

  /// prefetch_header prefetches the header of a list; prefetch_list_header, called later, prefetches its entries.
  void prefetch_header(std::size_t list) const { prefetch_line(&headers_[list]); }
  void prefetch_list_header(std::size_t list) const {
    constexpr std::size_t line = 64;
    const std::span<const T> entries = (*this)[list];
    const auto* begin = reinterpret_cast<const std::byte*>(entries.data());
    for (std::size_t at = 0; at < entries.size_bytes() + line; at += line)
      prefetch_line(begin + at);
  }

  void clear(std::size_t list) { headers_[list].count = 0; }
  /// Keeps the first `count` entries.
  void truncate(std::size_t list, std::uint32_t count) { headers_[list].count = count; }

  /// Removes the entries for which `unwanted` holds; the others keep their order.
  template <class Predicate>
  void remove_if(std::size_t list, Predicate unwanted) {
    const std::span<T> entries = (*this)[list];
    // std::remove_if unrolls its search, which costs more than it saves: most lists are short.
    auto end = std::ranges::find_if(entries, unwanted);
    if (end == entries.end()) return;
    for (auto next = end + 1; next != entries.end(); ++next)
      if (!unwanted(*next)) *end++ = *next;
    headers_[list].count = static_cast<std::uint32_t>(end - entries.begin());
  }

 private:
  struct Header {
    std::uint32_t begin = 0, count = 0, capacity = 0;
  };

  void move_to_end(Header& header) {
    const auto begin = static_cast<std::uint32_t>(entries_.size());
    const std::uint32_t capacity = 2 * header.capacity + 1;
    entries_.resize(begin + capacity);
    for (std::uint32_t k = 0; k < header.count; ++k)
      entries_[begin + k] = std::move(entries_[header.begin + k]);
    header = {begin, header.count, capacity};
  }

  LargeVector<Header> headers_;
  LargeVector<T> entries_;
};

}  // namespace vitrel
