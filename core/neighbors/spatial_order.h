#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/periodic_box.h"

namespace vitrel {

/// Numbers points so that near ones have near numbers (along Morton's curve through a grid with
/// about one point in a cell): entry k is the point that comes k-th. Positions wrapped into the box.
/// What is stored in this order is near in memory too, which a large system needs.
template <int Dim>
std::vector<std::uint32_t> spatial_order(const PeriodicBox<Dim>& box,
                                         std::span<const Vec<Dim>> positions);

}  // namespace vitrel
