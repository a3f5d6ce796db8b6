#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "core/contact/contact_queries.h"
#include "core/contact/ellipse_contact_screen.h"
#include "core/contact/ellipsoid_contact_screen.h"
#include "core/error.h"
#include "core/neighbors/neighborhood.h"
#include "core/neighbors/prefetch.h"
#include "core/neighbors/spatial_order.h"
#include "core/parallel.h"
#include "core/tolerances.h"
#include "edmd/calendar.h"
#include "edmd/collision_rule.h"
#include "edmd/engine.h"
#include "edmd/soft/soft_contact.h"

namespace vitrel {

/// The shape at size 1 for the semi-axes in a configuration, and the body of that shape at the common size.
template <class Shape, class Axes>
Shape shape_from(const Axes& semi_axes) {
  if constexpr (std::is_convertible_v<Axes, Shape>)
    return semi_axes;
  else
    return {semi_axes.circumradius()};
}
template <Body B>
B body_from(const BaseShape<B>& shape, const CommonSize& common) {
  if constexpr (grows<B>)
    return {shape, common.size, common.growth_rate};
  else
    return {shape};
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

/// The event loop, written once for all bodies.
///
/// Each particle has one entry in the calendar: the earliest of its contacts with its neighbours and of the time at
/// which it leaves its neighbourhood. A prediction changes only the entry of its own particle. For every pair of
/// neighbours (i, j) the earlier of the two entries is no later than their first contact; a prediction for i
/// therefore never searches beyond the earliest known event of i or of j. An entry whose partner has changed its
/// motion in the meantime is stale: when it comes up, the particle is predicted again.
///
/// A prediction screens all neighbours (contact_screen.h) and searches only the candidates that could come first,
/// in the order of their lower bounds. It does not search a contact whose lower bound is far ahead, because other
/// events overtake most of these; the particle is predicted again at that time.
///
/// Soft particles in contact also have an entry for their release (soft_events.h).
///
/// Times are relative to the start of the block, and every particle has its own clock. Particles are numbered so
/// that neighbours are near in memory.
template <Body B>
class Simulation final : public Engine<B::dimension> {
  static constexpr int dimension = B::dimension;
  using Vector = Vec<dimension>;
  using Image = NeighborImage<dimension>;

 public:
  Simulation(const EngineOptions& options, std::string description)
      : options_(options), description_(std::move(description)) {}

  using Engine<B::dimension>::never;
  using Stop = typename Engine<B::dimension>::Stop;

  void load(const Configuration<dimension>& configuration, double horizon) override;
  Stop advance(double until, RunCounters& counters) override;
  void write(Configuration<dimension>& configuration) const override;
  void set_velocities(const Configuration<dimension>& configuration, double horizon,
                      RunCounters& counters) override;
  std::string description() const override { return description_; }

 private:
  using Index = std::uint32_t;
  using Shape = BaseShape<B>;

  /// Mean number of neighbours per particle. Fewer mean fewer predictions but more list updates; the cost of a
  /// collision is flat around this number.
  static constexpr double target_neighbors = dimension == 2 ? 7 : 14;
  static constexpr std::uint64_t events_per_particle_and_block = 32;
  static constexpr std::uint64_t min_events_per_block = 4096;
  /// Systems with more particles exceed the caches, and consecutive events are far apart in memory: the loop
  /// prefetches what an event will read, in stages this many events apart. For smaller systems this costs more
  /// than it saves. In three dimensions a particle has twice the neighbours.
  static constexpr std::size_t cached_particles = dimension == 2 ? 32768 : 2048;
  static constexpr std::uint64_t prefetch_stages = 4, events_per_stage = 4;

  /// A grazing contact: soft particles that approach by less than the first fraction of the largest speed are not
  /// collided, but separate at the second fraction. Both are far above the rounding of velocities and far
  /// below physical relevance.
  static constexpr double grazing_speed = 1e-12, separation_speed = 1e-13;

  struct Empty {};  // replaces members that a body does not have

  struct Rotation {
    Orientation<dimension> orientation;
    AngularVelocity<dimension> angular_velocity;
  };
  /// Spheres rotate uniformly, and no event depends on it: predictions need not read their rotation.
  static constexpr bool rotation_is_separate = dimension == 3 && ContactScreen<B>::is_exact;
  /// The part of a particle that predictions read: one cache line, for ellipsoids two.
  struct alignas(64) Particle {
    Vector position, velocity;
    double time;  // local clock of position and orientation
    double next;  // of its entry in the calendar
    [[no_unique_address]] std::conditional_t<rotation_is_separate, Empty, Rotation> rotation;

    Orientation<dimension> orientation() const {
      if constexpr (rotation_is_separate)
        return Orientation<dimension>::Identity();
      else
        return rotation.orientation;
    }
    AngularVelocity<dimension> angular_velocity() const {
      if constexpr (rotation_is_separate)
        return AngularVelocity<dimension>::Zero();
      else
        return rotation.angular_velocity;
    }
    Pose<dimension> pose() const { return {position, orientation()}; }
    Pose<dimension> pose_at(double t) const {
      if constexpr (rotation_is_separate)
        return {position + (t - time) * velocity, orientation()};
      else
        return advanced(pose(), motion(), t - time);
    }
    Motion<dimension> motion() const { return {velocity, angular_velocity()}; }
    void set_pose(const Pose<dimension>& pose) {
      position = pose.position;
      if constexpr (!rotation_is_separate) rotation.orientation = orientation_of(pose);
    }
    void set_motion(const Motion<dimension>& motion) {
      velocity = motion.velocity;
      if constexpr (!rotation_is_separate) rotation.angular_velocity = motion.angular_velocity;
    }
  };
  /// The data shared by all particles of one shape and mass.
  struct ParticleType {
    ShapeCoefficients<Shape> coefficients;
    Inertia<dimension> inertia;  // about its own axes
  };

  /// The contact normal of a collision; with an exact screen it is the line of centres.
  struct ContactNormal {
    Vector value = Vector::Zero();
  };
  using Normal = std::conditional_t<ContactScreen<B>::is_exact, Empty, ContactNormal>;

  struct alignas(32) Event {
    enum class Type : std::uint8_t { collision, correction, exit, repredict, release };
    Type type = Type::repredict;
    Index partner_version = 0;
    Image partner;
    [[no_unique_address]] Normal normal;
  };
  /// An event and its time.
  struct Entry {
    double time;
    Event event;
  };
  /// A screen in progress, with the neighbours in its lanes.
  struct ScreenBatch {
    ContactScreen<B> screen;
    Neighbor<B>* neighbor[ContactScreen<B>::lanes] = {};
    double horizon[ContactScreen<B>::lanes] = {};  // contacts after these times do not matter
    int count = 0;
  };
  /// The neighbours that a prediction tests: all, up to the times of their own entries; or, when all entries are
  /// predicted in parallel, only those with higher indices, so that each pair is tested once.
  enum class Scope { all_neighbors, higher_indices };

  /// The pending release of a soft particle in contact.
  struct Release {
    double time = never;
    Index partner = 0;
    Vector velocity;
  };
  /// A pair independent of periodic wrapping: `unwrapped_shift` is the shift between unwrapped positions.
  struct UnwrappedPair {
    Index i, j;
    Shift<dimension> unwrapped_shift;

    /// The pair in ascending order of two distinct particles.
    UnwrappedPair ascending() const {
      return i < j ? *this : UnwrappedPair{j, i, -unwrapped_shift};
    }
    friend bool operator==(const UnwrappedPair&, const UnwrappedPair&) = default;
    friend bool operator<(const UnwrappedPair& one, const UnwrappedPair& two) {
      if (one.i != two.i || one.j != two.j)
        return std::pair(one.i, one.j) < std::pair(two.i, two.j);
      return std::ranges::lexicographical_compare(one.unwrapped_shift, two.unwrapped_shift);
    }
  };

  static constexpr bool may_be_soft = std::same_as<B, Disk> || std::same_as<B, Sphere>;
  bool is_soft() const {
    if constexpr (may_be_soft) return options_.soft_contact != nullptr;
    return false;
  }
  ContactPair contact_pair_of(Index i, Index j) const {
    return contact_pair(shape(i).circumradius(), 1 / type(i).inertia.inverse_mass,
                        shape(j).circumradius(), 1 / type(j).inertia.inverse_mass);
  }
  /// The share of i in a change of the relative motion: reduced mass over its own mass.
  double share(Index i, Index j) const {
    const double mine = type(i).inertia.inverse_mass;
    return mine / (mine + type(j).inertia.inverse_mass);
  }
  bool in_contact(Index i) const { return releases_[i].time < never; }
  UnwrappedPair unwrapped_pair(Index i, const Image& partner) const {
    return {i, partner.other, partner.shift() + image_[i] - image_[partner.other]};
  }

  bool uses_prefetch() const { return particles_.size() > cached_particles; }
  const ParticleType& type(Index i) const { return types_[type_index_[i]]; }
  const Shape& shape(Index i) const { return shapes_[type_index_[i]]; }
  CommonSize size_now() const {
    if constexpr (grows<B>) return {1 + options_.growth_rate * now_, options_.growth_rate};
    return {};
  }
  Inertia<dimension> inertia_now(Index i) const {
    const double size = size_now().size;
    return in_space(type(i).inertia, particles_[i].pose(), size);
  }
  /// The current rotation of a sphere.
  Rotation rotation_now(Index i) const {
    const auto& [orientation, angular_velocity] = rotations_[i];
    const Pose<dimension> pose{Vector::Zero(), orientation};
    const Motion<dimension> motion{Vector::Zero(), angular_velocity};
    return {orientation_of(advanced(pose, motion, now_ - rotation_time_)), angular_velocity};
  }
  void advance_to_now(Particle& particle) const {
    particle.set_pose(particle.pose_at(now_));
    particle.time = now_;
  }

  void load_particles(const Configuration<dimension>& configuration);
  void load_types(const Configuration<dimension>& configuration);
  double mean_free_time() const;
  void predict_all(double horizon, RunCounters& counters);
  void predict(Index i, RunCounters& counters);
  template <Scope scope>
  Entry next_entry(Index i, RunCounters& counters);
  template <Scope scope>
  std::size_t gather(Index i, const Pose<dimension>& mine, double latest, std::size_t next,
                     ScreenBatch& batch);
  void search_earliest_first(Index i, const Pose<dimension>& mine, ScreenBatch& batch, Entry& best,
                             RunCounters& counters) const;
  void search(Index i, const Pose<dimension>& mine, const Neighbor<B>& neighbor, double horizon,
              Entry& best, RunCounters& counters) const;
  void prefetch_events();
  void prefetch_events(Index i, int step) const;
  void process(Index i, RunCounters& counters);
  void leave_neighborhood(Index i);
  void execute_collision(Index i, const Event& event, RunCounters& counters);
  double impact(Index i, Index j, const Vector& d, const Vector& normal, double restitution,
                RunCounters& counters);
  void execute_soft_collision(Index i, const Event& event, RunCounters& counters);
  void soft_impact(Index i, const Image& partner, RunCounters& counters);
  void begin_contact(const UnwrappedPair& pair, const RelativeMotion<dimension>& after, double end);
  void separate_grazing(Index i, Index j, const Vector& change);
  bool try_displace(const UnwrappedPair& pair, const Vector& displacement1,
                    const Vector& displacement2);
  void displace(Index i, const Vector& displacement);
  bool has_clearance(Index i, const UnwrappedPair& pair, const Vector& displacement1,
                     const Vector& displacement2) const;
  void release(Index i);
  void release_early(Index i, Index j, RunCounters& counters);
  void add_close_pair(const UnwrappedPair& pair, double distance);
  bool is_still_close(const UnwrappedPair& pair) const;
  bool is_close_pair(const UnwrappedPair& pair) const;
  void load_contacts(const Configuration<dimension>& configuration);
  void write_contacts(Configuration<dimension>& configuration) const;
  void detect_inelastic_collapse(Index i, Index j, double displacement);
  double overlap_event(Index i, const Vector& d, Event& event) const;
  Event collision(const Image& with, const Vector& normal) const {
    Event event{Event::Type::collision, version_[with.other], with, {}};
    if constexpr (!ContactScreen<B>::is_exact) event.normal.value = normal;
    return event;
  }
  static Vector normal_of(const Event& event, const Vector& d) {
    if constexpr (ContactScreen<B>::is_exact)
      return d.normalized();
    else
      return event.normal.value;
  }
  [[noreturn]] void report_overlap(Index i, Index j) const;
  [[noreturn]] void report_self_overlap(Index i) const;

  EngineOptions options_;
  std::string description_;
  PeriodicBox<dimension> box_;
  std::vector<Index> external_id_;  // particle numbers of the configuration
  std::vector<Shape> shapes_;       // by type, at size 1
  std::vector<ParticleType> types_;
  TypeIndex type_index_;
  std::vector<Particle> particles_;
  std::vector<Rotation> rotations_;  // of spheres, at rotation_time_
  double rotation_time_ = 0;
  std::vector<Shift<dimension>> image_;
  std::vector<Index> version_;  // changes of motion or image so far
  std::optional<Neighborhoods<B>> neighborhoods_;
  Calendar calendar_;
  std::vector<Event> events_;
  std::vector<Release> releases_;  // of soft particles
  std::map<UnwrappedPair, double>
      close_pairs_;                    // minimum distances of soft pairs; some may have separated
  std::size_t close_pairs_limit_ = 0;  // size that triggers a clean-up
  std::vector<std::uint8_t> collapse_count_;  // consecutive collisions without progress
  double contact_gap_ = 0;
  double fastest_ = 0;             // speed of a surface, at the start of the block
  double base_ = 0;                // simulated time at the start of the block
  double now_ = 0;                 // since then
  double horizon_ = never;         // since then
  double collisions_ = 0;          // since then
  std::uint64_t events_left_ = 0;  // until the block ends,
  double longest_block_ = never;   // which it also does after this time
  std::uint64_t prefetched_ = 0;   // upcoming particles already prefetched
  bool predicted_ = false;
};

// ---------------------------------------------------------------------------------------------------

template <Body B>
void Simulation<B>::load(const Configuration<dimension>& configuration, double horizon) {
  box_ = configuration.box;
  base_ = configuration.time;
  now_ = collisions_ = 0;
  horizon_ = horizon - base_;
  load_particles(configuration);
  load_types(configuration);
  if (is_soft()) load_contacts(configuration);
  double extent = 0.5 * box_.lengths().maxCoeff();
  fastest_ = 0;
  std::vector<Pose<dimension>> poses;
  for (Index i = 0; i < particles_.size(); ++i) {
    const Particle& particle = particles_[i];
    const double max_support_rate = shape(i).max_support_rate();
    poses.push_back(particle.pose());
    // Angles are also rounded, which moves the surface by up to max_support_rate times the rounding error.
    extent = std::max({extent, shape(i).circumradius(),
                       max_support_rate * angle_magnitude(particle.orientation())});
    fastest_ =
        std::max(fastest_, particle.velocity.norm() +
                               max_support_rate * spin_magnitude(particle.angular_velocity()));
  }
  for (const Release& release : releases_)
    if (release.time < never) fastest_ = std::max(fastest_, release.velocity.norm());
  contact_gap_ = tolerance::contact_gap(extent);
  // Times are also rounded; within a block nothing moves farther than the coordinates extend.
  longest_block_ = fastest_ > 0 ? extent / fastest_ : never;
  neighborhoods_.emplace(box_, shapes_, type_index_, poses, target_neighbors);
  events_.assign(particles_.size(), {});
  events_left_ = std::max(events_per_particle_and_block * particles_.size(), min_events_per_block);
  predicted_ = false;
}

template <Body B>
void Simulation<B>::load_particles(const Configuration<dimension>& configuration) {
  external_id_ = spatial_order<dimension>(box_, configuration.position);
  particles_.clear();
  rotations_.clear();
  rotation_time_ = 0;
  image_.clear();
  version_.assign(external_id_.size(), 0);
  collapse_count_.assign(external_id_.size(), 0);
  for (const Index k : external_id_) {
    Vector position = configuration.position[k];
    Shift<dimension> image = configuration.image[k];
    box_.wrap(position, image);
    const Rotation rotation{orientation_of(configuration.pose(k)),
                            configuration.angular_velocity[k]};
    const Vector& velocity = configuration.velocity[k];
    if constexpr (rotation_is_separate) {
      particles_.push_back({position, velocity, 0, never, {}});
      rotations_.push_back(rotation);
    } else {
      particles_.push_back({position, velocity, 0, never, rotation});
    }
    image_.push_back(image);
  }
}

template <Body B>
void Simulation<B>::load_types(const Configuration<dimension>& configuration) {
  std::map<std::vector<double>, std::uint32_t> known;
  shapes_.clear();
  types_.clear();
  std::vector<std::uint32_t> type_index;
  for (const Index k : external_id_) {
    const Solid<dimension>& semi_axes = configuration.shape[k];
    const double mass = configuration.mass[k];
    std::vector<double> numbers = semi_axis_values(semi_axes);
    numbers.push_back(mass);
    const auto [place, is_new] = known.try_emplace(std::move(numbers), types_.size());
    type_index.push_back(place->second);
    if (!is_new) continue;
    const auto shape = shape_from<Shape>(semi_axes);
    shapes_.push_back(shape);
    types_.push_back({ShapeCoefficients<Shape>(shape), inertia_of(semi_axes, mass)});
  }
  type_index_ = TypeIndex(std::move(type_index), types_.size());
}

// Predicts all particles, testing every pair once; the predictions are independent of each other.
template <Body B>
void Simulation<B>::predict_all(double horizon, RunCounters& counters) {
  horizon_ = horizon;
  std::mutex adding;
  in_parallel(particles_.size(), options_.threads, [&](std::size_t begin, std::size_t end) {
    RunCounters mine;
    for (auto i = static_cast<Index>(begin); i < end; ++i) {
      const Entry entry = next_entry<Scope::higher_indices>(i, mine);
      events_[i] = entry.event;
      particles_[i].next = entry.time;
    }
    const std::lock_guard lock(adding);
    counters.add_predictions(mine);
  });
  calendar_ = Calendar(particles_.size(), uses_prefetch() ? prefetch_stages * events_per_stage : 1);
  prefetched_ = 0;
  for (Index i = 0; i < particles_.size(); ++i) calendar_.set(i, particles_[i].next);
  predicted_ = true;
}

template <Body B>
typename Simulation<B>::Stop Simulation<B>::advance(double until, RunCounters& counters) {
  if (!predicted_) predict_all(horizon_, counters);
  const double end = until - base_;
  while (events_left_ > 0 && now_ < longest_block_) {
    const auto i = static_cast<Index>(calendar_.earliest());
    const double time = particles_[i].next;
    if (time > end) {
      now_ = std::max(now_, end);
      return Stop::time;
    }
    now_ = time;
    --events_left_;
    ++counters.events;
    particles_[i].next = never;
    if (uses_prefetch()) prefetch_events();
    process(i, counters);
  }
  return Stop::block_end;
}

template <Body B>
void Simulation<B>::prefetch_events() {
  for (; prefetched_ < calendar_.upcoming_count(); ++prefetched_)
    for (std::uint64_t step = 0; step < prefetch_stages && step * events_per_stage <= prefetched_;
         ++step)
      prefetch_events(static_cast<Index>(calendar_.upcoming(prefetched_ - step * events_per_stage)),
                      static_cast<int>(step));
}

// Each stage uses the data that the preceding stage has prefetched.
template <Body B>
void Simulation<B>::prefetch_events(Index i, int step) const {
  const auto prefetch_own = [&](Index k) {
    prefetch_line(&particles_[k]);
    prefetch_line(&events_[k]);
    prefetch_line(&version_[k]);
    calendar_.prefetch(k);
    neighborhoods_->prefetch_list_header(k);
  };
  const auto prefetch_partners = [&](Index k) {
    for (const Image& neighbor : neighborhoods_->of(k)) prefetch_line(&particles_[neighbor.other]);
  };
  if (step == 0) return prefetch_own(i);
  if (step == 1) neighborhoods_->prefetch_list(i);
  if (step == 2) prefetch_partners(i);
  const Event& event = events_[i];
  if (event.type == Event::Type::exit) {
    const Particle& particle = particles_[i];
    if (particle.next == never) return;
    const Vector there = particle.pose_at(particle.next).position;
    if (step == 1) prefetch_line(&image_[i]);
    if (step == 1) neighborhoods_->prefetch_cells(i, there);
    if (step == 2) neighborhoods_->prefetch_references(i, there);
  } else {
    const Index j = event.partner.other;
    if (step == 1) prefetch_own(j);
    if (step == 2) neighborhoods_->prefetch_list(j);
    if (step == 3) prefetch_partners(j);
  }
}

template <Body B>
void Simulation<B>::write(Configuration<dimension>& configuration) const {
  configuration.time = base_ + now_;
  const double size = size_now().size;
  for (Index i = 0; i < particles_.size(); ++i) {
    const Index k = external_id_[i];
    const Particle& particle = particles_[i];
    Pose<dimension> pose = particle.pose_at(now_);
    configuration.angular_velocity[k] = particle.angular_velocity();
    if constexpr (rotation_is_separate) {
      const Rotation rotation = rotation_now(i);
      pose.orientation = rotation.orientation;
      configuration.angular_velocity[k] = rotation.angular_velocity;
    }
    configuration.set_pose(k, pose);
    configuration.image[k] = image_[i];
    box_.wrap(configuration.position[k], configuration.image[k]);
    configuration.velocity[k] = particle.velocity;
    if constexpr (grows<B>) configuration.shape[k] = particle_shape(scaled(shape(i), size));
  }
  if (is_soft()) write_contacts(configuration);
}

template <Body B>
void Simulation<B>::set_velocities(const Configuration<dimension>& configuration, double horizon,
                                   RunCounters& counters) {
  for (Index i = 0; i < particles_.size(); ++i) {
    const Motion<dimension> motion{configuration.velocity[external_id_[i]],
                                   configuration.angular_velocity[external_id_[i]]};
    if constexpr (rotation_is_separate)
      rotations_[i] = {rotation_now(i).orientation, motion.angular_velocity};
    advance_to_now(particles_[i]);
    particles_[i].set_motion(motion);
    fastest_ = std::max(fastest_, motion.velocity.norm());
  }
  rotation_time_ = now_;
  if (is_soft()) load_contacts(configuration);
  predict_all(horizon - base_, counters);
}

template <Body B>
void Simulation<B>::predict(Index i, RunCounters& counters) {
  const Entry entry = next_entry<Scope::all_neighbors>(i, counters);
  events_[i] = entry.event;
  particles_[i].next = entry.time;
  calendar_.set(i, entry.time);
}

template <Body B>
template <typename Simulation<B>::Scope scope>
typename Simulation<B>::Entry Simulation<B>::next_entry(Index i, RunCounters& counters) {
  const Particle& particle = particles_[i];
  const Pose<dimension> mine = particle.pose_at(now_);
  const CommonSize size = size_now();
  Entry best{now_ + neighborhoods_->exit_time(i, mine, particle.motion(), size), {}};
  best.event.type = Event::Type::exit;
  if (is_soft() && releases_[i].time < best.time)
    best = {releases_[i].time, {Event::Type::release, 0, {}, {}}};
  if (best.time > horizon_) best.time = never;

  ScreenBatch batch{
      ContactScreen<B>(type(i).coefficients, mine, particle.motion(), size, contact_gap_)};
  const std::span<Neighbor<B>> neighbors = neighborhoods_->of(i);
  for (std::size_t next = 0; next < neighbors.size();) {
    next = gather<scope>(i, mine, std::min(best.time, horizon_), next, batch);
    batch.screen.evaluate(batch.count);
    counters.predictions += static_cast<std::uint64_t>(batch.count);
    for (int k = 0; k < batch.count; ++k)
      batch.neighbor[k]->warm_start = batch.screen.warm_start(k);
    search_earliest_first(i, mine, batch, best, counters);
  }
  return best;
}

// The mean time between two collisions of a particle in this block, once it is known. A contact that cannot
// occur within this time is not searched yet. The speed-up has a flat maximum around one mean free time
// (bench/engine.md).
template <Body B>
double Simulation<B>::mean_free_time() const {
  const auto particles = static_cast<double>(particles_.size());
  return collisions_ < particles ? never : 0.5 * particles * now_ / collisions_;
}

// Fills the batch starting at neighbour `next`; returns the first neighbour not included.
template <Body B>
template <typename Simulation<B>::Scope scope>
std::size_t Simulation<B>::gather(Index i, const Pose<dimension>& mine, double latest,
                                  std::size_t next, ScreenBatch& batch) {
  constexpr double forever = 1e100;
  const std::span<Neighbor<B>> neighbors = neighborhoods_->of(i);
  int k = 0;
  for (; next < neighbors.size() && k < ContactScreen<B>::lanes; ++next) {
    Neighbor<B>& neighbor = neighbors[next];
    const Index j = neighbor.other;
    if (scope == Scope::higher_indices && j < i) continue;
    const Particle& partner = particles_[j];
    batch.horizon[k] = scope == Scope::all_neighbors ? std::min(latest, partner.next) : latest;
    Pose<dimension> pose = partner.pose_at(now_);
    pose.position += box_.translation(neighbor.shift()) - mine.position;
    batch.screen.set(k, pose, partner.motion(), type(j).coefficients, neighbor.warm_start,
                     std::min(batch.horizon[k] - now_, forever));
    batch.neighbor[k++] = &neighbor;
  }
  batch.count = k;
  return next;
}

template <Body B>
void Simulation<B>::search_earliest_first(Index i, const Pose<dimension>& mine, ScreenBatch& batch,
                                          Entry& best, RunCounters& counters) const {
  for (int done = 0; done < batch.count; ++done) {
    const auto [wait, k] = batch.screen.earliest();
    if (!(now_ + wait < best.time)) return;
    const Neighbor<B>& neighbor = *batch.neighbor[k];
    if (ContactScreen<B>::is_exact && wait > 0)
      best = {now_ + wait, collision(neighbor, Vector::Zero())};
    else if (wait > mean_free_time())
      best = {now_ + wait, {}};  // predict again then
    else
      search(i, mine, neighbor, std::min(batch.horizon[k], best.time), best, counters);
    batch.screen.discard(k);
  }
}

// Replaces the best entry by the first contact with this neighbour, if that is earlier than the horizon.
template <Body B>
void Simulation<B>::search(Index i, const Pose<dimension>& mine, const Neighbor<B>& neighbor,
                           double horizon, Entry& best, RunCounters& counters) const {
  const Index j = neighbor.other;
  const auto flight = [&](Index k, const Pose<dimension>& pose) {
    return Flight<B>{body_from<B>(shape(k), size_now()), pose, particles_[k].motion()};
  };
  Pose<dimension> theirs = particles_[j].pose_at(now_);
  theirs.position += box_.translation(neighbor.shift());
  const Prediction<dimension> contact = first_contact(
      flight(i, mine), flight(j, theirs), horizon - now_, contact_gap_, neighbor.warm_start);
  ++counters.searches;
  counters.steps += static_cast<std::uint64_t>(contact.steps);
  if (contact.outcome == Outcome::none) return;
  Event event = collision(neighbor, contact.normal);
  double wait = contact.time;
  if (contact.outcome == Outcome::not_converged) event.type = Event::Type::repredict;
  if (contact.outcome == Outcome::overlap)
    wait = overlap_event(i, theirs.position - mine.position, event);
  if (now_ + wait < best.time) best = {now_ + wait, event};
}

// An overlapping pair: stop, or schedule the correction move; once the centres recede, only check again. A soft
// pair that a third particle has rotated back collides again.
template <Body B>
double Simulation<B>::overlap_event(Index i, const Vector& d, Event& event) const {
  const Index j = event.partner.other;
  if (is_soft() && is_close_pair(unwrapped_pair(i, event.partner))) return 0;
  if (options_.on_overlap == OnOverlap::stop) report_overlap(i, j);
  const Vector relative = particles_[j].velocity - particles_[i].velocity;
  const bool receding = d.dot(relative) > 0;
  event.type = receding ? Event::Type::repredict : Event::Type::correction;
  constexpr double watch = 0.05;  // of the time in which they move by their own width
  return receding ? watch * (shape(i).inradius() + shape(j).inradius()) / relative.norm() : 0;
}

template <Body B>
void Simulation<B>::process(Index i, RunCounters& counters) {
  const Event event = events_[i];
  switch (event.type) {
    case Event::Type::exit:
      leave_neighborhood(i);
      ++counters.list_updates;
      predict(i, counters);
      return;
    case Event::Type::repredict:
      predict(i, counters);
      return;
    case Event::Type::release:
      release(i);
      predict(i, counters);
      return;
    case Event::Type::collision:
    case Event::Type::correction:
      if (version_[event.partner.other] == event.partner_version)
        execute_collision(i, event, counters);
      else
        predict(i, counters);
      return;
  }
}

template <Body B>
void Simulation<B>::leave_neighborhood(Index i) {
  Particle& particle = particles_[i];
  advance_to_now(particle);
  const Shift<dimension> image = image_[i];
  box_.wrap(particle.position, image_[i]);
  // Collisions scheduled with its old image are stale.
  if (image_[i] != image) ++version_[i];
  neighborhoods_->update(i, particle.pose(), size_now().size);
}

template <Body B>
void Simulation<B>::execute_collision(Index i, const Event& event, RunCounters& counters) {
  if (is_soft()) return execute_soft_collision(i, event, counters);
  const Index j = event.partner.other;
  Particle& one = particles_[i];
  Particle& two = particles_[j];
  const double since = now_ - std::max(one.time, two.time);
  advance_to_now(one);
  advance_to_now(two);
  const Vector d = two.position + box_.translation(event.partner.shift()) - one.position;
  if (event.type == Event::Type::correction) {
    Motion<dimension> motion1 = one.motion(), motion2 = two.motion();
    separate(motion1, type(i).inertia, motion2, type(j).inertia, d);
    one.set_motion(motion1);
    two.set_motion(motion2);
    ++counters.correction_moves;
  } else {
    const Vector normal = normal_of(event, d);
    const double speed = impact(i, j, d, normal, options_.restitution, counters);
    if (options_.restitution < 1) detect_inelastic_collapse(i, j, speed * since);
    neighborhoods_->store_axis(i, event.partner, normal);
  }
  ++version_[i];
  if (i != j) ++version_[j];
  one.next = two.next = never;  // both entries are invalid
  predict(i, counters);
  if (i != j) predict(j, counters);
}

// Applies an instantaneous collision. Returns the approach speed of the surfaces.
template <Body B>
double Simulation<B>::impact(Index i, Index j, const Vector& d, const Vector& n, double restitution,
                             RunCounters& counters) {
  const CommonSize size = size_now();
  const auto arm = [&](Index k, const Vector& outward) {
    return surface_point(scaled(shape(k), size.size), particles_[k].pose(), outward);
  };
  const Vector arm1 = arm(i, n), arm2 = arm(j, -n);
  const double growth = size.growth_rate / size.size * (arm1 - arm2).dot(n);
  const ContactGeometry<dimension> contact{n, cross(arm1, n), cross(arm2, n), growth};
  Motion<dimension> motion1 = particles_[i].motion(), motion2 = particles_[j].motion();
  const double speed = approach_speed(motion1, motion2, contact);
  const double impulse =
      i == j ? collide_with_own_image(motion1, inertia_now(i), contact, restitution)
             : collide(motion1, inertia_now(i), motion2, inertia_now(j), contact, restitution);
  if (!std::isfinite(impulse)) report_self_overlap(i);
  particles_[i].set_motion(motion1);
  if (i != j) particles_[j].set_motion(motion2);
  ++collisions_;
  ++counters.collisions;
  counters.virial += impulse * n.dot(d);
  counters.dissipated += 0.5 * impulse * speed * (1 - restitution);
  return speed;
}

// Inelastic collapse: infinitely many collisions of a few particles in a finite time; or of one pair, like a
// bouncing ball, whose rotation brings the surfaces together again. The criterion: the distances travelled
// between collisions stay below the contact gap several times in a row.
template <Body B>
void Simulation<B>::detect_inelastic_collapse(Index i, Index j, double displacement) {
  constexpr int max_count = 10;
  for (const Index k : {i, j})
    collapse_count_[k] =
        std::abs(displacement) < contact_gap_ ? std::min(collapse_count_[k] + 1, max_count) : 0;
  if (std::min(collapse_count_[i], collapse_count_[j]) < max_count) return;
  throw InvariantError(
      "inelastic collapse at time " + std::to_string(base_ + now_) + ": particles " +
      std::to_string(external_id_[i]) + " and " + std::to_string(external_id_[j]) +
      " collide repeatedly without moving; use a coefficient of restitution closer to 1 "
      "or a shorter run");
}

template <Body B>
void Simulation<B>::report_overlap(Index i, Index j) const {
  throw InvariantError("particles " + std::to_string(external_id_[i]) + " and " +
                       std::to_string(external_id_[j]) + " overlap at time " +
                       std::to_string(base_ + now_) +
                       ": a run must start from a state without overlaps, and keeps it");
}

template <Body B>
void Simulation<B>::report_self_overlap(Index i) const {
  throw InvariantError("particle " + std::to_string(external_id_[i]) +
                       " grew into its own image at time " + std::to_string(base_ + now_) +
                       ": the box is too short for it");
}

}  // namespace vitrel

#include "edmd/soft_events.h"
