#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/contact/contact_screen.h"
#include "core/contact/flight_record.h"
#include "core/neighbors/cell_neighbors.h"
#include "core/neighbors/neighborhood.h"
#include "core/neighbors/spatial_order.h"
#include "core/state/configuration.h"
#include "core/tolerances.h"
#include "edmd/collision_rule.h"
#include "edmd/options.h"

namespace vitrel {

/// The particles of a simulation, their neighbour lists and the clock: what predictor and executor share.
///
/// Times are relative to `base`, and every particle has its own clock. Particles are numbered so that
/// neighbours are near in memory.
template <Body B>
struct SimulationState {
  static constexpr int dimension = B::dimension;
  static constexpr double never = std::numeric_limits<double>::infinity();
  using Index = std::uint32_t;
  using Vector = Vec<dimension>;
  using Shape = BaseShape<B>;
  using Image = NeighborImage<dimension>;

  /// Disks and spheres: contacts are known in closed form.
  static constexpr bool is_round = RoundBody<B>;
  /// They may do without lists.
  static constexpr bool has_cells = is_round && !grows<B>;

  using Particle = FlightRecord<B>;
  /// Of a sphere; other bodies have theirs in the record.
  struct Rotation {
    Orientation<dimension> orientation;
    AngularVelocity<dimension> angular_velocity;
  };

  /// The data shared by all particles of one shape and mass.
  struct ParticleType {
    ShapeCoefficients<Shape> coefficients;
    Inertia<dimension> inertia;  // about its own axes
  };

  PeriodicBox<dimension> box;
  double growth_rate = 0;
  double base = 0;        // simulated time when the clocks were at 0
  double now = 0;         // since then
  double collisions = 0;  // since then
  double extent = 0;      // magnitude of the coordinates
  double contact_gap = 0;
  double fastest = 0;              // speed of a surface, at the start of the block
  std::vector<Index> external_id;  // particle numbers of the configuration
  std::vector<Shape> shapes;       // by type, at size 1
  std::vector<ParticleType> types;
  TypeIndex type_index;
  std::vector<Particle> particles;
  std::vector<Rotation> rotations;  // of spheres, at rotation_time
  double rotation_time = 0;
  std::vector<Shift<dimension>> image;
  std::vector<Index> version;  // changes of motion or image so far
  std::optional<Neighborhoods<B>> neighborhoods;
  std::optional<CellNeighbors<B>> cells;  // instead of neighbourhoods; of round bodies

  std::size_t size() const { return particles.size(); }
  const ParticleType& type(Index i) const { return types[type_index[i]]; }
  const Shape& shape(Index i) const { return shapes[type_index[i]]; }
  CommonSize size_now() const {
    if constexpr (grows<B>) return {1 + growth_rate * now, growth_rate};
    return {};
  }
  Pose<dimension> pose_now(Index i) const { return particles[i].pose_at(now); }
  Inertia<dimension> inertia_now(Index i) const {
    return in_space(type(i).inertia, particles[i].pose(), size_now().size);
  }
  void advance_to_now(Index i) {
    Particle& particle = particles[i];
    particle.set_pose(particle.pose_at(now));
    particle.time = now;
  }
  /// From i to the image of its partner, both advanced to now.
  Vector separation(Index i, const Image& partner) const {
    return particles[partner.other].position + box.translation(partner.shift()) -
           particles[i].position;
  }
  /// Valid until the next call in the same thread.
  std::span<Neighbor<B>> neighbors(Index i) {
    if constexpr (has_cells)
      if (cells) return cells->of(i);
    return neighborhoods->of(i);
  }
  /// When particle i leaves its neighbourhood, or its cell.
  double next_exit(Index i) const {
    if constexpr (has_cells)
      if (cells) return now + cells->exit_time(i, pose_now(i).position, particles[i].velocity);
    return now + neighborhoods->exit_time(i, pose_now(i), particles[i].motion(), size_now());
  }

  /// Begins a block; `target_neighbors` is the mean length of lists.
  void load(const Configuration<dimension>& configuration, NeighborSearch method,
            double target_neighbors);
  void write(Configuration<dimension>& configuration) const;
  void set_velocities(const Configuration<dimension>& configuration);
  /// Sets the clocks back to 0, since times are rounded as well as positions. Returns the time taken off.
  double reset_clocks();
  /// Renews the neighbourhood of a particle that leaves it. Returns the neighbours that it gains, valid until the next
  /// call in the same thread.
  std::span<Neighbor<B>> leave_neighborhood(Index i);

