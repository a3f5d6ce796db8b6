#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/neighbors/neighborhood.h"
#include "core/tolerances.h"
#include "edmd/calendar.h"
#include "edmd/collision_rule.h"
#include "edmd/engine.h"

namespace vitrel {

/// The event loop, written once for every body.
///
/// Each particle has one entry in the calendar: the earliest of its contacts with its neighbours
/// and of the time at which it leaves its neighbourhood. Only that particle's own entry is ever
/// changed by a prediction. For every pair of neighbours (i, j) the earlier of the two entries is
/// no later than their first contact: a prediction for i therefore never looks past the best event
/// already known for i or for j. An entry whose partner has meanwhile changed its motion is stale;
/// when it comes to the top the particle is predicted anew.
///
/// Times are relative to the start of the block, and every particle has its own clock.
template <Body B>
class Simulation final : public Engine {
 public:
  Simulation(const EngineOptions& options, std::string description)
      : options_(options), description_(std::move(description)) {}

  void load(const Configuration2& configuration) override;
  Stop advance(double until, RunCounters& counters) override;
  void write(Configuration2& configuration) const override;
  void set_velocities(const Configuration2& configuration, RunCounters& counters) override;
  std::string description() const override { return description_; }

 private:
  using Index = std::uint32_t;

  /// Mean neighbours per particle. Fewer mean fewer predictions but more renewals of lists; the cost of
  /// a collision is flat around this number.
  static constexpr double wanted_neighbors = 7;
  static constexpr std::uint64_t events_per_particle_and_block = 32;
  static constexpr std::uint64_t least_events_per_block = 4096;

  struct Particle {
    Pose2 pose;  // at `time`
    Motion2 motion;
    double time = 0;
    Inertia inertia;
    Shift<2> image;
    Index version = 0;  // counts the changes of its motion
  };

  enum class Kind : std::uint8_t { collision, correction, exit, look_again };
  struct Event {
    Kind kind = Kind::look_again;
    Index partner = 0;
    Index partner_version = 0;
    Shift<2> shift = Shift<2>::Zero();
  };

  Pose2 pose_now(const Particle& particle) const {
    return advanced(particle.pose, particle.motion, now_ - particle.time);
  }
  void bring_to_now(Particle& particle) const {
    particle.pose = pose_now(particle);
    particle.time = now_;
  }
  Flight<B> flight_now(Index i) const {
    return {bodies_[i], pose_now(particles_[i]), particles_[i].motion};
  }

  void predict_all(RunCounters& counters);
  void predict(Index i, std::optional<Index> without_entry, RunCounters& counters);
  void process(Index i, RunCounters& counters);
  void leave_neighborhood(Index i);
  void meet(Index i, const Event& event, RunCounters& counters);
  void impact(Index i, Index j, const Vec2& d, const SupportGap& gap, RunCounters& counters);
  double overlap_event(Index i, Index j, const Vec2& d, Event& event) const;
  [[noreturn]] void report_overlap(Index i, Index j) const;

