#pragma once

namespace vitrel {

/// How many boxes away from the box a position in a file may be, and how often a particle may have crossed the box:
/// both together are whole numbers of 32 bits.
inline constexpr double max_box_crossings = 1e9;

}  // namespace vitrel
