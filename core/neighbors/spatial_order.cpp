#include "core/neighbors/spatial_order.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

namespace vitrel {

namespace {

// The lower 32 bits, with a 0 before each.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 16) & 0x0000ffff0000ffff;
  bits = (bits | bits << 8) & 0x00ff00ff00ff00ff;
  bits = (bits | bits << 4) & 0x0f0f0f0f0f0f0f0f;
  bits = (bits | bits << 2) & 0x3333333333333333;
  return (bits | bits << 1) & 0x5555555555555555;
}

}  // namespace

std::vector<std::uint32_t> spatial_order(const PeriodicBox<2>& box,
                                         std::span<const Vec2> positions) {
  const double cells = std::ceil(std::sqrt(static_cast<double>(positions.size())));
  const auto cell = [&](const Vec2& position, int k) {
    const double at = (position[k] / box.lengths()[k] + 0.5) * cells;
    return static_cast<std::uint64_t>(std::clamp(at, 0.0, cells - 1));
  };
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
  for (const Vec2& position : positions)
    keys.emplace_back(spread(cell(position, 0)) | spread(cell(position, 1)) << 1, keys.size());
  std::ranges::sort(keys);
  std::vector<std::uint32_t> order;
  for (const auto& [key, point] : keys) order.push_back(point);
  return order;
}

}  // namespace vitrel
