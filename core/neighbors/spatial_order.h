#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/periodic_box.h"

namespace vitrel {

/// Orders points along a Morton curve through a grid with about one point per cell: entry k is the k-th point.
/// Positions must be wrapped into the box. Points stored in this order have their neighbours near in memory, which
/// speeds up large systems.
template <int Dim>
std::vector<std::uint32_t> spatial_order(const PeriodicBox<Dim>& box,
                                         std::span<const Vec<Dim>> positions);

}  // namespace vitrel
