#pragma once

#include <cstddef>

#include "core/geometry/vector.h"
#include "core/state/observer.h"

namespace vitrel {

/// Returns (x_a y_b + x_b y_a)/2, the k-th shear element of two vectors.
template <int Dim>
double shear_element(std::size_t k, const Vec<Dim>& x, const Vec<Dim>& y) {
  const int a = k == 2 ? 1 : 0, b = k == 0 ? 1 : 2;
  return 0.5 * (x[a] * y[b] + x[b] * y[a]);
}

/// The momentum that flows through the system, integrated over time, as Helfand moments (helfand1960)
///
///     G_ab(t) = ∫₀ᵗ Σ m v_a v_b dt' + Σ Δp_a d_b, symmetrised, a ≠ b,
///
/// where the second sum runs over the collisions until t, Δp is the momentum that the particle at the head of d gains,
/// and d runs from centre to centre. Without collisions across the boundaries of the box, ΔG_ab = Δ Σ m (v_a r_b + v_b
/// r_a)/2.
template <int Dim>
class MomentumFlux {
 public:
  /// Starts anew at this time, without particles.
  void begin(double now) {
    kinetic_ = {};
    since_ = now;
  }
  void add_particle(double mass, const Vec<Dim>& velocity) {
    for (std::size_t k = 0; k < shear_elements<Dim>; ++k)
      kinetic_[k] += mass * shear_element<Dim>(k, velocity, velocity);
  }
  void reset_clock(double elapsed) { since_ -= elapsed; }
  /// Adds what has flowed since the last call.
  void advance(double now, ShearElements& moments) {
    const double time = now - since_;
    for (std::size_t k = 0; k < shear_elements<Dim>; ++k) moments[k] += time * kinetic_[k];
    since_ = now;
  }
  /// Adds what has flowed since the last call, and a collision in which the first particle hands `momentum` to the
  /// second over the vector d. `mean_velocity`, the mean of the relative velocity v_1 − v_2 before and after the
  /// collision, determines the change of m v_a v_b of both.
  void transfer(double now, const Vec<Dim>& momentum, const Vec<Dim>& d,
                const Vec<Dim>& mean_velocity, ShearElements& moments) {
    const double time = now - since_;
    for (std::size_t k = 0; k < shear_elements<Dim>; ++k) {
      moments[k] += time * kinetic_[k] + shear_element<Dim>(k, momentum, d);
      kinetic_[k] -= 2 * shear_element<Dim>(k, momentum, mean_velocity);
    }
    since_ = now;
  }

 private:
  ShearElements kinetic_{};  ///< Σ m v_a v_b
  double since_ = 0;
};

}  // namespace vitrel
