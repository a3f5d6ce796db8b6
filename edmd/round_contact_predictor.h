#pragma once

#include <algorithm>
#include <span>

#include "core/contact/round_contacts.h"
#include "edmd/contact_predictor.h"

namespace vitrel {

/// The predictor of disks and spheres. It computes all contacts, also those after the particle leaves its
/// neighbourhood. When the particle leaves, only contacts with new neighbours remain to be predicted.
template <RoundBody B>
class ContactPredictor<B> {
 public:
  using State = SimulationState<B>;
  using Index = typename State::Index;
  using Scope = PredictionScope;
  static constexpr int dimension = State::dimension;

  ContactPredictor(State& state, OnOverlap on_overlap)
      : state_(state), search_(state, on_overlap) {}

  /// Returns the earlier of `known` and the first contact of particle i with these neighbours before the horizon.
  template <Scope scope>
  TimedEvent<B> predict(Index i, const TimedEvent<B>& known, std::span<Neighbor<B>> neighbors,
                        double horizon, RunCounters& counters) const {
    const Pose<dimension> mine = state_.pose_now(i);
    EarliestRoundContact<B> earliest(state_.type(i).coefficients.radius, mine.position,
                                     state_.particles[i].velocity, state_.now, state_.size_now(),
                                     state_.contact_gap);
    SimdBatch radius(state_.type(i).coefficients.radius);
    NeighborBatch<B, simd_width> batch;
    for (std::size_t next = 0; next < neighbors.size(); next += simd_width) {
      batch.template load<scope>(state_, i, neighbors, next);
      if (state_.types.size() > 1)
        for (int k = 0; k < simd_width; ++k)
          radius.set(k, state_.type(batch.other[k]).coefficients.radius);
      earliest.test(batch.partner, radius, next);
      counters.predictions += batch.tested;
    }
    const auto [wait, number] = earliest.earliest();
    const double time = state_.now + wait;
    if (!(time < std::min(known.time, horizon))) return known;
    const Neighbor<B>& neighbor = neighbors[std::min(number, neighbors.size() - 1)];
    TimedEvent<B> best = known;
    if (wait > 0)
      best = {time, Event<B>::with(Event<B>::Type::collision, neighbor,
                                   state_.version[neighbor.other], Vec<dimension>::Zero())};
    else
      search_.search(i, state_.record_now(i), neighbor, 0, horizon, best,
                     counters);  // the pair touches or overlaps
    return best;
  }

 private:
  State& state_;
  ContactSearch<B> search_;
};

}  // namespace vitrel
