#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/contact/contact_screen.h"
#include "core/contact/flight_record.h"
#include "core/geometry/asymmetric_top.h"
#include "core/large_vector.h"
#include "core/neighbors/cell_neighbors.h"
#include "core/neighbors/neighborhood.h"
#include "core/state/configuration.h"
#include "edmd/collision_rule.h"
#include "edmd/momentum_flux.h"
#include "edmd/options.h"

namespace vitrel {

/// The particles of a simulation, their neighbour lists and the clock: what predictor and executor share.
///
/// Times are relative to `base`, and every particle has its own clock. Particles are numbered so that neighbours are
/// near in memory.
template <Body B>
struct SimulationState {
  static constexpr int dimension = B::dimension;
  static constexpr double never = std::numeric_limits<double>::infinity();
  using Index = std::uint32_t;
  using Vector = Vec<dimension>;
  using Shape = BaseShape<B>;
  using Image = NeighborImage<dimension>;

  /// Whether the bodies are disks or spheres, whose contacts are known in closed form.
  static constexpr bool is_round = RoundBody<B>;
  /// Whether the bodies may use cells instead of neighbour lists.
  static constexpr bool has_cells = is_round && !grows<B>;

  using Particle = FlightRecord<B>;
  /// The rotation of a round body at a time; the records of other bodies contain theirs.
  struct Rotation {
    Orientation<dimension> orientation;
    AngularVelocity<dimension> angular_velocity;
    double time = 0;
  };
  /// The free rotation of a tumbling body since its motion changed.
  struct Tumbling {
    AsymmetricTop top;
    double since;
  };

  /// The data shared by all particles of one shape and mass.
  struct ParticleType {
    ShapeCoefficients<Shape> coefficients;
    Inertia<dimension> inertia;  // about its own axes
  };

  PeriodicBox<dimension> box;
  double growth_rate = 0;
  double base = 0;        // simulated time at which the clocks were 0
  double now = 0;         // time since `base`
  double collisions = 0;  // number of collisions since `base`
  double extent = 0;      // magnitude of the coordinates
  double contact_gap = 0;
  MomentumFlux<dimension> flux;
  double fastest = 0;              // largest speed of a surface, at the start of the block
  std::vector<Index> external_id;  // particle numbers of the configuration
  std::vector<std::int32_t> species;
  std::vector<Shape> shapes;  // shape of each type, at size 1
  std::vector<ParticleType> types;
  TypeIndex type_index;
  LargeVector<Particle> particles;
  LargeVector<Rotation> rotations;  // for round bodies
  LargeVector<Tumbling> tumbling;   // for tumbling bodies
  LargeVector<Shift<dimension>> image;
  LargeVector<Index> version;  // number of changes of motion or image so far
  std::optional<Neighborhoods<B>> neighborhoods;
  std::optional<CellNeighbors<B>> cells;  // instead of neighbourhoods, for round bodies

