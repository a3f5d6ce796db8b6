#include "workflow/configuration/packing_bound.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "workflow/configuration/distributions.h"
#include "workflow/configuration/sections.h"

namespace vitrel {
namespace {

std::vector<Distribution> ratios(const Species& species, int dimension) {
  if (species.aspect_ratios) return {species.aspect_ratios->begin(), species.aspect_ratios->end()};
  return std::vector(static_cast<std::size_t>(dimension) - 1,
                     species.aspect_ratio.value_or(constant(1)));
}

/// a b, or a b c, of all particles of the species; nothing if they differ in it.
std::optional<double> semi_axis_product(const Species& species, int dimension) {
  if (species.semi_axes) return constant_product(*species.semi_axes);
  const auto all = static_cast<std::size_t>(dimension);
  if (!species.first_semi_axis)
    return constant_product(std::vector(all, species.size.value_or(constant(1))));
  const auto of_ratios = constant_product(ratios(species, dimension));
  const auto of_first = constant_product(std::vector(all, *species.first_semi_axis));
  return of_ratios && of_first ? std::optional(*of_first / *of_ratios) : std::nullopt;
}

bool agree_in_semi_axis_product(const std::vector<Species>& species, int dimension) {
  const auto first = semi_axis_product(species.front(), dimension);
  return first && std::ranges::all_of(species, [&](const Species& kind) {
           const auto other = semi_axis_product(kind, dimension);
           return other && allows(constant(*first), *other);
         });
}

}  // namespace

PackingBound packing_bound(const std::vector<Species>& species, int dimension) {
  if (agree_in_semi_axis_product(species, dimension)) {
    if (dimension == 2)
      return {std::numbers::pi / std::sqrt(12.0),
              "π/√12 = 0.9069 where all particles have the same area"};
    if (std::ranges::all_of(species, is_round))
      return {std::numbers::pi / std::sqrt(18.0),
              "π/√18 = 0.7405 where all particles are equal spheres"};
  }
  return {1, "1"};
}

}  // namespace vitrel
