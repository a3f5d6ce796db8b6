#pragma once

#include <algorithm>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "edmd/calendar.h"
#include "edmd/collision_executor.h"
#include "edmd/contact_predictor.h"
#include "edmd/engine.h"
#include "edmd/event_prefetcher.h"
#include "edmd/round_contact_predictor.h"
#include "edmd/soft_contacts.h"
#include "edmd/state_transfer.h"
#include "edmd/time_text.h"

namespace vitrel {

/// The event loop, written once for all bodies. It takes the next particle from the calendar (calendar.h), executes its
/// event (collision_executor.h, soft_contacts.h), and predicts the next events of the particles that changed
/// (contact_predictor.h).
///
/// Each particle has one entry in the calendar: the earliest of its contacts with its neighbours, its exit from its
/// neighbourhood, and its release from a soft contact. A prediction changes only the entry of its own particle.
template <Body B>
class Simulation final : public Engine<B::dimension> {
  static constexpr int dimension = B::dimension;
  using State = SimulationState<B>;
  using Index = typename State::Index;
  using EventType = typename Event<B>::Type;

 public:
  Simulation(const EngineOptions& options, std::string description)
      : options_(options), description_(std::move(description)) {
    state_.growth_rate = options_.growth_rate;
  }
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  using Engine<B::dimension>::never;
  using Stop = typename Engine<B::dimension>::Stop;

  void load(const Configuration<dimension>& configuration, double horizon) override;
  Stop advance(double until, RunCounters& counters) override;
  void write(Configuration<dimension>& configuration) const override;
  void set_velocities(const Configuration<dimension>& configuration, double horizon,
                      RunCounters& counters) override;
  std::string description() const override { return description_; }

 private:
  /// Mean number of neighbours per particle. A smaller number means fewer predictions but more list updates; the cost
  /// of a collision is flat around this number.
  static constexpr double target_neighbors = dimension == 2 ? 7 : 14;
  static constexpr std::uint64_t events_per_particle_and_block = 128;
  static constexpr std::uint64_t min_events_per_block = 4096;

  void predict_all(double horizon, RunCounters& counters);
  void schedule(const std::vector<double>& times);
  void reset_clocks();
  void predict(Index i, RunCounters& counters);
  void predict(Index i, const TimedEvent<B>& known, std::span<Neighbor<B>> neighbors,
               RunCounters& counters);
  struct Next {
    double time;         // time of the next event of the particle
    double known_until;  // time up to which its contacts are known
  };
  template <PredictionScope scope>
  Next next_event(Index i, TimedEvent<B> known, std::span<Neighbor<B>> neighbors,
                  RunCounters& counters);
  void process(Index i, RunCounters& counters);
  void process_exit(Index i, RunCounters& counters);
  void execute_contact(Index i, const Event<B>& event, RunCounters& counters);
  [[noreturn]] void report_overlap(Index i, Index j) const;

