#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "bench/baselines/soft_pairs.h"

namespace vitrel::bench {

/// Soft spheres or disks by conventional dynamics, as the baseline of the event-driven run: Newton's equations with
/// the force itself, in time steps of the velocity Verlet method,
///     v* = v + a h/2,  r' = r + v* h,  a' = F(r', v* + a h/2)/m,  v' = v* + a' h/2.
/// A pair repels as long as it is closer than contact and its force is not negative. Errors are ∝ h², and ∝ h near
/// the ends of contacts with damping. Cells find the neighbours, again whenever a particle has moved by half of the
/// skin. The skin is as thick as lets one additional neighbour of a particle in; in a thin gas it is so wide that the
/// search costs nothing.
template <int Dim, ContactForce Force>
class ForceBasedRun {
 public:
  ForceBasedRun(const Configuration<Dim>& start, const Force& force)
      : c_(start),
        force_(force),
        skin_(skin(start)),
        acceleration_(start.size(), Vec<Dim>::Zero()),
        before_(acceleration_) {
    find_neighbors();
    accelerate();
  }

  /// Advances by `duration` in this number of steps.
  void advance(double duration, std::uint64_t steps) {
    const double h = duration / static_cast<double>(steps);
    for (std::uint64_t step = 0; step < steps; ++step) {
      bool somebody_left = false;
      for (std::size_t i = 0; i < c_.size(); ++i) {
        const Vec<Dim> kick = 0.5 * h * acceleration_[i];
        c_.velocity[i] += kick;
        c_.position[i] += h * c_.velocity[i];
        c_.velocity[i] += kick;
        somebody_left |= (c_.position[i] - there_[i]).squaredNorm() > 0.25 * skin_ * skin_;
      }
      if (somebody_left) find_neighbors();
      acceleration_.swap(before_);
      accelerate();
      for (std::size_t i = 0; i < c_.size(); ++i)
        c_.velocity[i] += 0.5 * h * (acceleration_[i] - before_[i]);
    }
    c_.time += duration;
  }

  /// Positions are not wrapped.
  const Configuration<Dim>& state() const { return c_; }

 private:
  // A shell of this thickness around a sphere of two radii has the volume of the box per particle.
  static double skin(const Configuration<Dim>& c) {
    const double radius = largest_circumradius(c);
    return radius * (std::pow(std::pow(2, Dim) + 1 / packing_fraction(c), 1.0 / Dim) - 2);
  }

  void find_neighbors() {
    pairs_ = find_soft_pairs(c_, skin_);
    there_ = c_.position;
  }

  void accelerate() {
    std::ranges::fill(acceleration_, Vec<Dim>::Zero());
    for (const SoftPair<Dim>& pair : pairs_) {
      const Vec<Dim> force =
          pair.force(force_, c_.position[pair.j] + pair.translation - c_.position[pair.i],
                     c_.velocity[pair.j] - c_.velocity[pair.i]);
      acceleration_[pair.i] -= force / c_.mass[pair.i];
      acceleration_[pair.j] += force / c_.mass[pair.j];
    }
  }

  Configuration<Dim> c_;
  Force force_;
  double skin_;
  std::vector<Vec<Dim>> acceleration_, before_, there_;
  std::vector<SoftPair<Dim>> pairs_;
};

}  // namespace vitrel::bench
