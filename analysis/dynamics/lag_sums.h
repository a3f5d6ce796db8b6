#pragma once

#include <optional>
#include <vector>

#include "analysis/dynamics/bessel_j0.h"
#include "analysis/dynamics/correlation.h"
#include "analysis/dynamics/time_axis.h"
#include "analysis/dynamics/tracks.h"

/// @file
/// The inner part of displacement.h: what every particle adds at one lag.
namespace vitrel {

struct TrackQuantities {
  std::vector<double> wave_numbers, orders;
  double overlap_distance;
  BesselJ0 bessel;
};

/// cos nθ and sin nθ along a track; their products give cos nΔθ.
struct Phase {
  Phase(const std::vector<double>& angle, double n);
  std::vector<double> cosine, sine;
};

/// A track and, of a rotor, its phases: the direction of the long axis (n = 1), and one per order.
struct Path {
  Path(const Track& its_track, bool is_rotor, const std::vector<double>& orders);
  const Track* track;
  std::optional<Phase> axis;
  std::vector<Phase> phases;
};

/// Sums over particles that are not told apart.
class LagSums {
 public:
  /// `rotors`: whether there may be any among the particles. `lag` and `quantities` must outlive the
  /// sums.
  LagSums(const Lag& lag, const TrackQuantities& quantities, bool rotors);
  void add(const Path& path);
  void add(const LagSums& other);

  struct Rotation {
    CorrelationSum parallel, perpendicular;
    MomentSum turn;
    std::vector<CorrelationSum> orientation;
  };
  const MomentSum& translation() const { return translation_; }
  const CorrelationSum& overlap() const { return overlap_; }
  const std::vector<CorrelationSum>& scattering() const { return scattering_; }
  const Rotation& rotation() const { return *rotation_; }

 private:
  class Part;
  void add_translation(const Track& track, const Part& part);
  void add_rotation(const Path& path, const Part& part);
  void finish_particle(bool rotor);

  const Lag* lag_;
  const TrackQuantities* quantities_;
  MomentSum translation_;
  CorrelationSum overlap_;
  std::vector<CorrelationSum> scattering_;
  std::optional<Rotation> rotation_;
};

}  // namespace vitrel
