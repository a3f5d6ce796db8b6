#pragma once

#include <limits>

namespace vitrel {

/// What is not known in results and tables: NaN.
inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace vitrel