  EngineOptions options_;
  std::string description_;
  PeriodicBox<2> box_;
  std::vector<B> bodies_;
  std::vector<Particle> particles_;
  std::optional<Neighborhoods<B>> neighborhoods_;
  Calendar calendar_;
  std::vector<Event> events_;
  double contact_gap_ = 0;
  double base_ = 0;  // simulated time at the start of the block
  double now_ = 0;   // since then
  std::uint64_t events_left_ = 0;
  bool predicted_ = false;
};

/// The body of type B for the semi-axes in a configuration.
template <Body B>
B body_from(const Ellipse& shape);

// ---------------------------------------------------------------------------------------------------

template <Body B>
void Simulation<B>::load(const Configuration2& configuration) {
  const std::size_t n = configuration.size();
  box_ = configuration.box;
  base_ = configuration.time;
  now_ = 0;
  bodies_.resize(n);
  particles_.assign(n, {});
  events_.assign(n, {});
  std::vector<Pose2> poses(n);
  double extent = 0.5 * box_.lengths().maxCoeff();
  for (std::size_t i = 0; i < n; ++i) {
    bodies_[i] = body_from<B>(configuration.shape[i]);
    Particle& particle = particles_[i];
    particle.image = configuration.image[i];
    particle.pose = configuration.pose(i);
    box_.wrap(particle.pose.position, particle.image);
    particle.motion = {configuration.velocity[i], configuration.angular_velocity[i]};
    particle.inertia.inverse_mass = 1 / configuration.mass[i];
    if (!configuration.shape[i].is_round())
      particle.inertia.inverse_moment = 1 / configuration.inertia(i);
    poses[i] = particle.pose;
    // An angle is rounded too, and moves the surface by up to `swing` times its rounding.
    extent = std::max(extent, bodies_[i].swing() * std::abs(particle.pose.angle));
  }
  contact_gap_ = tolerance::contact_gap(extent);
  neighborhoods_.emplace(box_, bodies_, poses, wanted_neighbors);
  events_left_ = std::max(events_per_particle_and_block * n, least_events_per_block);
  predicted_ = false;
}

template <Body B>
void Simulation<B>::predict_all(RunCounters& counters) {
  calendar_ = Calendar(particles_.size());
  for (Index i = 0; i < particles_.size(); ++i) predict(i, std::nullopt, counters);
  predicted_ = true;
}

template <Body B>
Engine::Stop Simulation<B>::advance(double until, RunCounters& counters) {
  if (!predicted_) predict_all(counters);
  const double end = until - base_;
  while (events_left_ > 0) {
    const auto i = static_cast<Index>(calendar_.earliest());
    if (calendar_.time(i) > end) {
      now_ = std::max(now_, end);
      return Stop::time;
    }
    now_ = calendar_.time(i);
    --events_left_;
    ++counters.events;
    process(i, counters);
  }
  return Stop::block_end;
}

template <Body B>
void Simulation<B>::write(Configuration2& configuration) const {
  configuration.time = base_ + now_;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const Pose2 pose = pose_now(particles_[i]);
    configuration.position[i] = pose.position;
    configuration.image[i] = particles_[i].image;
    box_.wrap(configuration.position[i], configuration.image[i]);
    configuration.angle[i] = pose.angle;
    configuration.velocity[i] = particles_[i].motion.velocity;
    configuration.angular_velocity[i] = particles_[i].motion.angular_velocity;
  }
}

template <Body B>
void Simulation<B>::set_velocities(const Configuration2& configuration, RunCounters& counters) {
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    bring_to_now(particles_[i]);
    particles_[i].motion = {configuration.velocity[i], configuration.angular_velocity[i]};
  }
  predict_all(counters);
}

template <Body B>
void Simulation<B>::predict(Index i, std::optional<Index> without_entry, RunCounters& counters) {
  const Flight<B> mine = flight_now(i);
  Event best{Kind::exit, i, 0, Shift<2>::Zero()};
  double best_time = now_ + neighborhoods_->exit_time(i, mine.pose, mine.motion);
  for (const auto& neighbor : neighborhoods_->of(i)) {
    const Index j = neighbor.other;
    Flight<B> other = flight_now(j);
    other.pose.position += box_.translation(neighbor.shift);
    const bool entry_counts = j != i && without_entry != j;
    const double horizon = entry_counts ? std::min(best_time, calendar_.time(j)) : best_time;
    const Prediction touch = first_contact(mine, other, horizon - now_, contact_gap_);
    ++counters.predictions;
    counters.steps += static_cast<std::uint64_t>(touch.steps);
    if (touch.outcome == Outcome::none) continue;
    Event event{Kind::collision, j, particles_[j].version, neighbor.shift};
    double wait = touch.time;
    if (touch.outcome == Outcome::not_converged) event.kind = Kind::look_again;
    if (touch.outcome == Outcome::overlap)
      wait = overlap_event(i, j, other.pose.position - mine.pose.position, event);
    if (now_ + wait >= best_time) continue;
    best_time = now_ + wait;
    best = event;
  }
  events_[i] = best;
  calendar_.set(i, best_time);
}

