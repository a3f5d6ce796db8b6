#include "bench/baselines/all_pairs.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bench/baselines/unchecked_method.h"
#include "core/contact/first_contact.h"
#include "core/error.h"
#include "core/geometry/free_flight.h"
#include "core/tolerances.h"
#include "edmd/collision_rule.h"

namespace vitrel::bench {
namespace {

class AllPairs final : public Engine2 {
 public:
  explicit AllPairs(const AllPairsOptions& options) : options_(options) {}

  void load(const Configuration2& configuration, double horizon) override;
  Stop advance(double until, RunCounters& counters) override;
  void write(Configuration2& configuration) const override;
  void set_velocities(const Configuration2& configuration, double horizon,
                      RunCounters& counters) override;
  std::string description() const override;

 private:
  static constexpr std::uint64_t events_per_block = 4096;

  struct Particle {
    Ellipse shape;
    Pose2 pose;  // at `time`; not wrapped since the start of the block
    Motion2 motion;
    double time = 0;
    Inertia<2> inertia;
    Shift<2> image;
  };
  enum class Kind : std::uint8_t { contact, correction, look_again };
  struct Event {
    std::size_t i = 0, j = 0;
    double time = never;
    Kind kind = Kind::look_again;
    Shift<2> shift = Shift<2>::Zero();  // of particle j
    Vec2 normal = Vec2::Zero();         // of a contact, from i to j
    Vec2 point = Vec2::Zero();
  };

  std::size_t index(std::size_t i, std::size_t j) const {
    return std::min(i, j) * particles_.size() + std::max(i, j);
  }
  Pose2 pose_now(const Particle& particle) const {
    return advanced(particle.pose, particle.motion, now_ - particle.time);
  }
  void check_box() const;
  void set_longest_screen();
  double image_lasts(std::size_t i, std::size_t j, const Vec2& d) const;
  double time_to_part(std::size_t i, std::size_t j) const;
  Prediction2 predict(std::size_t i, std::size_t j, const Pose2& pose2, double horizon) const;
  Event ask(std::size_t i, std::size_t j, double horizon, RunCounters& counters) const;
  Event overlap_event(std::size_t i, std::size_t j, const Vec2& d, Event event) const;
  [[noreturn]] void report_overlap(std::size_t i, std::size_t j) const;

  Event earliest_of_all(double end, RunCounters& counters) const;
  Event earliest_in_table() const;
  void ask_for_table(std::size_t i, std::size_t j, RunCounters& counters);
  void ask_all_for_table(RunCounters& counters);
  void process(const Event& event, RunCounters& counters);
  void impact(const Event& event, const Vec2& d, RunCounters& counters);

