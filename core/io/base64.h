#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace vitrel {

/// Returns the bytes in the alphabet A–Z a–z 0–9 + /, four characters for three bytes, filled up with "=".
///
/// Source: RFC 4648, section 4.
std::string base64(std::span<const std::byte> bytes);

}  // namespace vitrel
