#pragma once

#include <array>
#include <optional>
#include <vector>

#include "analysis/dynamics/bessel_j0.h"
#include "analysis/dynamics/correlation.h"
#include "analysis/dynamics/displacement_options.h"
#include "analysis/dynamics/path.h"
#include "analysis/dynamics/time_axis.h"

/// @file
/// The inner part of displacement.h: what every particle adds at one lag.
namespace vitrel {

template <int Dim>
struct TrackQuantities {
  std::vector<double> wave_numbers, orders;
  std::size_t axes;  ///< whose directions are correlated
  double overlap_distance;
  MotionParts parts;
  DirectionAverage<Dim> direction_average = {};
};

/// Sums over particles that are told apart by their class (LikeParticles) for the errors only.
template <int Dim>
class LagSums {
 public:
  /// `rotors`: whether there may be any among the particles. `lag` and `quantities` must outlive the
  /// sums.
  LagSums(const Lag& lag, const TrackQuantities<Dim>& quantities, bool rotors, std::size_t classes);
  void add(const Path<Dim>& path, std::size_t its_class);
  void add(const LagSums& other);

  struct Rotation {
    CorrelationSum parallel, perpendicular;
    MomentSum turn;
    std::vector<CorrelationSum> orientation;  ///< all orders of the first axis, of the second …
  };
  const MotionParts& parts() const { return quantities_->parts; }
  const MomentSum& translation() const { return translation_; }
  const CorrelationSum& overlap() const { return overlap_; }
  const std::vector<CorrelationSum>& scattering() const { return scattering_; }
  const Rotation& rotation() const { return *rotation_; }

  /// ⟨s²⟩ = ⟨s⟩²/c of normally distributed displacements and rotations; s are their squares.
  static constexpr double normal_translation = Dim / (Dim + 2.0);
  static constexpr double normal_rotation = Path<Dim>::rotations / (Path<Dim>::rotations + 2.0);

 private:
  /// Origins worked on at a time: all that belongs to them stays in the first cache.
  static constexpr std::size_t chunk = 256;
  using Chunk = std::array<double, chunk>;
  class Part;
  void add_displacement(const Part& part, const Chunk& squares);
  void add_overlap(const Part& part, const Chunk& squares);
  void add_scattering(const Part& part, const Chunk& squares);
  void add_rotation(const Part& part, const Chunk& squares);
  void add_orientation(const Part& part);
  void finish_particle(bool rotor, std::size_t its_class);

  const Lag* lag_;
  const TrackQuantities<Dim>* quantities_;
  MomentSum translation_;
  CorrelationSum overlap_;
  std::vector<CorrelationSum> scattering_;
  std::optional<Rotation> rotation_;
};

}  // namespace vitrel
