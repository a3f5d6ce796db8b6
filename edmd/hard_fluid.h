#pragma once

#include "core/state/configuration.h"

/// @file
/// Theoretical estimates for a fluid of hard particles, from which the cost of a simulation is predicted.
///
/// Z is that of scaled-particle theory for convex bodies (gibbons1969), which in the plane is 1/(1 − φ) + P²/(4πA)
/// φ/(1 − φ)² (boublik1975). The virial theorem relates the collision rate to Z: (Z − 1) D N kT = ν ⟨J⟩ ⟨n·r⟩. Here
/// ⟨J⟩ = √(2π μ kT) is the mean impulse at the effective mass 1/μ = Σ (1/m + ℓ²/I), ℓ the lever of the contact point,
/// and ⟨n·r⟩ twice the mean support function ⟨h⟩. Averages are over uniform normals n and over the particles.
///
/// The estimates are good to a factor of two for elastic fluids below freezing.
namespace vitrel {

class HardFluid {
 public:
  /// `some` holds all particles, or some that represent them.
  template <int Dim>
  explicit HardFluid(const Configuration<Dim>& some);

  /// Returns Z = βP/ρ at the packing fraction φ.
  double compressibility_factor(double phi) const;
  /// Returns the number of collisions per particle and unit of time at kT = 1; each particle takes part in twice as
  /// many.
  double collision_rate(double phi) const;

  int dimension() const { return dimension_; }
  bool is_round() const { return is_round_; }

  /// Measured numbers of events per collision lie between 1.2 and 3.3.
  static constexpr double events_per_collision = 1.7;

 private:
  /// Averages over the directions of the normal and over the particles.
  struct Averages {
    double support = 0;          ///< h, the mean radius of curvature
    double boundary = 0;         ///< perimeter or surface
    double size = 0;             ///< area or volume
    double inverse_mass = 0;     ///< 1/m + ℓ²/I
    double squared_support = 0;  ///< ⟨h⟩²

    void add(const Averages& other, double weight);
  };
  template <int Dim>
  static Averages averages_of(const Configuration<Dim>& some, std::size_t i);

  int dimension_;
  bool is_round_;
  Averages mean_;
};

}  // namespace vitrel
