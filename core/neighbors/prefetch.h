#pragma once

namespace vitrel {

/// Has the line of memory at this address brought into the cache, while the work goes on.
inline void ask_memory(const void* address) {
  // Into the second level: the first would not hold it all until it is needed.
  constexpr int read = 0, second_level = 2;
  __builtin_prefetch(address, read, second_level);
  // Or the compiler sees functions without effect, and leaves them out.
  asm volatile("");
}

}  // namespace vitrel
