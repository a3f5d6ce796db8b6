#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/large_vector.h"
#include "core/neighbors/prefetch.h"

namespace vitrel {

/// The next event time of every particle, and the earliest of all: a bounded-increment priority queue (Paul,
/// J. Comput. Phys. 221, 615, 2007). Equal times are ordered by particle, so the order never depends on history.
/// Times are finite or +∞. They may be set in any order; the queue is fast if they move forward.
///
/// 1. A window of time is divided into equal slots. A slot is one or more cache lines with the numbers of the
///    particles scheduled in it. Particles scheduled after the window are not stored in any slot. Slot entries are
///    never deleted: a particle stores its current slot, and its other slot entries are stale.
/// 2. The particles of all opened slots are in a small heap, ordered by (time, particle). When it holds fewer than
///    `lookahead`, the next slot is opened, and its particles become upcoming.
/// 3. After the last slot, or after very many changes, the window is reset: it begins at the earliest time, and the
///    slot width is chosen so that each holds a few particles, as estimated from a sample of the earliest eighth.
/// 4. Slots are far apart in memory, so an entry is stored a few changes later, after its slot has been prefetched.
///
/// Cost: O(1) per change and per query of the earliest, averaged over a window; O(log N) per change if all times fall
/// into few slots, for instance if they are equal. Memory: 48 bytes per particle, and 4 per stale slot entry. There are
/// a few stale entries per particle, or up to one per change since the last reset if times move back and forth.
class Calendar {
 public:
  /// Nothing is scheduled at first: all times are +∞. At least `lookahead` ≥ 1 particles become upcoming before their
  /// events, if as many are scheduled inside the window by then.
  explicit Calendar(std::size_t particles = 0, std::size_t lookahead = 1)
      : lookahead_(lookahead),
        entries_(particles),
        slots_(particles / particles_per_line + 1),
        opened_(end()) {
    schedule_all();
  }

  std::size_t size() const { return entries_.size(); }
  double time(std::size_t particle) const { return entries_[particle].time; }

  /// Returns the particle with the smallest (time, particle). It opens slots and is therefore not const.
  std::size_t earliest() {
    if (heap_.size() < lookahead_ || changes_left_ <= 0) open_slots();
    return heap_.empty() ? 0 : heap_.front().particle;
  }

  /// `upcoming_count` is the number of particles that have become upcoming so far; `upcoming` returns number k of them,
  /// counted from 0, for the last 64 only.
  std::uint64_t upcoming_count() const { return upcoming_count_; }
  std::size_t upcoming(std::uint64_t k) const { return upcoming_[k % upcoming_capacity]; }

  /// Prefetches what `set` reads for this particle.
  void prefetch(std::size_t particle) const { prefetch_line(&entries_[particle]); }

  void set(std::size_t particle, double time) {
    assert(time > -never);
    const auto i = static_cast<Index>(particle);
    Entry& place = entries_[i];
    const Index slot = slot_of(time);
    place.time = time;
    --changes_left_;
    if (place.slot == in_heap) {
      if (slot < opened_) return restore_heap(place.heap, {time, i});
      remove_from_heap(place.heap);
      put_in_slot(i, slot);
    } else if (slot < opened_) {
      add_to_heap(i);
    } else if (slot != place.slot) {
      put_in_slot(i, slot);
    }
  }

 private:
  using Index = std::uint32_t;

  static constexpr double never = std::numeric_limits<double>::infinity();
  // These slot numbers are special: the particle is in the heap, or there is no particle.
  static constexpr Index in_heap = std::numeric_limits<Index>::max(), no_slot = in_heap - 1;
  // The cost has a flat minimum at these values: fewer slots mean more resets, and wider slots a larger heap.
  static constexpr std::size_t particles_per_line = 2;
  static constexpr double particles_per_slot = 4;
  static constexpr std::size_t min_sampled = 8;
  static constexpr std::int64_t changes_per_particle = 64;
  static constexpr std::size_t arity = 4;
  static constexpr std::size_t upcoming_capacity = 64;
  static constexpr double min_slot_width = 1e-300;  // so that its inverse is finite
  // The line of a slot is prefetched `slot_lookahead` slots before the slot is opened, and its particles
  // `particle_lookahead` slots before.
  static constexpr Index slot_lookahead = 6, particle_lookahead = 3;

