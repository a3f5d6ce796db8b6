#pragma once

#include <algorithm>
#include <map>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/geometry/free_flight.h"
#include "core/neighbors/spatial_order.h"
#include "core/tolerances.h"
#include "edmd/simulation_state.h"

/// @file
/// Functions that begin the state of a simulation from a configuration, write it to one, and take its velocities from
/// one.
namespace vitrel {

namespace detail {

/// Returns the shape at size 1 in the form that the simulation uses.
template <class Shape>
Shape shape_from(const ParticleShape<Shape::dimension>& of_particle) {
  if constexpr (std::is_same_v<Shape, ParticleShape<Shape::dimension>>)
    return of_particle;
  else
    return {of_particle.circumradius()};
}
/// Returns the particle shape of a shape in the form that the simulation uses.
template <class Shape>
ParticleShape<Shape::dimension> particle_shape(const Shape& shape) {
  if constexpr (std::is_same_v<Shape, ParticleShape<Shape::dimension>>)
    return shape;
  else
    return round_shape<Shape::dimension>(shape.radius);
}

/// Returns the magnitude of an angle, which determines its rounding error: unwrapped angles grow, quaternions stay
/// normalised.
inline double angle_magnitude(double angle) {
  return std::abs(angle);
}
inline double angle_magnitude(const Quaternion&) {
  return 1;
}

}  // namespace detail

// ---------------------------------------------------------------------------------------------------

template <Body B>
void SimulationState<B>::load(const Configuration<dimension>& configuration, NeighborSearch method,
                              double target_neighbors) {
  box = configuration.box;
  base = configuration.time;
  now = collisions = 0;
  load_particles(configuration);
  load_types(configuration);
  if constexpr (tumbles<B>) {
    tumbling.resize(size());
    for (Index i = 0; i < size(); ++i) set_motion(i, particles[i].motion());
  }
  extent = 0.5 * box.lengths().maxCoeff();
  fastest = 0;
  for (Index i = 0; i < size(); ++i) {
    const Particle& particle = particles[i];
    const double max_support_rate = shape(i).max_support_rate();
    // Angles are also rounded, which moves the surface by up to max_support_rate times the rounding error.
    extent = std::max({extent, shape(i).circumradius(),
                       max_support_rate * detail::angle_magnitude(particle.orientation())});
    fastest = std::max(fastest, norm(particle.velocity) +
                                    max_support_rate * norm(fastest_motion(i).angular_velocity));
  }
  begin_flux();
  contact_gap = tolerance::contact_gap(extent);
  find_neighbors(method, target_neighbors);
}

template <Body B>
void SimulationState<B>::load_particles(const Configuration<dimension>& configuration) {
  external_id = spatial_order<dimension>(box, configuration.position);
  particles.clear();
  species.clear();
  rotations.clear();
  image.clear();
  version.assign(external_id.size(), 0);
  for (const Index k : external_id) {
    Pose<dimension> pose = configuration.pose(k);
    Shift<dimension> boxes = configuration.image[k];
    box.wrap(pose.position, boxes);
    const AngularVelocity<dimension>& angular_velocity = configuration.angular_velocity[k];
    particles.push_back(flight_record<B>(pose, {configuration.velocity[k], angular_velocity}));
    if constexpr (!Particle::has_rotation)
      rotations.push_back({orientation_of(pose), angular_velocity, 0});
    image.push_back(boxes);
    species.push_back(configuration.species[k]);
  }
}

template <Body B>
void SimulationState<B>::load_types(const Configuration<dimension>& configuration) {
  std::map<std::vector<double>, std::uint32_t> known;
  shapes.clear();
  types.clear();
  std::vector<std::uint32_t> index;
  for (const Index k : external_id) {
    const ParticleShape<dimension>& of_particle = configuration.shape[k];
    const double mass = configuration.mass[k];
    const Vec<dimension> lengths = of_particle.half_lengths();
    std::vector<double> numbers(lengths.begin(), lengths.end());
    numbers.push_back(mass);
    const auto [place, is_new] = known.try_emplace(std::move(numbers), types.size());
    index.push_back(place->second);
    if (!is_new) continue;
    const auto shape = detail::shape_from<Shape>(of_particle);
    shapes.push_back(shape);
    types.push_back({ShapeCoefficients<Shape>(shape), inertia_of(of_particle, mass)});
  }
  type_index = TypeIndex(std::move(index), types.size());
}

template <Body B>
void SimulationState<B>::find_neighbors(NeighborSearch method, double target) {
  if constexpr (has_cells) {
    if (method == NeighborSearch::cells) {
      std::vector<Vector> positions;
      for (const Particle& particle : particles) positions.push_back(particle.position);
      cells.emplace(box, std::ranges::max(shapes, {}, &Shape::radius).radius, positions);
      return;
    }
  }
  std::vector<Pose<dimension>> poses;
  poses.reserve(size());
  for (const Particle& particle : particles) poses.push_back(particle.pose());
  neighborhoods.emplace(box, shapes, type_index, poses, target);
}

template <Body B>
void SimulationState<B>::write(Configuration<dimension>& configuration) const {
  configuration.time = base + now;
  const double size_factor = size_now().size;
  for (Index i = 0; i < size(); ++i) {
    const Index k = external_id[i];
    const Particle record = record_now(i);
    Pose<dimension> pose = record.pose();
    configuration.angular_velocity[k] = record.angular_velocity();
    if constexpr (!Particle::has_rotation) {
      const Rotation rotation = rotation_now(i);
      pose.orientation = rotation.orientation;
      configuration.angular_velocity[k] = rotation.angular_velocity;
    }
    configuration.set_pose(k, pose);
    configuration.image[k] = image[i];
    box.wrap(configuration.position[k], configuration.image[k]);
    configuration.velocity[k] = particles[i].velocity;
    if constexpr (grows<B>)
      configuration.shape[k] = detail::particle_shape(scaled(shape(i), size_factor));
  }
}

template <Body B>
void SimulationState<B>::set_velocities(const Configuration<dimension>& configuration) {
  for (Index i = 0; i < size(); ++i) {
    const Motion<dimension> motion{configuration.velocity[external_id[i]],
                                   configuration.angular_velocity[external_id[i]]};
    if constexpr (!Particle::has_rotation)
      rotations[i] = {rotation_now(i).orientation, motion.angular_velocity, now};
    advance_to_now(i);
    set_motion(i, motion);
    fastest = std::max(fastest, norm(motion.velocity));
  }
  begin_flux();
}

template <Body B>
void SimulationState<B>::begin_flux() {
  flux.begin(now);
  for (Index i = 0; i < size(); ++i)
    flux.add_particle(1 / type(i).inertia.inverse_mass, particles[i].velocity);
}

// A sphere turns at a constant angular velocity.
template <Body B>
typename SimulationState<B>::Rotation SimulationState<B>::rotation_now(Index i) const {
  const auto& [orientation, angular_velocity, time] = rotations[i];
  const Pose<dimension> pose{Vector::Zero(), orientation};
  const Motion<dimension> motion{Vector::Zero(), angular_velocity};
  return {orientation_of(advanced(pose, motion, now - time)), angular_velocity, now};
}

// The record of a spheroid holds L/I⊥ (ellipsoid.h), which is not its angular velocity if it spins.
template <Body B>
auto SimulationState<B>::full_motion(Index i) const -> Motion<dimension> {
  Motion<dimension> motion = particles[i].motion();
  if constexpr (!Particle::has_rotation)
    motion.angular_velocity = rotations[i].angular_velocity;
  else if constexpr (dimension == 3)
    motion.angular_velocity = with_scaled_spin(i, motion.angular_velocity, true);
  return motion;
}

template <Body B>
void SimulationState<B>::set_full_motion(Index i, Motion<dimension> motion) {
  if constexpr (!Particle::has_rotation)
    rotations[i] = {rotation_now(i).orientation, motion.angular_velocity, now};
  else if constexpr (dimension == 3)
    motion.angular_velocity = with_scaled_spin(i, motion.angular_velocity, false);
  set_motion(i, motion);
}

template <Body B>
auto SimulationState<B>::full_inertia_now(Index i) const -> Inertia<dimension> {
  const Inertia<dimension> own =
      full_inertia_of(detail::particle_shape(shape(i)), 1 / type(i).inertia.inverse_mass);
  return in_space(own, particles[i].pose(), 1);
}

// Returns the angular velocity of a spheroid with the component along its axis multiplied by I⊥/I∥, or divided by it
// unless `to_true`.
template <Body B>
auto SimulationState<B>::with_scaled_spin(Index i, const Vector& angular_velocity,
                                          bool to_true) const -> Vector
    requires(B::dimension == 3) {
  const auto& body = shape(i);
  const int axis = body.symmetry_axis();
  if (axis == no_axis) return angular_velocity;
  const Vector a = particles[i].orientation() * Vector::Unit(axis);
  const double factor = to_true ? spin_factor(body) : 1 / spin_factor(body);
  return angular_velocity + (factor - 1) * dot(a, angular_velocity) * a;
}

}  // namespace vitrel
