#pragma once

#include <cstddef>
#include <vector>

namespace vitrel {

/// Bessel function J₀(x) for x ≥ 0, absolute error below 1e-10, for loops that need very many
/// values of it.
///
/// Below x = 64: cubic Hermite interpolation between nodes at multiples of h = 1/64, where J₀ and
/// J₀′ = −J₁ are exact; error at most h⁴/384 max|J₀⁗| = 6e-11 (|J₀⁗| ≤ 3/8). Beyond: Hankel's
/// expansion √(2/πx) (P cos(x − π/4) − Q sin(x − π/4)) with the terms up to x⁻⁴ (Abramowitz & Stegun
/// 9.2.5); error below 3e-11.
class BesselJ0 {
 public:
  BesselJ0();

  double operator()(double x) const {
    const double scaled = x * nodes_per_unit;
    if (!(scaled < nodes)) return far(x);
    const auto k = static_cast<std::size_t>(scaled);
    const double u = scaled - static_cast<double>(k), v = 1 - u;
    const Node &left = table_[k], &right = table_[k + 1];
    return v * v * ((1 + 2 * u) * left.value + u * left.slope) +
           u * u * ((1 + 2 * v) * right.value - v * right.slope);
  }

 private:
  static constexpr double nodes_per_unit = 64;
  static constexpr double nodes = 64 * nodes_per_unit;

  struct Node {
    double value, slope;  ///< the slope per node distance
  };
  static double far(double x);

  std::vector<Node> table_;
};

}  // namespace vitrel
