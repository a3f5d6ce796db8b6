#pragma once

#include <cstdint>

#include "core/large_vector.h"
#include "core/neighbors/prefetch.h"
#include "edmd/calendar.h"
#include "edmd/event.h"

namespace vitrel {

/// Prefetches what upcoming events will read. It works in stages some events apart, each of which uses the data that
/// the stage before has prefetched. It serves systems with neighbour lists that exceed the caches, where consecutive
/// events are far apart in memory.
template <Body B>
class EventPrefetcher {
 public:
  using State = SimulationState<B>;
  using Index = typename State::Index;

  EventPrefetcher(State& state, const Calendar& calendar, const LargeVector<Event<B>>& events)
      : state_(state), calendar_(calendar), events_(events) {}

  /// Returns whether prefetching pays: in smaller systems it costs more than it saves. The limit is lower in three
  /// dimensions, where a particle has twice as many neighbours.
  bool is_useful() const { return state_.size() > cached_particles && state_.neighborhoods; }
  /// Returns the number of upcoming events that the calendar must know.
  std::size_t lookahead() const { return is_useful() ? stages * events_per_stage : 1; }

  /// Starts anew; to be called after the calendar has been rebuilt.
  void restart() { prefetched_ = 0; }
  void advance() {
    for (; prefetched_ < calendar_.upcoming_count(); ++prefetched_)
      for (std::uint64_t stage = 0; stage < stages && stage * events_per_stage <= prefetched_;
           ++stage)
        prefetch(static_cast<Index>(calendar_.upcoming(prefetched_ - stage * events_per_stage)),
                 static_cast<int>(stage));
  }

 private:
  static constexpr std::size_t cached_particles = B::dimension == 2 ? 32768 : 2048;
  static constexpr std::uint64_t stages = 4, events_per_stage = 4;

  void prefetch(Index i, int stage) const {
    Neighborhoods<B>& neighborhoods = *state_.neighborhoods;
    if (stage == 0) return prefetch_own(i);
    if (stage == 1) neighborhoods.prefetch_list(i);
    if (stage == 2) prefetch_partners(i);
    const double time = calendar_.time(i);
    if (events_[i].type == Event<B>::Type::exit || time < state_.particles[i].known_until) {
      if (time == State::never) return;
      if (stage == 1) prefetch_line(&state_.image[i]);
      if (stage == 1) neighborhoods.prefetch_cells(i, state_.position_at(i, time));
      if (stage == 2) neighborhoods.prefetch_references(i);
    } else {
      const Index j = events_[i].partner.other;
      if (stage == 1) prefetch_own(j);
      if (stage == 2) neighborhoods.prefetch_list(j);
      if (stage == 3) prefetch_partners(j);
    }
  }
  void prefetch_own(Index k) const {
    prefetch_line(&state_.particles[k]);
    prefetch_line(&events_[k]);
    prefetch_line(&state_.version[k]);
    calendar_.prefetch(k);
    state_.neighborhoods->prefetch_list_header(k);
  }
  void prefetch_partners(Index k) const {
    for (const auto& neighbor : state_.neighborhoods->of(k))
      prefetch_line(&state_.particles[neighbor.other]);
  }

  State& state_;
  const Calendar& calendar_;
  const LargeVector<Event<B>>& events_;
  std::uint64_t prefetched_ = 0;  // upcoming particles prefetched so far
};

}  // namespace vitrel