  AllPairsOptions options_;
  PeriodicBox<2> box_;
  std::vector<Particle> particles_;
  std::vector<double> met_;   // time of the last impact or correction of a pair i < j
  std::vector<double> time_;  // the table for pairs i < j: the time of the next event …
  std::vector<Event> event_;  // … and the event
  double contact_gap_ = 0;
  double longest_screen_ = 0;
  double horizon_ = never;  // time since the start of the block
  double base_ = 0;         // simulated time at the start of the block
  double now_ = 0;          // time since the start of the block
  std::uint64_t events_left_ = 0;
  bool asked_ = false;
};

void AllPairs::load(const Configuration2& configuration, double horizon) {
  if (options_.engine.growth_rate != 0)
    throw UserError(
        "the engine of all pairs keeps the size of its particles: growth_rate must be 0");
  const std::size_t n = configuration.size();
  box_ = configuration.box;
  base_ = configuration.time;
  now_ = 0;
  horizon_ = horizon - base_;
  particles_.assign(n, {});
  double extent = 0.5 * box_.lengths().maxCoeff();
  for (std::size_t i = 0; i < n; ++i) {
    Particle& particle = particles_[i];
    particle.shape = configuration.shape[i];
    particle.pose = configuration.pose(i);
    particle.image = configuration.image[i];
    box_.wrap(particle.pose.position, particle.image);
    particle.motion = {configuration.velocity[i], configuration.angular_velocity[i]};
    particle.inertia.inverse_mass = 1 / configuration.mass[i];
    if (!particle.shape.is_round()) particle.inertia.inverse_moment = 1 / configuration.inertia(i);
    extent = std::max(extent, particle.shape.max_support_rate() * std::abs(particle.pose.angle));
  }
  check_box();
  contact_gap_ = tolerance::contact_gap(extent);
  set_longest_screen();
  met_.assign(n * n, -never);
  time_.assign(n * n, never);
  event_.assign(n * n, {});
  events_left_ = events_per_block;
  asked_ = false;
}

void AllPairs::check_box() const {
  double largest = 0;
  for (const Particle& particle : particles_) largest = std::max(largest, particle.shape.a);
  if (!(box_.lengths().minCoeff() > 4 * largest))
    throw UserError("the engine of all pairs asks about one image of each: a side of the box, " +
                    std::to_string(box_.lengths().minCoeff()) +
                    ", must be longer than two particles, " + std::to_string(4 * largest));
}

// In this time a typical particle crosses the box, or its tip moves as far. The limit is needed because particles may
// only spin.
void AllPairs::set_longest_screen() {
  double square = 0;
  for (const Particle& particle : particles_) {
    const double tip = particle.shape.a * particle.motion.angular_velocity;
    square += particle.motion.velocity.squaredNorm() + tip * tip;
  }
  const double speed = std::sqrt(square / static_cast<double>(particles_.size()));
  longest_screen_ = box_.lengths().maxCoeff() / (speed > 0 ? speed : 1);
}

// The time for which only the image that is nearest now, at the separation d, needs to be considered. In a direction
// k in which |d_k| < L_k − R, the other images are farther away than R.
double AllPairs::image_lasts(std::size_t i, std::size_t j, const Vec2& d) const {
  const double reach = particles_[i].shape.a + particles_[j].shape.a;
  const Vec2 v = particles_[j].motion.velocity - particles_[i].motion.velocity;
  double time = std::min(longest_screen_, horizon_ - now_);
  for (int k = 0; k < 2; ++k)
    if (v[k] != 0)
      time = std::min(
          time, (box_.lengths()[k] - reach - std::copysign(1.0, v[k]) * d[k]) / std::abs(v[k]));
  return time;
}

double AllPairs::time_to_part(std::size_t i, std::size_t j) const {
  constexpr double part = 0.05;  // fraction of their width
  const Particle& one = particles_[i];
  const Particle& two = particles_[j];
  const double speed = (two.motion.velocity - one.motion.velocity).norm() +
                       one.shape.a * std::abs(one.motion.angular_velocity) +
                       two.shape.a * std::abs(two.motion.angular_velocity);
  return speed > 0 ? part * (one.shape.b + two.shape.b) / speed : longest_screen_;
}

Prediction2 AllPairs::predict(std::size_t i, std::size_t j, const Pose2& pose2,
                              double horizon) const {
  const Particle& one = particles_[i];
  const Particle& two = particles_[j];
  const Flight<Ellipse> mine{one.shape, pose_now(one), one.motion};
  const Flight<Ellipse> other{two.shape, pose2, two.motion};
  const bool are_round = one.shape.is_round() && two.shape.is_round();
  if (are_round || !options_.method) return first_contact(mine, other, horizon, contact_gap_);
  return unchecked_answer(*options_.method,
                          {of_constant_size(mine), of_constant_size(other), horizon});
}

// Predicts the next event of a pair, as far as it can be known, but no later than now + horizon.
AllPairs::Event AllPairs::ask(std::size_t i, std::size_t j, double horizon,
                              RunCounters& counters) const {
  const Vec2 here = pose_now(particles_[i]).position;
  Pose2 pose2 = pose_now(particles_[j]);
  Event event{i, j, never, Kind::look_again, box_.nearest_shift(pose2.position - here)};
  pose2.position += box_.translation(event.shift);
  const Vec2 d = pose2.position - here;
  const double lasts = image_lasts(i, j, d);
  const Prediction2 answer = predict(i, j, pose2, std::min(lasts, horizon));
  ++counters.predictions;
  counters.steps += static_cast<std::uint64_t>(answer.steps);
  event.time = now_ + lasts;
  switch (answer.outcome) {
    case Outcome::contact:
      event.kind = Kind::contact;
      event.time = now_ + answer.time;
      event.normal = answer.normal;
      event.point = answer.point;
      break;
    case Outcome::none:
      break;
    case Outcome::not_converged:
      event.time = now_ + (answer.time > 0 ? answer.time : time_to_part(i, j));
      break;
    case Outcome::overlap:
      return overlap_event(i, j, d, event);
  }
  return event;
}

AllPairs::Event AllPairs::overlap_event(std::size_t i, std::size_t j, const Vec2& d,
                                        Event event) const {
  if (options_.engine.on_overlap == OnOverlap::stop) report_overlap(i, j);
  const Vec2 v = particles_[j].motion.velocity - particles_[i].motion.velocity;
  const double interval = time_to_part(i, j);
  const double since = now_ - met_[index(i, j)];
  // The factor allows for rounding: the remaining time could be too short to advance the clock.
  const bool is_early = since < 0.999 * interval;
  const bool recede = d.dot(v) > 0;
  if (!recede && !is_early) event.kind = Kind::correction;
  event.time = now_;
  if (event.kind != Kind::correction) event.time += is_early ? interval - since : interval;
  return event;
}

AllPairs::Event AllPairs::earliest_of_all(double end, RunCounters& counters) const {
  Event best;
  best.time = end;
  for (std::size_t i = 0; i < particles_.size(); ++i)
    for (std::size_t j = i + 1; j < particles_.size(); ++j) {
      const Event event = ask(i, j, best.time - now_, counters);
      if (event.time < best.time) best = event;
    }
  return best;
}

AllPairs::Event AllPairs::earliest_in_table() const {
  const auto least = std::ranges::min_element(time_);
  return event_[static_cast<std::size_t>(least - time_.begin())];
}

void AllPairs::ask_for_table(std::size_t i, std::size_t j, RunCounters& counters) {
  const std::size_t at = index(i, j);
  event_[at] = ask(std::min(i, j), std::max(i, j), never, counters);
  time_[at] = event_[at].time;
}

void AllPairs::ask_all_for_table(RunCounters& counters) {
  for (std::size_t i = 0; i < particles_.size(); ++i)
    for (std::size_t j = i + 1; j < particles_.size(); ++j) ask_for_table(i, j, counters);
  asked_ = true;
}

Engine2::Stop AllPairs::advance(double until, RunCounters& counters) {
  const bool has_table = options_.asking == Asking::changed_pairs;
  if (has_table && !asked_) ask_all_for_table(counters);
  const double end = until - base_;
  for (; events_left_ > 0; --events_left_) {
    const Event event = has_table ? earliest_in_table() : earliest_of_all(end, counters);
    if (!(event.time < end)) {
      now_ = std::max(now_, end);
      return Stop::time;
    }
    now_ = event.time;
    ++counters.events;
    process(event, counters);
  }
  return Stop::block_end;
}

void AllPairs::process(const Event& event, RunCounters& counters) {
  const bool has_table = options_.asking == Asking::changed_pairs;
  if (event.kind == Kind::look_again) {
    if (has_table) ask_for_table(event.i, event.j, counters);
    return;
  }
  Particle& one = particles_[event.i];
  Particle& two = particles_[event.j];
  for (Particle* particle : {&one, &two}) {
    particle->pose = pose_now(*particle);
    particle->time = now_;
  }
  const Vec2 d = two.pose.position + box_.translation(event.shift) - one.pose.position;
  if (event.kind == Kind::correction) {
    separate(one.motion, one.inertia, two.motion, two.inertia, d);
    ++counters.correction_moves;
  } else {
    impact(event, d, counters);
  }
  met_[index(event.i, event.j)] = now_;
  if (!has_table) return;
  for (std::size_t k = 0; k < particles_.size(); ++k)
    for (const std::size_t changed : {event.i, event.j})
      if (k != changed && !(changed == event.j && k == event.i))
        ask_for_table(changed, k, counters);
}

// Computes the impact as in the thesis, at the point and along the normal that the method has found.
void AllPairs::impact(const Event& event, const Vec2& d, RunCounters& counters) {
  Particle& one = particles_[event.i];
  Particle& two = particles_[event.j];
  const Vec2& n = event.normal;
  const Vec2 arm1 = event.point - one.pose.position;
  const ContactGeometry<2> contact{n, cross(arm1, n), cross(arm1 - d, n)};
  const double restitution = options_.engine.laws.common().restitution(0);
  const auto [speed, impulse] =
      collide(one.motion, one.inertia, two.motion, two.inertia, contact, restitution);
  ++counters.collisions;
  counters.virial += impulse * n.dot(d);
  counters.dissipated += 0.5 * impulse * speed * (1 - restitution);
}

void AllPairs::write(Configuration2& configuration) const {
  configuration.time = base_ + now_;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const Particle& particle = particles_[i];
    const Pose2 pose = pose_now(particle);
    configuration.position[i] = pose.position;
    configuration.image[i] = particle.image;
    box_.wrap(configuration.position[i], configuration.image[i]);
    configuration.angle[i] = pose.angle;
    configuration.velocity[i] = particle.motion.velocity;
    configuration.angular_velocity[i] = particle.motion.angular_velocity;
  }
}

void AllPairs::set_velocities(const Configuration2& configuration, double horizon,
                              RunCounters& counters) {
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    Particle& particle = particles_[i];
    particle.pose = pose_now(particle);
    particle.time = now_;
    particle.motion = {configuration.velocity[i], configuration.angular_velocity[i]};
  }
  horizon_ = horizon - base_;
  set_longest_screen();
  if (options_.asking == Asking::changed_pairs) ask_all_for_table(counters);
}

std::string AllPairs::description() const {
  return std::string("all pairs, ") +
         (options_.asking == Asking::every_pair ? "each asked after every event"
                                                : "with a table of their next events") +
         ", collisions by " + (options_.method ? options_.method->name : "the default method");
}

void AllPairs::report_overlap(std::size_t i, std::size_t j) const {
  throw InvariantError("particles " + std::to_string(i) + " and " + std::to_string(j) +
                       " overlap at time " + std::to_string(base_ + now_) +
                       ": a hard run must start from, and keeps, a state without overlaps");
}

}  // namespace

std::unique_ptr<Engine2> make_all_pairs_engine(const AllPairsOptions& options) {
  return std::make_unique<AllPairs>(options);
}

}  // namespace vitrel::bench
