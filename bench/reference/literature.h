#pragma once

#include <stdexcept>

/// @file
/// Values of the literature for the studies and the tests; each value stands here once.
/// scripts/validation/literature.py reads the table as well, and has the values that only validations need.
namespace vitrel {

/// Z = βP/ρ of an infinite fluid of equal hard ellipses. An error of 0 is negligible or not stated.
struct FluidPressure {
  double aspect_ratio, packing_fraction, z, error;
};

/// Disks: Kolafa & Rottner, Mol. Phys. 104, 3435 (2006). Ellipses: Monte Carlo at constant volume with N ≈ 400; allow
/// 0.1 % for this finite size.
inline constexpr FluidPressure fluid_pressures[] = {
    {1, 0.3, 2.063261, 0},  {1, 0.5, 4.106364, 0}, {1, 0.6, 6.455337, 0},
    {1, 0.65, 8.408044, 0}, {2, 0.2, 1.6332, 0},   {2, 0.3, 2.1878, 0},
    {2, 0.5, 4.492, 0.003}, {4, 0.2, 1.8666, 0},   {4, 0.3, 2.6229, 0.0019},
    {4, 0.4, 3.757, 0},     {6, 0.2, 2.1272, 0},   {6, 0.3, 3.0335, 0.0020},
};

/// The entry for these values. Throws std::out_of_range if there is none.
constexpr FluidPressure fluid_pressure(double aspect_ratio, double packing_fraction) {
  for (const FluidPressure& entry : fluid_pressures)
    if (entry.aspect_ratio == aspect_ratio && entry.packing_fraction == packing_fraction)
      return entry;
  throw std::out_of_range("no such fluid in the table");
}

}  // namespace vitrel
