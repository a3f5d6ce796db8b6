#pragma once

#include <algorithm>
#include <span>

#include "core/contact/contact_queries.h"
#include "core/contact/ellipse_contact_screen.h"
#include "core/contact/ellipsoid_contact_screen.h"
#include "edmd/engine.h"
#include "edmd/event.h"

/// @file
/// The first contact of a particle with its neighbours.
///
/// In every pair of neighbours (i, j), at least one of the two has predicted an event no later than their first
/// contact. A prediction for i therefore never searches beyond the time up to which the contacts of j are known. A
/// predicted contact whose partner has changed its motion in the meantime is stale: when its time comes, the particle
/// is predicted again.
namespace vitrel {

/// The neighbours that a prediction tests. Usually it tests all of them, up to the time to which they know their own
/// contacts; when all particles are predicted in parallel, it tests only those with higher indices, so that each pair
/// is tested once.
enum class PredictionScope { all_neighbors, higher_indices };

/// A batch of the neighbours of a particle, from number `first` on. If too few are left to fill it, the last one is
/// repeated.
template <Body B, int lanes>
class NeighborBatch {
 public:
  const FlightRecord<B>*
      partner[lanes];  ///< at their images; contacts after `known_until` do not matter
  const WarmStart<B>* warm_start[lanes];
  std::uint32_t other[lanes];  ///< particle numbers
  int count;                   ///< number of different neighbours
  std::uint64_t tested;        ///< neighbours without pairs that are tested from the other side

  template <PredictionScope scope>
  VITREL_INLINE void load(SimulationState<B>& state, std::uint32_t i,
                          std::span<const Neighbor<B>> neighbors, std::size_t first) {
    count = static_cast<int>(std::min<std::size_t>(lanes, neighbors.size() - first));
    tested = static_cast<std::uint64_t>(count);
    for (int k = 0; k < lanes; ++k) {
      const Neighbor<B>& neighbor = neighbors[std::min(first + k, neighbors.size() - 1)];
      partner[k] = &state.particles[neighbor.other];
      warm_start[k] = &neighbor.warm_start;
      other[k] = neighbor.other;
      if (scope == PredictionScope::all_neighbors) {
        state.refresh(neighbor.other);
        if (!neighbor.is_shifted()) continue;
      }
      copy_[k] = *partner[k];
      copy_[k].position += state.box.translation(neighbor.shift());
      if (scope == PredictionScope::higher_indices) {
        const bool is_tested = neighbor.other >= i;
        copy_[k].known_until = is_tested ? SimulationState<B>::never : -SimulationState<B>::never;
        if (k < count && !is_tested) --tested;
      }
      partner[k] = &copy_[k];
    }
  }

 private:
  FlightRecord<B> copy_[lanes];
};

/// A pair that overlaps, or whose contact time needs a search.
template <Body B>
class ContactSearch {
 public:
  using State = SimulationState<B>;
  using Index = typename State::Index;
  using Particle = typename State::Particle;
  static constexpr int dimension = State::dimension;

  ContactSearch(const State& state, OnOverlap on_overlap)
      : state_(state), on_overlap_(on_overlap) {}

  /// Replaces `best` by the first contact with this neighbour, if that is earlier than `best` and the horizon. The
  /// contact screen has excluded contacts within the time `screened` from now.
  void search(Index i, const Particle& mine, const Neighbor<B>& neighbor, double screened,
              double horizon, TimedEvent<B>& best, RunCounters& counters) const {
    const Index j = neighbor.other;
    Particle theirs = state_.record_now(j);
    theirs.position += state_.box.translation(neighbor.shift());
    const Prediction<dimension> contact = first_contact(
        flight_of(i, mine), flight_of(j, theirs), std::min(horizon, best.time) - state_.now,
        state_.contact_gap, screened, neighbor.warm_start);
    ++counters.searches;
    counters.steps += static_cast<std::uint64_t>(contact.steps);
    if (contact.outcome == Outcome::none) return;
    using Type = typename Event<B>::Type;
    Type type = Type::collision;
    double time = state_.now + contact.time;
    if (contact.outcome == Outcome::not_converged) type = Type::repredict;
    if (contact.outcome == Outcome::overlap) {
      const double watch = time_to_watch(i, j, theirs.position - mine.position);
      type = watch > 0 ? Type::repredict : Type::overlap;
      time = state_.now + watch;
    }
    if (time < best.time)
      best = {time, Event<B>::with(type, neighbor, state_.version[j], contact.normal)};
  }

