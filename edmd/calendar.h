#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/neighbors/prefetch.h"

namespace vitrel {

/// The next event time of every particle, and the earliest of them all: a bounded-increment queue
/// (Paul, J. Comput. Phys. 221, 615, 2007). Equal times are ordered by particle, so the order never
/// depends on history. Times are finite or +∞; they may be set in any order, the queue is fast if
/// they are set forward.
///
/// 1. A window of time is cut into equal slots. A slot is a cache line, or several, with the numbers of
///    the particles that are planned in it; who is planned later or never is noted nowhere. Nothing
///    is struck out: a particle knows in which slot it waits, and all other notes of it are void.
/// 2. The particles of the slots opened so far are in a small heap, ordered by (time, particle). When
///    it holds fewer than `lookahead` the next slot is opened, and its particles are upcoming.
/// 3. After the last slot the window is renewed: it begins at the earliest time, and a slot is as wide
///    as it takes, by a sample of the nearest eighth of the particles, to find a few of them in each.
///    So is a window that has served for very many changes, because events now come much faster.
/// 4. Slots are far apart in memory: a note is taken a few changes later, when its slot has had time to
///    come.
///
/// Cost: O(1) per change and for the earliest, on average over a window; O(log N) per change if all
/// times fall into few slots, for instance if they are equal. Memory: 48 bytes per particle, and
/// 4 for every void note: a few per particle, or as many as changes since the renewal if times are
/// set to and fro.
class Calendar {
 public:
  /// Nothing is planned: all times are +∞. At least `lookahead` particles, 1 or more, are upcoming
  /// before their events, as far as the window reaches and as these were planned by then.
  explicit Calendar(std::size_t particles = 0, std::size_t lookahead = 1)
      : foresight_(lookahead),
        places_(particles),
        slots_(particles / particles_per_line + 1),
        opened_(end()) {
    note_all();
  }

  std::size_t size() const { return places_.size(); }
  double time(std::size_t particle) const { return places_[particle].time; }

  /// The particle with the least (time, particle). Opens slots, hence not const.
  std::size_t earliest() {
    if (due_.size() < foresight_ || changes_left_ <= 0) open_slots();
    return due_.empty() ? 0 : due_.front().particle;
  }

  /// How many particles have been upcoming, and one of the last 64 of these: number k, counted from 0.
  std::uint64_t upcoming_count() const { return announcements_; }
  std::size_t upcoming(std::uint64_t k) const { return announced_[k % remembered]; }

  /// Asks the memory for what a change of this particle's time will read.
  void prefetch(std::size_t particle) const { prefetch_line(&places_[particle]); }

  void set(std::size_t particle, double time) {
    assert(time > -never);
    const auto i = static_cast<Index>(particle);
    Place& place = places_[i];
    const Index slot = slot_of(time);
    place.time = time;
    --changes_left_;
    if (place.slot == in_heap) {
      if (slot < opened_) return settle(place.heap, {time, i});
      take_from_heap(place.heap);
      wait(i, slot);
    } else if (slot < opened_) {
      add_to_heap(i);
    } else if (slot != place.slot) {
      wait(i, slot);
    }
  }

 private:
  using Index = std::uint32_t;

  static constexpr double never = std::numeric_limits<double>::infinity();
  // Instead of a slot: of a particle in the heap, of no particle.
  static constexpr Index in_heap = std::numeric_limits<Index>::max(), nowhere = in_heap - 1;
  // The cost is flat around these: fewer slots mean more renewals, wider ones a higher heap.
  static constexpr std::size_t particles_per_line = 2;
  static constexpr double particles_per_slot = 4;
  static constexpr std::size_t least_counted = 8;
  static constexpr std::int64_t changes_per_particle = 64;
  static constexpr std::size_t arity = 4;
  static constexpr std::size_t remembered = 64;  // upcoming_count
  static constexpr double narrowest = 1e-300;    // of one slot: its inverse stays finite
  // How many slots before their opening these are asked for, and then their particles.
  static constexpr Index slot_ahead = 6, particles_ahead = 3;

  struct Place {
    double time = never;
    Index slot = 0;  // where the particle waits,
    Index heap = 0;  // or where in the heap it is
  };
  struct alignas(64) Line {
    static constexpr Index room = 14;
    Index count = 0;
    Index more = 0;  // if not 0: the rest are in more_[more - 1]
    std::array<Index, room> particle;
  };
  struct Note {
    Index particle = 0, slot = 0;
  };
  struct Entry {
    double time = never;
    Index particle = 0;
  };

  static bool before(const Entry& one, const Entry& two) {
    return one.time < two.time || (one.time == two.time && one.particle < two.particle);
  }

  /// After the window.
  Index end() const { return static_cast<Index>(slots_.size()); }

  // It never decreases with time, so that slots are in order whatever the rounding.
  Index slot_of(double time) const {
    const double slot = std::max((time - begin_) * slots_per_time_, 0.0);
    return static_cast<Index>(std::min(slot, static_cast<double>(slots_.size())));
  }

  // Takes the oldest of the last few notes in place of this one.
  void wait(Index particle, Index slot) {
    places_[particle].slot = slot;
    if (slot == end()) return;
    prefetch_line(&slots_[slot]);
    const Note due = std::exchange(notes_[noted_++ % notes_.size()], {particle, slot});
    if (places_[due.particle].slot == due.slot) take(due);
  }