  EngineOptions options_;
  std::string description_;
  State state_;
  ContactPredictor<B> predictor_{state_, options_.on_overlap};
  CollisionExecutor<B> executor_{state_, options_};
  SoftContactPolicy<B> soft_{state_, options_};
  Calendar calendar_;
  LargeVector<Event<B>> events_;
  EventPrefetcher<B> prefetcher_{state_, calendar_, events_};
  double horizon_ = never;         // events later than this are not predicted
  std::uint64_t events_left_ = 0;  // events until the block ends
  // When the clocks reach this time they are reset, or, if the bodies grow, the block ends.
  double longest_time_ = never;
  bool predicted_ = false;
};

// ---------------------------------------------------------------------------------------------------

template <Body B>
void Simulation<B>::load(const Configuration<dimension>& configuration, double horizon) {
  state_.load(configuration, options_.neighbors.value_or(NeighborSearch::lists), target_neighbors);
  soft_.load(configuration);
  executor_.begin_block();
  horizon_ = horizon - state_.base;
  // Times are rounded as well as positions: until the clocks are reset, nothing moves farther than the extent.
  longest_time_ = state_.fastest > 0 ? state_.extent / state_.fastest : never;
  events_.assign(state_.size(), {});
  events_left_ = std::max(events_per_particle_and_block * state_.size(), min_events_per_block);
  predicted_ = false;
}

template <Body B>
typename Simulation<B>::Stop Simulation<B>::advance(double until, RunCounters& counters) {
  if (!predicted_) predict_all(horizon_, counters);
  double end = until - state_.base;
  while (events_left_ > 0) {
    if (state_.now >= longest_time_) {
      if (grows<B>) break;
      reset_clocks();
      end = until - state_.base;
    }
    const auto i = static_cast<Index>(calendar_.earliest());
    const double time = calendar_.time(i);
    if (time > end) {
      state_.now = std::max(state_.now, end);
      state_.flux.advance(state_.now, counters.helfand_moment);
      return Stop::time;
    }
    state_.now = time;
    --events_left_;
    ++counters.events;
    if (prefetcher_.is_useful()) prefetcher_.advance();
    process(i, counters);
  }
  state_.flux.advance(state_.now, counters.helfand_moment);
  return Stop::block_end;
}

template <Body B>
void Simulation<B>::write(Configuration<dimension>& configuration) const {
  state_.write(configuration);
  soft_.write(configuration);
}

template <Body B>
void Simulation<B>::set_velocities(const Configuration<dimension>& configuration, double horizon,
                                   RunCounters& counters) {
  state_.set_velocities(configuration);
  soft_.load(configuration);
  predict_all(horizon - state_.base, counters);
}

// Predicts all particles, testing every pair once. The predictions are independent of each other, since the records,
// which they share, change only afterwards.
template <Body B>
void Simulation<B>::predict_all(double horizon, RunCounters& counters) {
  horizon_ = horizon;
  std::vector<double> times(state_.size()), known_until(state_.size());
  std::mutex adding;
  in_parallel(state_.size(), options_.threads, [&](std::size_t begin, std::size_t end) {
    RunCounters mine;
    for (auto i = static_cast<Index>(begin); i < end; ++i) {
      const Next next =
          next_event<PredictionScope::higher_indices>(i, {}, state_.neighbors(i), mine);
      times[i] = next.time;
      known_until[i] = next.known_until;
    }
    const std::lock_guard lock(adding);
    counters.add_predictions(mine);
  });
  for (Index i = 0; i < state_.size(); ++i) state_.particles[i].known_until = known_until[i];
  schedule(times);
  predicted_ = true;
}

template <Body B>
void Simulation<B>::schedule(const std::vector<double>& times) {
  calendar_ = Calendar(state_.size(), prefetcher_.lookahead());
  prefetcher_.restart();
  for (Index i = 0; i < state_.size(); ++i) calendar_.set(i, times[i]);
}

// In a gas, and with long bodies, whose ends are fast, the clocks run out long before a block ends.
template <Body B>
void Simulation<B>::reset_clocks() {
  const double elapsed = state_.reset_clocks();
  soft_.reset_clocks(elapsed);
  executor_.reset_clocks(elapsed);
  horizon_ -= elapsed;
  std::vector<double> times(state_.size());
  for (Index i = 0; i < state_.size(); ++i) times[i] = calendar_.time(i) - elapsed;
  schedule(times);
}

template <Body B>
void Simulation<B>::predict(Index i, RunCounters& counters) {
  predict(i, {}, state_.neighbors(i), counters);
}

// Predicts particle i with these neighbours; `known` is its first contact with all others.
template <Body B>
void Simulation<B>::predict(Index i, const TimedEvent<B>& known, std::span<Neighbor<B>> neighbors,
                            RunCounters& counters) {
  const Next next = next_event<PredictionScope::all_neighbors>(i, known, neighbors, counters);
  state_.particles[i].known_until = next.known_until;
  calendar_.set(i, next.time);
}

// Sets the contact of particle i that is known next. Searches end where the particle leaves its neighbourhood; closed
// forms do not, so the contact is known beyond that time.
template <Body B>
template <PredictionScope scope>
typename Simulation<B>::Next Simulation<B>::next_event(Index i, TimedEvent<B> known,
                                                       std::span<Neighbor<B>> neighbors,
                                                       RunCounters& counters) {
  double end = std::min(state_.next_exit(i), soft_.release_time(i));
  if (end > horizon_) end = never;
  if constexpr (!State::is_round) {
    known.time = end;
    known.event.type = EventType::exit;
  }
  const TimedEvent<B> contact =
      predictor_.template predict<scope>(i, known, neighbors, horizon_, counters);
  events_[i] = contact.event;
  return {std::min(end, contact.time), contact.time};
}

template <Body B>
void Simulation<B>::process(Index i, RunCounters& counters) {
  const Event<B> event = events_[i];
  if (soft_.release_time(i) <= state_.now) {
    soft_.release(i);
    return predict(i, counters);
  }
  if (state_.now < state_.particles[i].known_until || event.type == EventType::exit)
    return process_exit(i, counters);
  const bool is_stale = event.type == EventType::repredict ||
                        state_.version[event.partner.other] != event.partner_version;
  state_.particles[i].known_until = never;
  if (is_stale)
    predict(i, counters);
  else
    execute_contact(i, event, counters);
}

template <Body B>
void Simulation<B>::process_exit(Index i, RunCounters& counters) {
  ++counters.list_updates;
  const Index version = state_.version[i];
  const std::span<Neighbor<B>> gained = state_.leave_neighborhood(i);
  if (State::is_round && state_.version[i] == version)
    return predict(i, {state_.particles[i].known_until, events_[i]}, gained, counters);
  state_.particles[i].known_until = never;
  predict(i, counters);
}

template <Body B>
void Simulation<B>::execute_contact(Index i, const Event<B>& event, RunCounters& counters) {
  const Index j = event.partner.other;
  const bool overlaps = event.type == EventType::overlap && !soft_.is_close_pair(i, event.partner);
  if (overlaps && options_.on_overlap == OnOverlap::stop) report_overlap(i, j);
  if (soft_.is_active() && !overlaps) {
    const std::vector<Index>& changed = soft_.collide_pair(i, event, executor_, counters);
    for (const Index k : changed) state_.particles[k].known_until = never;
    for (const Index k : changed) predict(k, counters);
    return;
  }
  if (overlaps)
    executor_.correct_overlap(i, event, counters);
  else
    executor_.collide_pair(i, event, counters);
  ++state_.version[i];
  if (i != j) ++state_.version[j];
  state_.particles[i].known_until = state_.particles[j].known_until = never;  // both are unknown
  predict(i, counters);
  if (i != j) predict(j, counters);
}

template <Body B>
void Simulation<B>::report_overlap(Index i, Index j) const {
  throw InvariantError(std::string("particles ") + std::to_string(state_.external_id[i]) + " and " +
                       std::to_string(state_.external_id[j]) + " overlap at " +
                       time_text(state_.base + state_.now) +
                       ": a run must start from a state without overlaps, and keeps it");
}

}  // namespace vitrel
