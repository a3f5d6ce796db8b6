#pragma once

#include <cassert>
#include <cmath>

#include "core/geometry/vector.h"

namespace vitrel {

/// A rectangular periodic box centred at the origin: coordinates run over [−L/2, L/2).
///
/// A pair of particles is (i, j, shift): particle j is seen at r_j + shift ∘ L. In a box shorter than two particle
/// lengths one pair meets through several images, and a particle meets its own images. `for_each_image` is therefore
/// the general case, and the nearest image only a fast path.
template <int Dim>
class PeriodicBox {
 public:
  PeriodicBox() : lengths_(Vec<Dim>::Ones()) {}
  /// `lengths` must be finite and positive.
  explicit PeriodicBox(const Vec<Dim>& lengths) : lengths_(lengths) {
    assert(lengths.allFinite() && lengths.minCoeff() > 0);
  }

  const Vec<Dim>& lengths() const { return lengths_; }
  /// The area in two dimensions.
  double volume() const { return prod(lengths_); }

  Vec<Dim> translation(const Shift<Dim>& shift) const {
    return shift.template cast<double>().cwiseProduct(lengths_);
  }

  /// Brings `position` into the box and adds the number of box lengths removed to `image`, so that position + image ∘ L
  /// (the unwrapped position) stays the same.
  void wrap(Vec<Dim>& position, Shift<Dim>& image) const {
    for (int k = 0; k < Dim; ++k) {
      const double boxes = std::floor(position[k] / lengths_[k] + 0.5);
      position[k] -= boxes * lengths_[k];
      image[k] += static_cast<std::int32_t>(boxes);
      // Rounding can leave a coordinate just below −L/2 at exactly +L/2.
      if (position[k] >= 0.5 * lengths_[k]) {
        position[k] -= lengths_[k];
        ++image[k];
      }
    }
  }

  /// Wraps the position only if it is outside: a position inside the box stays bit-identical.
  void wrap_if_outside(Vec<Dim>& position, Shift<Dim>& image) const {
    const Vec<Dim> half = 0.5 * lengths_;
    const bool inside =
        (position.array() >= -half.array()).all() && (position.array() < half.array()).all();
    if (!inside) wrap(position, image);
  }

  /// Returns the shift that makes |d + shift ∘ L| smallest, for any separation d.
  Shift<Dim> nearest_shift(const Vec<Dim>& d) const {
    Shift<Dim> shift;
    for (int k = 0; k < Dim; ++k)
      shift[k] = -static_cast<std::int32_t>(std::lround(d[k] / lengths_[k]));
    return shift;
  }

  /// Calls visit(shift, d + shift ∘ L) for every image with |d + shift ∘ L| ≤ reach, in ascending
  /// order of the shift (last direction fastest).
  template <class Visit>
  void for_each_image(const Vec<Dim>& d, double reach, Visit&& visit) const {
    Shift<Dim> low, high;
    for (int k = 0; k < Dim; ++k) {
      low[k] = static_cast<std::int32_t>(std::ceil((-reach - d[k]) / lengths_[k]));
      high[k] = static_cast<std::int32_t>(std::floor((reach - d[k]) / lengths_[k]));
      if (low[k] > high[k]) return;
    }
    Shift<Dim> shift = low;
    while (true) {
      const Vec<Dim> separation = d + translation(shift);
      if (squared_norm(separation) <= reach * reach) visit(shift, separation);
      int k = Dim - 1;
      while (k >= 0 && shift[k] == high[k]) shift[k] = low[k], --k;
      if (k < 0) return;
      ++shift[k];
    }
  }

 private:
  Vec<Dim> lengths_;
};

/// Returns true for exactly one of two opposite shifts, so that own images are counted once.
template <int Dim>
bool is_positive_shift(const Shift<Dim>& shift) {
  for (int k = 0; k < Dim; ++k)
    if (shift[k] != 0) return shift[k] > 0;
  return false;
}

}  // namespace vitrel
