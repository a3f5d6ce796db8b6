#pragma once

/// Closed forms that several tests compare with.
namespace vitrel {

/// Z − 1 of hard disks to the fifth virial coefficient, over B₂ρ = 2 φ: the contact value g(σ) (Clisby &
/// McCoy, J. Stat. Phys. 122, 15 (2006)).
inline double disk_contact_value(double packing_fraction) {
  const double x = 2 * packing_fraction;
  return 1 + x * (0.782004437912 + x * (0.532231807025 + x * 0.33355604));
}

}  // namespace vitrel
