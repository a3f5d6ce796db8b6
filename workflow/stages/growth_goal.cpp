#include "workflow/stages/growth_goal.h"

#include <fmt/format.h>

namespace vitrel {

std::string growth_description(const char* method, const std::optional<double>& reduced_pressure) {
  if (!reduced_pressure) return {};
  return fmt::format("{} to reduced pressure {:.4g}", method, *reduced_pressure);
}

}  // namespace vitrel
