#pragma once

#include <limits>

namespace vitrel {

/// The value of unknown quantities in results and tables.
inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace vitrel