 private:
  void load_particles(const Configuration<dimension>& configuration);
  void load_types(const Configuration<dimension>& configuration);
  void find_neighbors(NeighborSearch method, double target);
  Rotation rotation_now(Index i) const;
  std::span<Neighbor<B>> renew_neighbors(Index i);
};

namespace detail {

/// The shape at size 1 for the semi-axes in a configuration.
template <class Shape, class Axes>
Shape shape_from(const Axes& semi_axes) {
  if constexpr (std::is_convertible_v<Axes, Shape>)
    return semi_axes;
  else
    return {semi_axes.circumradius()};
}

inline Ellipse particle_shape(const Ellipse& shape) {
  return shape;
}
inline Ellipsoid particle_shape(const Ellipsoid& shape) {
  return shape;
}
inline Ellipsoid particle_shape(const Sphere& shape) {
  return {Vec3::Constant(shape.radius)};
}

inline std::vector<double> semi_axis_values(const Ellipse& shape) {
  return {shape.a, shape.b};
}
inline std::vector<double> semi_axis_values(const Ellipsoid& shape) {
  return {shape.semi_axes[0], shape.semi_axes[1], shape.semi_axes[2]};
}

/// The magnitude of an angle, which determines its rounding error: unwrapped angles grow, quaternions stay normalised.
inline double angle_magnitude(double angle) {
  return std::abs(angle);
}
inline double angle_magnitude(const Quaternion&) {
  return 1;
}
inline double spin_magnitude(double angular_velocity) {
  return std::abs(angular_velocity);
}
inline double spin_magnitude(const Vec3& angular_velocity) {
  return angular_velocity.norm();
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
  extent = 0.5 * box.lengths().maxCoeff();
  fastest = 0;
  for (Index i = 0; i < size(); ++i) {
    const Particle& particle = particles[i];
    const double max_support_rate = shape(i).max_support_rate();
    // Angles are also rounded, which moves the surface by up to max_support_rate times the rounding error.
    extent = std::max({extent, shape(i).circumradius(),
                       max_support_rate * detail::angle_magnitude(particle.orientation())});
    fastest = std::max(fastest,
                       particle.velocity.norm() +
                           max_support_rate * detail::spin_magnitude(particle.angular_velocity()));
  }
  contact_gap = tolerance::contact_gap(extent);
  find_neighbors(method, target_neighbors);
}

template <Body B>
void SimulationState<B>::load_particles(const Configuration<dimension>& configuration) {
  external_id = spatial_order<dimension>(box, configuration.position);
  particles.clear();
  rotations.clear();
  rotation_time = 0;
  image.clear();
  version.assign(external_id.size(), 0);
  for (const Index k : external_id) {
    Pose<dimension> pose = configuration.pose(k);
    Shift<dimension> boxes = configuration.image[k];
    box.wrap(pose.position, boxes);
    const AngularVelocity<dimension>& angular_velocity = configuration.angular_velocity[k];
    particles.push_back(flight_record<B>(pose, {configuration.velocity[k], angular_velocity}));
    if constexpr (!Particle::has_rotation)
      rotations.push_back({orientation_of(pose), angular_velocity});
    image.push_back(boxes);
  }
}

template <Body B>
void SimulationState<B>::load_types(const Configuration<dimension>& configuration) {
  std::map<std::vector<double>, std::uint32_t> known;
  shapes.clear();
  types.clear();
  std::vector<std::uint32_t> index;
  for (const Index k : external_id) {
    const Solid<dimension>& semi_axes = configuration.shape[k];
    const double mass = configuration.mass[k];
    std::vector<double> numbers = detail::semi_axis_values(semi_axes);
    numbers.push_back(mass);
    const auto [place, is_new] = known.try_emplace(std::move(numbers), types.size());
    index.push_back(place->second);
    if (!is_new) continue;
    const auto shape = detail::shape_from<Shape>(semi_axes);
    shapes.push_back(shape);
    types.push_back({ShapeCoefficients<Shape>(shape), inertia_of(semi_axes, mass)});
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
    Pose<dimension> pose = pose_now(i);
    configuration.angular_velocity[k] = particles[i].angular_velocity();
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
      rotations[i] = {rotation_now(i).orientation, motion.angular_velocity};
    advance_to_now(i);
    particles[i].set_motion(motion);
    fastest = std::max(fastest, motion.velocity.norm());
  }
  rotation_time = now;
}

template <Body B>
double SimulationState<B>::reset_clocks() {
  const double elapsed = now;
  base += elapsed;
  now = collisions = 0;
  rotation_time -= elapsed;
  for (Particle& particle : particles) {
    particle.time -= elapsed;
    particle.known_until -= elapsed;
  }
  return elapsed;
}

// Of a sphere.
template <Body B>
typename SimulationState<B>::Rotation SimulationState<B>::rotation_now(Index i) const {
  const auto& [orientation, angular_velocity] = rotations[i];
  const Pose<dimension> pose{Vector::Zero(), orientation};
  const Motion<dimension> motion{Vector::Zero(), angular_velocity};
  return {orientation_of(advanced(pose, motion, now - rotation_time)), angular_velocity};
}

template <Body B>
std::span<Neighbor<B>> SimulationState<B>::leave_neighborhood(Index i) {
  advance_to_now(i);
  const Shift<dimension> before = image[i];
  const std::span<Neighbor<B>> gained = renew_neighbors(i);
  // Collisions scheduled with its old image are stale.
  if (image[i] != before) ++version[i];
  return gained;
}

// Wraps particle i into the box, which is where its neighbours are found. Returns those gained.
template <Body B>
std::span<Neighbor<B>> SimulationState<B>::renew_neighbors(Index i) {
  Particle& particle = particles[i];
  if constexpr (has_cells) {
    if (cells) {
      const auto crossing = cells->cross(i, particle.position, particle.velocity);
      particle.position -= box.translation(crossing.boxes);
      image[i] += crossing.boxes;
      return crossing.gained;
    }
  }
  box.wrap(particle.position, image[i]);
  const std::size_t kept = neighborhoods->update(i, particle.pose(), size_now().size);
  return neighborhoods->of(i).subspan(kept);
}

}  // namespace vitrel