 private:
  Flight<B> flight_of(Index k, const Particle& now) const {
    if constexpr (tumbles<B>)
      return {body_now(k), now.pose(), now.motion(), state_.tumbling[k].top,
              state_.now - state_.tumbling[k].since};
    else
      return {body_now(k), now.pose(), now.motion()};
  }
  B body_now(Index i) const {
    if constexpr (grows<B>)
      return {state_.shape(i), state_.size_now().size, state_.size_now().growth_rate};
    else
      return {state_.shape(i)};
  }

  // While the centres of an overlapping pair recede, the correction waits for this fraction of the time in which they
  // move by the sum of the inradii.
  double time_to_watch(Index i, Index j, const Vec<dimension>& d) const {
    constexpr double fraction = 0.05;
    const Vec<dimension> relative = state_.particles[j].velocity - state_.particles[i].velocity;
    if (on_overlap_ == OnOverlap::stop || !(dot(d, relative) > 0)) return 0;
    return fraction * (state_.shape(i).inradius() + state_.shape(j).inradius()) / norm(relative);
  }

  const State& state_;
  OnOverlap on_overlap_;
};

/// The predictor of bodies that are not round. It screens all neighbours (contact_screen.h) and searches only the
/// candidates that could come first, in the order of their lower bounds. It does not search a contact whose lower bound
/// is far ahead, because other events overtake most such contacts; it predicts the particle again at that time.
template <Body B>
class ContactPredictor {
 public:
  using State = SimulationState<B>;
  using Index = typename State::Index;
  using Particle = typename State::Particle;
  using Scope = PredictionScope;
  static constexpr int dimension = State::dimension;

  ContactPredictor(State& state, OnOverlap on_overlap)
      : state_(state), search_(state, on_overlap) {}

  /// Returns the earlier of `known` and the first contact of particle i with these neighbours before the horizon.
  template <Scope scope>
  TimedEvent<B> predict(Index i, const TimedEvent<B>& known, std::span<Neighbor<B>> neighbors,
                        double horizon, RunCounters& counters) const {
    TimedEvent<B> best = known;
    const Particle mine = state_.record_now(i);
    ContactScreen<B> screen(state_.type(i).coefficients, mine, state_.now, state_.size_now(),
                            state_.contact_gap);
    Batch batch;
    for (std::size_t next = 0; next < neighbors.size(); next += lanes) {
      batch.template load<scope>(state_, i, neighbors, next);
      if (state_.types.size() > 1)
        for (int k = 0; k < lanes; ++k)
          screen.set_shape(k, state_.type(batch.other[k]).coefficients);
      const double latest = std::min(best.time, horizon);
      screen.load(batch.partner, batch.warm_start, latest);
      screen.evaluate(batch.count);
      counters.predictions += batch.tested;
      for (int k = 0; k < batch.count; ++k) neighbors[next + k].warm_start = screen.warm_start(k);
      search_earliest_first(i, mine, neighbors.subspan(next), batch, latest, screen, best,
                            counters);
    }
    return best;
  }

 private:
  static constexpr int lanes = ContactScreen<B>::lanes;
  using Batch = NeighborBatch<B, lanes>;

  void search_earliest_first(Index i, const Particle& mine, std::span<const Neighbor<B>> neighbors,
                             const Batch& batch, double latest, ContactScreen<B>& screen,
                             TimedEvent<B>& best, RunCounters& counters) const {
    for (int done = 0; done < batch.count; ++done) {
      const auto [wait, k] = screen.earliest();
      if (!(state_.now + wait < best.time)) return;
      if (wait > mean_free_time())
        best = {state_.now + wait, {}};  // predict again then
      else
        search_.search(i, mine, neighbors[k], wait, std::min(latest, batch.partner[k]->known_until),
                       best, counters);
      screen.discard(k);
    }
  }

  // Returns the mean time between two collisions of a particle in this block, or +∞ while it is unknown. A contact that
  // cannot occur within this time is not searched yet. The speed-up has a flat maximum around one mean free time
  // (docs/studies/engine.md).
  double mean_free_time() const {
    const auto particles = static_cast<double>(state_.size());
    return state_.collisions < particles ? State::never
                                         : 0.5 * particles * state_.now / state_.collisions;
  }

  State& state_;
  ContactSearch<B> search_;
};

}  // namespace vitrel