  void take(const Note& note) {
    Line& line = slots_[note.slot];
    if (line.count == Line::room) {
      more_.push_back(line);
      line.count = 0;
      line.more = static_cast<Index>(more_.size());
    }
    line.particle[line.count++] = note.particle;
  }

  // The note may be void, or have been heard before.
  void call(const Note& note) {
    if (places_[note.particle].slot != note.slot) return;
    add_to_heap(note.particle);
    announced_[announcements_++ % remembered] = note.particle;
  }

  void note_all() {
    more_.clear();
    for (Line& line : slots_) line.count = line.more = 0;
    notes_.fill({0, nowhere});
    for (Place& place : places_) place.slot = end();
    for (Index i = 0; i < places_.size(); ++i) wait(i, slot_of(places_[i].time));
  }

  // Until enough are due; nobody is if nothing is planned.
  void open_slots() {
    if (changes_left_ <= 0) renew_window();
    while (due_.size() < foresight_) {
      if (opened_ == end() && due_.empty()) renew_window();
      if (opened_ == end()) return;
      open(opened_++);
    }
  }

  void open(Index slot) {
    if (foresight_ > 1) read_ahead_of(slot);
    for (const Line* line = &slots_[slot]; line;
         line = line->more ? &more_[line->more - 1] : nullptr)
      call_all(*line, slot);
    for (const Note& note : notes_)
      if (note.slot == slot) call(note);
  }

  // First those that are not void, without a branch: which they are cannot be foreseen.
  void call_all(const Line& line, Index slot) {
    std::array<Index, Line::room> valid;
    Index count = 0;
    for (Index k = 0; k < line.count; ++k) {
      valid[count] = line.particle[k];
      count += places_[line.particle[k]].slot == slot;
    }
    for (Index k = 0; k < count; ++k) call({valid[k], slot});
  }

  void read_ahead_of(Index slot) const {
    if (slot + slot_ahead < end()) prefetch_line(&slots_[slot + slot_ahead]);
    if (slot + particles_ahead >= end()) return;
    const Line& notes = slots_[slot + particles_ahead];
    for (Index k = 0; k < notes.count; ++k) prefetch(notes.particle[k]);
  }

  void renew_window() {
    due_.clear();
    changes_left_ = changes_per_particle * static_cast<std::int64_t>(places_.size());
    place_window();
    note_all();
  }

  void place_window() {
    double first = never;
    std::size_t planned = 0;
    for (const Place& place : places_) {
      first = std::min(first, place.time);
      if (place.time < never) ++planned;
    }
    opened_ = planned == 0 ? end() : 0;
    begin_ = planned == 0 ? -never : first;  // -never: everything is later than the window
    if (planned == 0) return;
    // The nearest eighth, by a sample.
    const std::size_t step = 1 + planned / sample_.size();
    std::size_t seen = 0, drawn = 0;
    for (const Place& place : places_)
      if (place.time < never && seen++ % step == 0) sample_[drawn++] = place.time;
    const std::size_t rank = std::min(drawn - 1, least_counted + drawn / 8);
    std::nth_element(sample_.begin(), sample_.begin() + rank, sample_.begin() + drawn);
    const auto counted = static_cast<double>((rank + 1) * step);
    const double width = particles_per_slot * (sample_[rank] - begin_) / counted;
    slots_per_time_ = 1 / std::max(width, narrowest);
  }

  void put(std::size_t place, const Entry& entry) {
    due_[place] = entry;
    places_[entry.particle].heap = static_cast<Index>(place);
  }

  void add_to_heap(Index particle) {
    places_[particle].slot = in_heap;
    const Entry entry{places_[particle].time, particle};
    due_.push_back(entry);
    rise(due_.size() - 1, entry);
  }

  void take_from_heap(std::size_t place) {
    const Entry last = due_.back();
    due_.pop_back();
    if (place < due_.size()) settle(place, last);
  }

  // Puts an entry where it belongs; the place named is free.
  void settle(std::size_t place, const Entry& entry) {
    if (place > 0 && before(entry, due_[(place - 1) / arity]))
      rise(place, entry);
    else
      sink(place, entry);
  }

  void rise(std::size_t place, const Entry& entry) {
    while (place > 0) {
      const std::size_t parent = (place - 1) / arity;
      if (!before(entry, due_[parent])) break;
      put(place, due_[parent]);
      place = parent;
    }
    put(place, entry);
  }

  void sink(std::size_t place, const Entry& entry) {
    while (true) {
      const std::size_t first = place * arity + 1;
      if (first >= due_.size()) break;
      const std::size_t end = std::min(first + arity, due_.size());
      std::size_t best = first;
      for (std::size_t child = first + 1; child < end; ++child)
        if (before(due_[child], due_[best])) best = child;
      if (!before(due_[best], entry)) break;
      put(place, due_[best]);
      place = best;
    }
    put(place, entry);
  }

  std::size_t foresight_;
  std::uint64_t announcements_ = 0;
  std::array<Index, remembered> announced_{};
  std::vector<Place> places_;
  std::vector<Line> slots_;           // the first line of each
  std::vector<Line> more_;            // further ones
  std::array<Note, 4> notes_{};       // not yet taken
  std::array<double, 256> sample_{};  // of times, to place the window
  std::uint64_t noted_ = 0;
  Index opened_ = 0;  // slots
  double begin_ = -never;
  double slots_per_time_ = 1;
  std::int64_t changes_left_ = 1;  // until the window is renewed
  std::vector<Entry> due_;         // the heap
};

}  // namespace vitrel
