#pragma once

namespace vitrel {

/// Has the line of memory at this address brought into the cache, while the work goes on.
inline void ask_memory(const void* address) {
  __builtin_prefetch(address);
  // Or the compiler sees functions without effect, and leaves them out.
  asm volatile("");
}

}  // namespace vitrel
