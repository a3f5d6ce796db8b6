#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "core/geometry/particle_shape.h"
#include "core/geometry/periodic_box.h"
#include "core/geometry/pose.h"

namespace vitrel {

/// The state of N particles in a periodic box: the form that files, Monte Carlo, event-driven dynamics
/// and analysis share. One entry per particle in every vector; a plain value, copied at will.
///
/// Units: kT = 1, mass 1 and a b = 1 (in three dimensions a b c = 1) for the reference species; with ℓ
/// that unit of length, time is in √(m ℓ²/kT).
template <int Dim>
struct Configuration;

/// Particles i ≤ j, j seen at r_j + shift ∘ L. If i = j, shift and −shift are the same pair, and
/// the one whose first non-zero component is positive is given.
template <int Dim>
struct PairImage {
  std::size_t i, j;
  Shift<Dim> shift;
};

/// A soft particle in contact (edmd/soft/soft_contact.h): it moves with the centre of mass of the pair
/// until `time`, and then on with `velocity`.
template <int Dim>
struct Release {
  std::size_t particle, partner;
  double time;
  Vec<Dim> velocity;
};

/// A pair of soft particles that lost energy in a contact and is still closer than the sum of its radii: its centres
/// may be as close as `distance`.
template <int Dim>
struct ClosePair {
  PairImage<Dim> pair;
  double distance;
};

/// The part that does not depend on the representation of orientations.
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

  /// Makes room for n particles at rest at the origin, round with radius 1, mass 1, species 0.
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
  /// About the own axes (particle_shape.h).
  Vec3 inertia(std::size_t i) const { return mass[i] * shape[i].inertia_per_mass(); }
};

using Configuration2 = Configuration<2>;
using Configuration3 = Configuration<3>;

/// Whether the same particles, by number, species, masses and shapes, are in both.
template <int Dim>
bool same_particles(const Configuration<Dim>& one, const Configuration<Dim>& two);

/// Total area (volume) of the particles over that of the box.
template <int Dim>
double packing_fraction(const Configuration<Dim>& configuration);
/// The largest circumradius and the smallest inradius of all particles.
template <int Dim>
double largest_circumradius(const Configuration<Dim>& configuration);
template <int Dim>
double smallest_inradius(const Configuration<Dim>& configuration);

/// Velocities for all sums: particles in contact count with the velocity after the contact.
template <int Dim>
std::vector<Vec<Dim>> velocities_after_contact(const Configuration<Dim>& configuration);

/// Sums over all particles, with velocities after contact. Round particles are at rest in runs with smooth contacts,
/// which cannot make them spin.
template <int Dim>
struct Mechanics {
  Vec<Dim> momentum = Vec<Dim>::Zero();
  double translational_energy = 0;  ///< Σ m v²/2
  double rotational_energy = 0;     ///< Σ ω·Iω/2
};
template <int Dim>
Mechanics<Dim> mechanics(const Configuration<Dim>& configuration);
/// Number of particles that are not round.
template <int Dim>
std::size_t rotor_count(const Configuration<Dim>& configuration);
/// Smooth contacts do not change all rotations, rough ones do.
enum class Contacts { smooth, rough };
/// The number of rotations of a particle that contacts change. Rough contacts change all of them.
template <class Shape>
int rotations(const Shape& shape, Contacts contacts) {
  return contacts == Contacts::smooth ? shape.rotations() : Shape::dimension == 2 ? 1 : 3;
}
/// The rotations of all particles together.
template <int Dim>
std::size_t rotation_count(const Configuration<Dim>& configuration,
                           Contacts contacts = Contacts::smooth);

}  // namespace vitrel
