#include "core/io/base64.h"

#include <algorithm>
#include <cstdint>

namespace vitrel {

std::string base64(std::span<const std::byte> bytes) {
  constexpr const char* letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t first = 0; first < bytes.size(); first += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - first);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (k < count ? std::to_integer<std::uint32_t>(bytes[first + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? letters[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

}  // namespace vitrel
