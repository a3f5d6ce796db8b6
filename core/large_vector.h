#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

namespace vitrel {

/// Allocates large arrays in huge pages where the system offers them on request. Otherwise, random access to tens of
/// megabytes is slowed down by the translation of addresses.
template <class T>
class HugePageAllocator {
 public:
  using value_type = T;  // NOLINT(readability-identifier-naming): the library requires this name

  HugePageAllocator() = default;
  template <class U>
  // NOLINTNEXTLINE(google-explicit-constructor): the library requires conversion between element types
  HugePageAllocator(const HugePageAllocator<U>&) {}

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes < smallest) return std::allocator<T>().allocate(count);
    const std::size_t whole_pages = (bytes + page - 1) / page * page;
    void* const memory = std::aligned_alloc(page, whole_pages);
    if (!memory) throw std::bad_alloc();
    static_cast<void>(::madvise(memory, whole_pages, MADV_HUGEPAGE));  // the system may refuse
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) {
    if (count * sizeof(T) < smallest)
      std::allocator<T>().deallocate(memory, count);
    else
      std::free(memory);
  }

  friend bool operator==(const HugePageAllocator&, const HugePageAllocator&) { return true; }

 private:
  static constexpr std::size_t page = std::size_t{1} << 21;
  static constexpr std::size_t smallest = 2 * page;  ///< below this, rounding up would waste memory
};

/// A vector for data that the engine and the exact check hold for every particle.
template <class T>
using LargeVector = std::vector<T, HugePageAllocator<T>>;

}  // namespace vitrel
