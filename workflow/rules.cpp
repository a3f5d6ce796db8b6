#include "workflow/rules.h"

#include <fmt/format.h>

#include <cmath>

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

void Rules::packing_fraction(double value, const std::string& key,
                             const PackingBound& bound) const {
  require(
      value > 0 && value < bound.value, key,
      fmt::format("is {}, but a packing fraction lies between 0 and {}", show(value), bound.text));
}

}  // namespace vitrel