  struct Entry {
    double time = never;
    Index slot = 0;  // slot in which the particle is scheduled
    Index heap = 0;  // position in the heap, if slot == in_heap
  };
  struct alignas(64) Line {
    static constexpr Index capacity = 14;
    Index count = 0;
    Index overflow = 0;  // if not 0, overflow_[overflow - 1] continues
    std::array<Index, capacity> particle;
  };
  struct SlotEntry {
    Index particle = 0, slot = 0;
  };
  struct HeapEntry {
    double time = never;
    Index particle = 0;
  };

  static bool before(const HeapEntry& one, const HeapEntry& two) {
    return one.time < two.time || (one.time == two.time && one.particle < two.particle);
  }

  /// The slot of all times after the window.
  Index end() const { return static_cast<Index>(slots_.size()); }

  // The slot is monotonic in time despite rounding, so slots stay in order.
  Index slot_of(double time) const {
    const double slot = std::max((time - begin_) * slots_per_time_, 0.0);
    return static_cast<Index>(std::min(slot, static_cast<double>(slots_.size())));
  }

  // Delays this entry and stores the oldest delayed one.
  void put_in_slot(Index particle, Index slot) {
    entries_[particle].slot = slot;
    if (slot == end()) return;
    prefetch_line(&slots_[slot]);
    const SlotEntry due =
        std::exchange(delayed_[delayed_count_++ % delayed_.size()], {particle, slot});
    if (entries_[due.particle].slot == due.slot) store(due);
  }

  void store(const SlotEntry& entry) {
    Line& line = slots_[entry.slot];
    if (line.count == Line::capacity) {
      overflow_.push_back(line);
      line.count = 0;
      line.overflow = static_cast<Index>(overflow_.size());
    }
    line.particle[line.count++] = entry.particle;
  }

  // The entry may be stale, or its particle may already be in the heap.
  void activate(const SlotEntry& entry) {
    if (entries_[entry.particle].slot != entry.slot) return;
    add_to_heap(entry.particle);
    upcoming_[upcoming_count_++ % upcoming_capacity] = entry.particle;
  }

  void schedule_all() {
    overflow_.clear();
    for (Line& line : slots_) line.count = line.overflow = 0;
    delayed_.fill({0, no_slot});
    for (Entry& place : entries_) place.slot = end();
    for (Index i = 0; i < entries_.size(); ++i) put_in_slot(i, slot_of(entries_[i].time));
  }

  // Opens slots until the heap holds enough particles; the heap stays empty if nothing is scheduled.
  void open_slots() {
    if (changes_left_ <= 0) reset_window();
    while (heap_.size() < lookahead_) {
      if (opened_ == end() && heap_.empty()) reset_window();
      if (opened_ == end()) return;
      open(opened_++);
    }
  }

  void open(Index slot) {
    if (lookahead_ > 1) prefetch_for(slot);
    for (const Line* line = &slots_[slot]; line;
         line = line->overflow ? &overflow_[line->overflow - 1] : nullptr)
      activate_all(*line, slot);
    for (const SlotEntry& entry : delayed_)
      if (entry.slot == slot) activate(entry);
  }

  // Collects the valid entries without branches, which could not be predicted.
  void activate_all(const Line& line, Index slot) {
    std::array<Index, Line::capacity> valid;
    Index count = 0;
    for (Index k = 0; k < line.count; ++k) {
      valid[count] = line.particle[k];
      count += entries_[line.particle[k]].slot == slot;
    }
    for (Index k = 0; k < count; ++k) activate({valid[k], slot});
  }