  std::size_t size() const { return particles.size(); }
  const ParticleType& type(Index i) const { return types[type_index[i]]; }
  const Shape& shape(Index i) const { return shapes[type_index[i]]; }
  template <class T>
  const T& of_pair(const PairsOfSpecies<T>& pairs, Index i, Index j) const {
    return pairs.are_the_same() ? pairs.common() : pairs.of(species[i], species[j]);
  }
  CommonSize size_now() const {
    if constexpr (grows<B>) return {1 + growth_rate * now, growth_rate};
    return {};
  }
  /// Returns the record of particle i, advanced to now.
  Particle record_now(Index i) const {
    Particle record = particles[i];
    if constexpr (tumbles<B>) {
      const AsymmetricTop::State state = tumbling[i].top.at(now - tumbling[i].since);
      record.position += (now - record.time) * record.velocity;
      record.rotation.orientation = quaternion_of(state.axes);
      record.rotation.angular_velocity = state.angular_velocity;
    } else {
      record.set_pose(record.pose_at(now));
    }
    record.time = now;
    return record;
  }
  Pose<dimension> pose_now(Index i) const {
    if constexpr (tumbles<B>)
      return record_now(i).pose();
    else
      return particles[i].pose_at(now);
  }
  Vector position_at(Index i, double time) const {
    return particles[i].position + (time - particles[i].time) * particles[i].velocity;
  }
  /// Sets the motion of a particle that has been advanced to now.
  void set_motion(Index i, const Motion<dimension>& motion) {
    Particle& particle = particles[i];
    particle.set_motion(motion);
    if constexpr (tumbles<B>) {
      tumbling[i] = {AsymmetricTop(shape(i), particle.orientation(), motion.angular_velocity), now};
      particle.rotation.max_angular_speed = tumbling[i].top.max_speed();
    }
  }
  /// Returns a motion whose speeds particle i never exceeds in flight.
  Motion<dimension> fastest_motion(Index i) const {
    Motion<dimension> motion = particles[i].motion();
    if constexpr (tumbles<B>)
      motion.angular_velocity =
          particles[i].rotation.max_angular_speed * normalized(motion.angular_velocity);
    return motion;
  }
  Inertia<dimension> inertia_now(Index i) const {
    return in_space(type(i).inertia, particles[i].pose(), size_now().size);
  }
  /// Motion and inertia with all rotations, as rough contacts need them, of a particle that has been advanced to now.
  Motion<dimension> full_motion(Index i) const;
  void set_full_motion(Index i, Motion<dimension> motion);
  Inertia<dimension> full_inertia_now(Index i) const;
  void advance_to_now(Index i) { particles[i] = record_now(i); }
  /// Advances the record of a tumbling body if the body has turned so far since the time of the record that the bound
  /// of the contact screen becomes loose.
  void refresh(Index i) {
    if constexpr (tumbles<B>) {
      constexpr double tolerance = 0.02;  // error of the support function, in shortest semi-axes
      const double turned = particles[i].rotation.max_angular_speed * (now - particles[i].time);
      if (0.5 * type(i).coefficients.max_tumbling * turned * turned >
          tolerance * shape(i).inradius())
        advance_to_now(i);
    }
  }
  /// Returns the time when the motion of particle i last changed, or when the particle was advanced since then.
  double last_change(Index i) const {
    if constexpr (tumbles<B>) return tumbling[i].since;
    return particles[i].time;
  }
  /// Returns the vector from i to the image of its partner; both must have been advanced to now.
  Vector separation(Index i, const Image& partner) const {
    return particles[partner.other].position + box.translation(partner.shift()) -
           particles[i].position;
  }
  /// Returns the neighbours of particle i, valid until the next call in the same thread.
  std::span<Neighbor<B>> neighbors(Index i) {
    if constexpr (has_cells)
      if (cells) return cells->of(i);
    return neighborhoods->of(i);
  }
  /// Returns the time when particle i leaves its neighbourhood, or its cell.
  double next_exit(Index i) const {
    if constexpr (has_cells)
      if (cells) return now + cells->exit_time(i, pose_now(i).position, particles[i].velocity);
    return now + neighborhoods->exit_time(i, pose_now(i), fastest_motion(i), size_now());
  }

  /// Begins a block; `target_neighbors` is the mean length of lists.
  void load(const Configuration<dimension>& configuration, NeighborSearch method,
            double target_neighbors);
  void write(Configuration<dimension>& configuration) const;
  void set_velocities(const Configuration<dimension>& configuration);
  /// Sets the clocks back to 0, since times are rounded as well as positions. Returns the time by which they were set
  /// back.
  double reset_clocks();
  /// Renews the neighbourhood of a particle that leaves it. Returns the neighbours that it gains, valid until the next
  /// call in the same thread.
  std::span<Neighbor<B>> leave_neighborhood(Index i);

 private:
  void load_particles(const Configuration<dimension>& configuration);
  void load_types(const Configuration<dimension>& configuration);
  void begin_flux();
  void find_neighbors(NeighborSearch method, double target);
  Rotation rotation_now(Index i) const;
  Vector with_scaled_spin(Index i, const Vector& angular_velocity, bool to_true) const
      requires(B::dimension == 3);
  std::span<Neighbor<B>> renew_neighbors(Index i);
};

// ---------------------------------------------------------------------------------------------------

template <Body B>
double SimulationState<B>::reset_clocks() {
  const double elapsed = now;
  base += elapsed;
  now = collisions = 0;
  flux.reset_clock(elapsed);
  for (Rotation& rotation : rotations) rotation.time -= elapsed;
  for (Tumbling& body : tumbling) body.since -= elapsed;
  for (Particle& particle : particles) {
    particle.time -= elapsed;
    particle.known_until -= elapsed;
  }
  return elapsed;
}

template <Body B>
std::span<Neighbor<B>> SimulationState<B>::leave_neighborhood(Index i) {
  advance_to_now(i);
  const Shift<dimension> before = image[i];
  const std::span<Neighbor<B>> gained = renew_neighbors(i);
  // Collisions scheduled with the old image are stale.
  if (image[i] != before) ++version[i];
  return gained;
}

// Wraps particle i into the box, where its neighbours are searched. Returns the neighbours that it gains.
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
  // A reference ahead of the particle does not pay for disks and spheres: they only predict contacts with new
  // neighbours, so a renewal is cheap.
  const Pose<dimension> reference =
      is_round ? particle.pose() : neighborhoods->ahead_of(i, particle.pose(), fastest_motion(i));
  const std::size_t kept = neighborhoods->update(i, reference, size_now().size);
  return neighborhoods->of(i).subspan(kept);
}

}  // namespace vitrel
