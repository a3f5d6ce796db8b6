#include "workflow/configuration/rules.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/io/parameters.h"

namespace vitrel {

std::string show(double value) {
  return to_toml(value);
}

void Rules::require(bool holds, const std::string& key, const std::string& complaint) const {
  if (!holds) throw BadValue(path_.empty() ? key : path_ + "." + key, complaint);
}

void Rules::positive(double value, const std::string& key) const {
  require(value > 0 && std::isfinite(value), key,
          fmt::format("is {}, but must be positive", show(value)));
}

void Rules::not_negative(double value, const std::string& key) const {
  require(value >= 0 && std::isfinite(value), key,
          fmt::format("is {}, but must be 0 or more", show(value)));
}

void Rules::at_least(std::int64_t value, std::int64_t least, const std::string& key) const {
  require(value >= least, key, fmt::format("is {}, but must be at least {}", value, least));
}

void Rules::packing_fraction(double value, const std::string& key, int dimension) const {
  // Ellipses of one kind pack no denser than disks: π/√12. Of ellipsoids no such bound is known.
  const double densest = dimension == 2 ? std::numbers::pi / std::sqrt(12.0) : 1;
  require(value > 0 && value < densest, key,
          fmt::format("is {}, but a packing fraction lies between 0 and {}", show(value),
                      dimension == 2 ? "π/√12 = 0.9069" : "1"));
}

}  // namespace vitrel
