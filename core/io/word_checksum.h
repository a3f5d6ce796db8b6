#pragma once

#include <cstdint>

namespace vitrel {

/// The checksum FNV-1a, computed over 64-bit words instead of bytes.
class WordChecksum {
 public:
  void add(std::uint64_t word) { hash_ = (hash_ ^ word) * 0x100000001b3u; }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace vitrel
