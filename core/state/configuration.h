#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "core/geometry/particle_shape.h"
#include "core/geometry/periodic_box.h"
#include "core/geometry/pose.h"

namespace vitrel {

/// The state of N particles in a periodic box, in the form that files, Monte Carlo, event-driven dynamics and analysis
/// share. Every vector has one entry per particle. A configuration is a plain value and can be copied freely.
///
/// Units: kT = 1, mass 1 and a b = 1 (in three dimensions a b c = 1) for the reference species. With ℓ the unit of
/// length that follows, the unit of time is √(m ℓ²/kT).
template <int Dim>
struct Configuration;

/// A pair of particles i ≤ j, where j is seen at r_j + shift ∘ L. If i = j, shift and −shift denote the same pair, and
/// the one whose first non-zero component is positive is stored.
template <int Dim>
struct PairImage {
  std::size_t i, j;
  Shift<Dim> shift;
};

/// A soft particle in contact (edmd/soft/soft_contact.h): it moves with the centre of mass of the pair until `time`,
/// and afterwards with `velocity`.
template <int Dim>
struct Release {
  std::size_t particle, partner;
  double time;
  Vec<Dim> velocity;
};

/// A pair of soft particles that lost energy in a contact and is still closer than the sum of its radii. Its centres
/// may be as close as `distance`.
template <int Dim>
struct ClosePair {
  PairImage<Dim> pair;
  double distance;
};

/// The part of a configuration that does not depend on the representation of orientations.
template <int Dim>
struct Particles {
  PeriodicBox<Dim> box;
  double time = 0;

  std::vector<Vec<Dim>> position;  ///< wrapped into the box
  std::vector<Shift<Dim>> image;   ///< unwrapped position = position + image ∘ L
  std::vector<Vec<Dim>> velocity;
  std::vector<AngularVelocity<Dim>> angular_velocity;

  std::vector<ParticleShape<Dim>> shape;
  std::vector<double> mass;
  std::vector<std::int32_t> species;  ///< index into species_names
  std::vector<std::string> species_names;

  std::vector<Release<Dim>> releases;       ///< in ascending order of the particles; none if hard
  std::vector<ClosePair<Dim>> close_pairs;  ///< in ascending order of (i, j); none if hard

  std::size_t size() const { return position.size(); }
  Vec<Dim> unwrapped(std::size_t i) const { return position[i] + box.translation(image[i]); }
};

template <>
struct Configuration<2> : Particles<2> {
  std::vector<double> angle;  ///< unwrapped, radians

  /// Resizes to n particles. New ones are at rest at the origin and round with radius 1, mass 1 and species 0.
  void resize(std::size_t n);
  Pose2 pose(std::size_t i) const { return {position[i], angle[i]}; }
  void set_pose(std::size_t i, const Pose2& pose) {
    position[i] = pose.position;
    angle[i] = pose.angle;
  }
  double inertia(std::size_t i) const { return mass[i] * shape[i].inertia_per_mass(); }
};

template <>
struct Configuration<3> : Particles<3> {
  std::vector<Quaternion> orientation;  ///< from the axes of the body to those of space

  void resize(std::size_t n);
  Pose3 pose(std::size_t i) const { return {position[i], orientation[i]}; }
  void set_pose(std::size_t i, const Pose3& pose) {
    position[i] = pose.position;
    orientation[i] = pose.orientation;
  }
  /// The principal moments about the particle's own axes (particle_shape.h).
  Vec3 inertia(std::size_t i) const { return mass[i] * shape[i].inertia_per_mass(); }
};

using Configuration2 = Configuration<2>;
using Configuration3 = Configuration<3>;

/// Returns whether both configurations hold the same particles, by number, species, masses and shapes.
template <int Dim>
bool same_particles(const Configuration<Dim>& one, const Configuration<Dim>& two);

/// The total area (volume) of the particles divided by that of the box.
template <int Dim>
double packing_fraction(const Configuration<Dim>& configuration);
/// The largest circumradius of all particles.
template <int Dim>
double largest_circumradius(const Configuration<Dim>& configuration);
template <int Dim>
double smallest_inradius(const Configuration<Dim>& configuration);

/// The velocities to use in sums over particles: those of particles in contact are the velocities after the contact.
template <int Dim>
std::vector<Vec<Dim>> velocities_after_contact(const Configuration<Dim>& configuration);

/// Sums over all particles, with velocities after contact. Round particles do not rotate in runs with smooth contacts,
/// which cannot make them spin.
template <int Dim>
struct Mechanics {
  Vec<Dim> momentum = Vec<Dim>::Zero();
  double translational_energy = 0;  ///< Σ m v²/2
  double rotational_energy = 0;     ///< Σ ω·Iω/2
};
template <int Dim>
Mechanics<Dim> mechanics(const Configuration<Dim>& configuration);
/// The number of particles that are not round.
template <int Dim>
std::size_t rotor_count(const Configuration<Dim>& configuration);
/// The kind of contacts: smooth contacts do not change all rotations, rough ones do.
enum class Contacts { smooth, rough };
/// The number of rotational degrees of freedom of a particle that contacts change. Rough contacts change all of them.
template <class Shape>
int rotations(const Shape& shape, Contacts contacts) {
  return contacts == Contacts::smooth ? shape.rotations() : Shape::dimension == 2 ? 1 : 3;
}
/// The sum of `rotations` over all particles.
template <int Dim>
std::size_t rotation_count(const Configuration<Dim>& configuration,
                           Contacts contacts = Contacts::smooth);

}  // namespace vitrel
