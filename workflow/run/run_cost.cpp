#include "workflow/run/run_cost.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/state/species.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double events_per_collision = 1.7;

/// Averages over the directions of the normal, of one body.
struct Averages {
  double support = 0;          ///< h, the mean radius of curvature
  double boundary = 0;         ///< perimeter or surface
  double size = 0;             ///< area or volume
  double inverse_mass = 0;     ///< 1/m + ℓ²/I
  double squared_support = 0;  ///< ⟨h⟩²

  void add(const Averages& other, double weight) {
    support += weight * other.support;
    boundary += weight * other.boundary;
    size += weight * other.size;
    inverse_mass += weight * other.inverse_mass;
    squared_support += weight * other.squared_support;
  }
};

/// Evenly spread over a half circle or sphere, in the axes of the body.
template <int Dim>
std::vector<Vec<Dim>> directions() {
  constexpr int count = Dim == 2 ? 64 : 256;
  constexpr double golden_angle = 2.399963229728653;
  std::vector<Vec<Dim>> result;
  for (int k = 0; k < count; ++k) {
    const double place = (k + 0.5) / count;
    if constexpr (Dim == 2) {
      result.push_back(direction(pi * place));
    } else {
      const Vec2 across = std::sqrt(1 - place * place) * direction(golden_angle * k);
      result.emplace_back(across.x(), across.y(), place);
    }
  }
  return result;
}

Vec2 axes_of(const Ellipse& shape) {
  return {shape.a, shape.b};
}
const Vec3& axes_of(const Ellipsoid& shape) {
  return shape.semi_axes;
}

/// ℓ²/I of the contact at the point with normal n.
double lever_term(const Configuration2& c, std::size_t i, const Vec2& point, const Vec2& n) {
  const double lever = point.x() * n.y() - point.y() * n.x();
  return c.shape[i].is_round() ? 0 : lever * lever / c.inertia(i);
}
double lever_term(const Configuration3& c, std::size_t i, const Vec3& point, const Vec3& n) {
  return sum(point.cross(n).cwiseAbs2().cwiseQuotient(c.inertia(i)));
}

/// The projected area of an ellipsoid along n is π times this; the mean over all n is a quarter of the surface.
double boundary_term(const Vec2& axes, const Vec2& n) {
  return 2 * pi * norm(axes.cwiseProduct(n));
}
double boundary_term(const Vec3& axes, const Vec3& n) {
  return 4 * pi * norm(prod(axes) * n.cwiseQuotient(axes));
}

template <int Dim>
Averages averages_of(const Configuration<Dim>& c, std::size_t i) {
  static const std::vector<Vec<Dim>> normals = directions<Dim>();
  const Vec<Dim> axes = axes_of(c.shape[i]);
  const double weight = 1.0 / static_cast<double>(normals.size());
  Averages one;
  for (const Vec<Dim>& n : normals) {
    const double h = norm(axes.cwiseProduct(n));
    const Vec<Dim> point = axes.cwiseAbs2().cwiseProduct(n) / h;
    one.support += weight * h;
    one.boundary += weight * boundary_term(axes, n);
    one.inverse_mass += weight * (1 / c.mass[i] + lever_term(c, i, point, n));
  }
  one.size = Dim == 2 ? pi * prod(axes) : 4 * pi / 3 * prod(axes);
  one.squared_support = one.support * one.support;
  return one;
}

/// Z of scaled-particle theory.
template <int Dim>
double compressibility_factor(const Averages& mean, double phi) {
  const double free = 1 - phi;
  if (Dim == 2)
    return 1 / free + mean.boundary * mean.boundary / (4 * pi * mean.size) * phi / (free * free);
  const double ratio = mean.boundary / mean.size;
  return 1 / free + mean.support * ratio * phi / (free * free) +
         mean.squared_support * ratio * ratio / 3 * phi * phi / (free * free * free);
}

template <int Dim>
double collisions_per_particle_and_time(const Configuration<Dim>& some, double phi) {
  Averages mean;
  for (std::size_t i = 0; i < some.size(); ++i)
    mean.add(averages_of(some, i), 1.0 / static_cast<double>(some.size()));
  const double impulse = std::sqrt(2 * pi / (2 * mean.inverse_mass));
  return (compressibility_factor<Dim>(mean, phi) - 1) * Dim / (impulse * 2 * mean.support);
}

/// Measured with `vitrel-bench engine`.
double seconds_per_event(int dimension, bool is_round) {
  if (is_round) return dimension == 2 ? 0.3e-6 : 0.5e-6;
  return dimension == 2 ? 1e-6 : 3e-6;
}

/// Measured: the process without particles, and what each adds.
double memory(int dimension, bool is_round, double particles) {
  constexpr double program = 20e6;
  const double each = dimension == 2 ? 900 : is_round ? 1300 : 2100;
  return program + each * particles;
}

/// Positions, quaternions, angles and velocities are stored as they are; images, and in the plane angular velocities,
/// are compressed to a few bytes.
double disk(const Parameters& p, int dimension, double particles) {
  constexpr double file = 50e3, per_frame = 300, of_particle = 44;
  const double velocities = dimension == 2 ? 32 : 48;
  const double per_particle =
      24 + 32 + 4 + (dimension == 2 ? 8 : 0) + (p.output.velocities ? velocities : 0);
  const auto frames = static_cast<double>(sample_times(p).size());
  return file + of_particle * particles + frames * (per_frame + per_particle * particles);
}

/// How often all velocities change between collisions: in Brownian steps, or by kicks.
double velocity_changes(const DynamicsParameters& p) {
  const double time = p.equilibration + p.duration;
  if (p.kind == DynamicsParameters::Kind::brownian) return time / p.brownian_step;
  return p.driving ? time / p.driving->interval : 0;
}

}  // namespace

template <int Dim>
RunCost run_cost(const Parameters& p, const Configuration<Dim>& some) {
  const auto particles = static_cast<double>(p.system.particles);
  const double time = p.dynamics.equilibration + p.dynamics.duration;
  const bool is_round = rotor_count(some) == 0;
  RunCost cost;
  cost.collisions =
      particles * time * collisions_per_particle_and_time(some, p.system.packing_fraction);
  cost.events = events_per_collision * cost.collisions;
  // Each change of the velocities predicts all particles, at about the cost of an event.
  cost.seconds =
      (cost.events + particles * velocity_changes(p.dynamics)) * seconds_per_event(Dim, is_round);
  cost.memory_bytes = memory(Dim, is_round, particles);
  cost.disk_bytes = disk(p, Dim, particles);
  return cost;
}

template <int Dim>
Configuration<Dim> representative_particles(const Parameters& p) {
  constexpr std::int64_t enough = 2000;
  const auto count = static_cast<std::size_t>(std::min(p.system.particles, enough));
  return draw_particles<Dim>(p.species, count, p.system.packing_fraction,
                             box_proportions<Dim>(p.system), p.system.seed);
}

template RunCost run_cost(const Parameters&, const Configuration2&);
template RunCost run_cost(const Parameters&, const Configuration3&);
template Configuration2 representative_particles(const Parameters&);
template Configuration3 representative_particles(const Parameters&);

}  // namespace vitrel
