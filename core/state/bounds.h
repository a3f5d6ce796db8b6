#pragma once

#include <limits>
#include <string>

namespace vitrel {

/// The values that a quantity may have, wherever it comes from: a key of a parameter file, or a file of particles.
struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool excludes_low = false, excludes_high = false;
  const char* words = "";  ///< the rule as "be …" or "lie …", if the numbers alone do not say it

  /// Returns false for NaN.
  bool contains(double value) const {
    return (excludes_low ? value > low : value >= low) &&
           (excludes_high ? value < high : value <= high);
  }
};

/// Returns the requirement that a value outside the bounds violates, for example "must be positive".
std::string requirement(const Bounds& bounds, double value);

/// These limits lie far beyond what anybody needs in any units, yet squares and products of such values stay far within
/// the range of double.
namespace bounds {

inline constexpr Bounds length{1e-20, 1e20};
inline constexpr Bounds mass{1e-40, 1e40};
inline constexpr Bounds positive{1e-20, 1e20};  ///< speeds, pressures, moduli …
inline constexpr Bounds not_negative{0, 1e20};
inline constexpr Bounds any{-1e20, 1e20};
inline constexpr Bounds time = positive, time_or_none = not_negative;
inline constexpr Bounds at_least_one{1};
inline constexpr Bounds share{0, 1};
inline constexpr Bounds share_above_none{0, 1, true};
/// The accuracy of contacts is proportional to the box lengths: at this packing fraction, it is 2e-4 of the radius for a
/// million disks. Lower ones would be worse.
inline constexpr Bounds packing_fraction{1e-15};

}  // namespace bounds

}  // namespace vitrel