// A pair that overlaps: stop, or plan the correction move; once its centres recede it is only
// watched.
template <Body B>
double Simulation<B>::overlap_event(Index i, Index j, const Vec2& d, Event& event) const {
  if (options_.on_overlap == OnOverlap::stop) report_overlap(i, j);
  const Vec2 relative = particles_[j].motion.velocity - particles_[i].motion.velocity;
  const bool receding = d.dot(relative) > 0;
  event.kind = receding ? Kind::look_again : Kind::correction;
  constexpr double watch = 0.05;  // of the time in which they move by their own width
  return receding ? watch * (bodies_[i].inradius() + bodies_[j].inradius()) / relative.norm() : 0;
}

template <Body B>
void Simulation<B>::process(Index i, RunCounters& counters) {
  const Event event = events_[i];
  switch (event.kind) {
    case Kind::exit:
      leave_neighborhood(i);
      ++counters.renewals;
      predict(i, std::nullopt, counters);
      return;
    case Kind::look_again:
      predict(i, std::nullopt, counters);
      return;
    case Kind::collision:
    case Kind::correction:
      if (particles_[event.partner].version == event.partner_version)
        meet(i, event, counters);
      else
        predict(i, std::nullopt, counters);
      return;
  }
}

template <Body B>
void Simulation<B>::leave_neighborhood(Index i) {
  Particle& particle = particles_[i];
  bring_to_now(particle);
  box_.wrap(particle.pose.position, particle.image);
  neighborhoods_->renew(i, particle.pose);
}

template <Body B>
void Simulation<B>::meet(Index i, const Event& event, RunCounters& counters) {
  const Index j = event.partner;
  Particle& one = particles_[i];
  Particle& two = particles_[j];
  bring_to_now(one);
  bring_to_now(two);
  const Vec2 d = two.pose.position + box_.translation(event.shift) - one.pose.position;
  if (event.kind == Kind::correction) {
    separate(one.motion, one.inertia, two.motion, two.inertia, d);
    ++counters.correction_moves;
  } else {
    impact(i, j, d, support_gap(bodies_[i], one.pose, bodies_[j], two.pose, d), counters);
  }
  ++one.version;
  if (i != j) ++two.version;
  predict(i, j, counters);
  if (i != j) predict(j, std::nullopt, counters);
}

template <Body B>
void Simulation<B>::impact(Index i, Index j, const Vec2& d, const SupportGap& gap,
                           RunCounters& counters) {
  Particle& one = particles_[i];
  Particle& two = particles_[j];
  const Vec2& n = gap.normal;
  const Vec2 arm1 = surface_point(bodies_[i], one.pose, n);
  const Vec2 arm2 = surface_point(bodies_[j], two.pose, -n);
  const ContactGeometry contact{n, cross(arm1, n), cross(arm2, n)};
  const double speed = approach_speed(one.motion, two.motion, contact);
  const double impulse =
      i == j ? collide_with_own_image(one.motion, one.inertia, contact, options_.restitution)
             : collide(one.motion, one.inertia, two.motion, two.inertia, contact,
                       options_.restitution);
  ++counters.collisions;
  counters.virial += impulse * n.dot(d);
  counters.dissipated += 0.5 * impulse * speed * (1 - options_.restitution);
}

template <Body B>
void Simulation<B>::report_overlap(Index i, Index j) const {
  throw InvariantError("particles " + std::to_string(i) + " and " + std::to_string(j) +
                       " overlap at time " + std::to_string(base_ + now_) +
                       ": a hard run must start from, and keeps, a state without overlaps");
}

}  // namespace vitrel
