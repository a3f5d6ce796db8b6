#pragma once

#include <cstdint>
#include <limits>

namespace vitrel {

/// The end of a free path.
struct FreePath {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  double length;
  std::uint32_t partner;     ///< id of the particle hit, or none
  double offset_at_contact;  ///< along the path, from the moving centre to the partner's centre
};

}  // namespace vitrel
