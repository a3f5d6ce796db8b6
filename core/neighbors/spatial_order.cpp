#include "core/neighbors/spatial_order.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/elementary.h"

namespace vitrel {

namespace {

// Returns the lower bits, of which there are 63/Dim, with Dim − 1 zeros before each.
template <int Dim>
std::uint64_t spread(std::uint64_t bits) {
  std::uint64_t all = 0;
  for (int k = 0; bits >> k != 0; ++k) all |= (bits >> k & 1) << Dim * k;
  return all;
}

}  // namespace

template <int Dim>
std::vector<std::uint32_t> spatial_order(const PeriodicBox<Dim>& box,
                                         std::span<const Vec<Dim>> positions) {
  const double cells = std::ceil(root(static_cast<double>(positions.size()), Dim));
  const auto cell = [&](const Vec<Dim>& position, int k) {
    const double at = (position[k] / box.lengths()[k] + 0.5) * cells;
    return static_cast<std::uint64_t>(std::clamp(at, 0.0, cells - 1));
  };
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
  for (const Vec<Dim>& position : positions) {
    std::uint64_t key = 0;
    for (int k = 0; k < Dim; ++k) key |= spread<Dim>(cell(position, k)) << k;
    keys.emplace_back(key, keys.size());
  }
  std::ranges::sort(keys);
  std::vector<std::uint32_t> order;
  for (const auto& [key, point] : keys) order.push_back(point);
  return order;
}

template std::vector<std::uint32_t> spatial_order(const PeriodicBox<2>&, std::span<const Vec2>);
template std::vector<std::uint32_t> spatial_order(const PeriodicBox<3>&, std::span<const Vec3>);

}  // namespace vitrel
