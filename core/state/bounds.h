#pragma once

#include <limits>
#include <string>

namespace vitrel {

/// The values that a quantity may have, wherever it comes from: a key of a parameter file, or a file of particles.
struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool excludes_low = false, excludes_high = false;
  const char* words = "";  ///< "be …" or "lie …", where the numbers alone do not say it

  /// False of what is not a number.
  bool contains(double value) const {
    return (excludes_low ? value > low : value >= low) &&
           (excludes_high ? value < high : value <= high);
  }
};

/// What a value that the bounds do not contain would have to be: "must be positive".
std::string requirement(const Bounds& bounds, double value);

/// Far beyond what anybody needs in any units, and far within what the squares and products of a double hold.
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
/// In larger boxes the accuracy of contacts, a share of the box, is that of the particles.
inline constexpr Bounds packing_fraction{1e-15};

}  // namespace bounds

}  // namespace vitrel
