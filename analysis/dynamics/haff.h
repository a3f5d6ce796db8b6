#pragma once

#include <optional>
#include <vector>

/// @file
/// The cooling of granular gases.
namespace vitrel {

/// Haff's law T(t) = T(0)/(1 + t/τ)ⁿ for a gas that cools homogeneously. n is 2 if the coefficient of restitution is
/// constant (haff1983), and 5/3 for viscoelastic spheres, for which it approaches 1 as v^(1/5) (schwager1998, for weak
/// dissipation).
struct HaffLaw {
  double exponent;  ///< n
  double initial;   ///< T(0)
  double time;      ///< τ

  double operator()(double t) const;
};

/// Returns the law of this exponent through the first of these temperatures, with the time that fits the first decay:
/// all samples until one is not above T(0)/e. (T(0)/T)^(1/n) − 1 = t/τ is fitted by least squares. Returns nothing if
/// no sample is that cold. t runs from the first time on; the law has the same form from any time on.
std::optional<HaffLaw> fit_haff(const std::vector<double>& times,
                                const std::vector<double>& temperatures, double exponent);

}  // namespace vitrel