  void prefetch_for(Index slot) const {
    if (slot + slot_lookahead < end()) prefetch_line(&slots_[slot + slot_lookahead]);
    if (slot + particle_lookahead >= end()) return;
    const Line& notes = slots_[slot + particle_lookahead];
    for (Index k = 0; k < notes.count; ++k) prefetch(notes.particle[k]);
  }

  void reset_window() {
    heap_.clear();
    changes_left_ = changes_per_particle * static_cast<std::int64_t>(entries_.size());
    fit_window();
    schedule_all();
  }

  void fit_window() {
    double first = never;
    std::size_t planned = 0;
    for (const Entry& place : entries_) {
      first = std::min(first, place.time);
      if (place.time < never) ++planned;
    }
    opened_ = planned == 0 ? end() : 0;
    begin_ = planned == 0 ? -never : first;  // -never: every time is after the window
    if (planned == 0) return;
    // A sample of the times shows when the earliest eighth of the events is due.
    const std::size_t step = 1 + planned / sample_.size();
    std::size_t seen = 0, drawn = 0;
    for (const Entry& place : entries_)
      if (place.time < never && seen++ % step == 0) sample_[drawn++] = place.time;
    const std::size_t rank = std::min(drawn - 1, min_sampled + drawn / 8);
    std::nth_element(sample_.begin(), sample_.begin() + rank, sample_.begin() + drawn);
    const auto counted = static_cast<double>((rank + 1) * step);
    const double width = particles_per_slot * (sample_[rank] - begin_) / counted;
    slots_per_time_ = 1 / std::max(width, min_slot_width);
  }

  void put(std::size_t place, const HeapEntry& entry) {
    heap_[place] = entry;
    entries_[entry.particle].heap = static_cast<Index>(place);
  }

  void add_to_heap(Index particle) {
    entries_[particle].slot = in_heap;
    const HeapEntry entry{entries_[particle].time, particle};
    heap_.push_back(entry);
    sift_up(heap_.size() - 1, entry);
  }

  void remove_from_heap(std::size_t place) {
    const HeapEntry last = heap_.back();
    heap_.pop_back();
    if (place < heap_.size()) restore_heap(place, last);
  }

  // Moves an entry to its position in the heap, starting from the free position `place`.
  void restore_heap(std::size_t place, const HeapEntry& entry) {
    if (place > 0 && before(entry, heap_[(place - 1) / arity]))
      sift_up(place, entry);
    else
      sift_down(place, entry);
  }

  void sift_up(std::size_t place, const HeapEntry& entry) {
    while (place > 0) {
      const std::size_t parent = (place - 1) / arity;
      if (!before(entry, heap_[parent])) break;
      put(place, heap_[parent]);
      place = parent;
    }
    put(place, entry);
  }

  void sift_down(std::size_t place, const HeapEntry& entry) {
    while (true) {
      const std::size_t first = place * arity + 1;
      if (first >= heap_.size()) break;
      const std::size_t end = std::min(first + arity, heap_.size());
      std::size_t best = first;
      for (std::size_t child = first + 1; child < end; ++child)
        if (before(heap_[child], heap_[best])) best = child;
      if (!before(heap_[best], entry)) break;
      put(place, heap_[best]);
      place = best;
    }
    put(place, entry);
  }

  std::size_t lookahead_;
  std::uint64_t upcoming_count_ = 0;
  std::array<Index, upcoming_capacity> upcoming_{};
  LargeVector<Entry> entries_;
  LargeVector<Line> slots_;             // first line of each slot
  LargeVector<Line> overflow_;          // further lines
  std::array<SlotEntry, 4> delayed_{};  // entries not yet stored
  std::array<double, 256> sample_{};    // times that determine the window
  std::uint64_t delayed_count_ = 0;
  Index opened_ = 0;  // number of opened slots
  double begin_ = -never;
  double slots_per_time_ = 1;
  std::int64_t changes_left_ = 1;  // until the next reset
  LargeVector<HeapEntry> heap_;
};

}  // namespace vitrel
