#include "core/state/bounds.h"

#include <fmt/format.h>

#include <cmath>

namespace vitrel {

std::string requirement(const Bounds& bounds, double value) {
  if (*bounds.words) return fmt::format("must {}", bounds.words);
  if (std::isinf(bounds.low) && std::isinf(bounds.high)) return "must be a number";
  if (bounds.low > 0 && value <= 0) return "must be positive";
  if (bounds.low == 0 && bounds.high >= bounds::not_negative.high && value < 0)
    return "must be 0 or more";
  if (std::isinf(bounds.high)) return fmt::format("must be at least {:.10g}", bounds.low);
  const char* joined = bounds.excludes_high  ? "and below"
                       : bounds.excludes_low ? "and not above"
                                             : "and";
  return fmt::format("must lie {} {:.10g} {} {:.10g}", bounds.excludes_low ? "above" : "between",
                     bounds.low, joined, bounds.high);
}

}  // namespace vitrel
