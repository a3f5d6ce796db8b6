#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <vector>

#include "core/neighbors/ask_memory.h"

namespace vitrel {

/// The next event time of every particle, and the earliest of them all: a bounded-increment queue
/// (Paul, J. Comput. Phys. 221, 615, 2007). Equal times are ordered by particle, so the order never
/// depends on history. Times are finite or +∞; they may be set in any order, the queue is fast if
/// they are set forward.
///
/// 1. A window of time is cut into equal slots, each with a list of the particles that are planned in
///    it; one more list holds those planned later or never. To plan is to divide and to link.
/// 2. The particles of the slots opened so far are in a small heap, ordered by (time, particle). When
///    it holds fewer than `foresight` the next slot is opened, and its particles are announced.
/// 3. After the last slot the window is renewed: it begins at the earliest time, and a slot is as wide
///    as it takes, counted over the nearest eighth of the particles, to find a few of them in each.
///    So is a window that has served for very many changes, because events now come much faster.
///
/// A particle's place follows from its time alone: slot_of(time) < opened_ means the heap.
/// Cost: O(1) per change and for the earliest, on average over a window; O(log N) per change if all
/// times fall into one slot, for instance if they are equal. Memory: 32 bytes per particle, and 8
/// more during a renewal.
class Calendar {
 public:
  /// Nothing is planned: all times are +∞. At least `foresight` particles, 1 or more, are announced
  /// before their events, as far as the window reaches and as these were planned by then.
  explicit Calendar(std::size_t particles = 0, std::size_t foresight = 1)
      : foresight_(foresight),
        slots_(static_cast<Index>(slots_per_particle * particles)),
        opened_(slots_),
        time_(particles, never),
        links_(particles + slots_ + 1) {
    link_all();
  }

  std::size_t size() const { return time_.size(); }
  double time(std::size_t particle) const { return time_[particle]; }

  /// The particle with the least (time, particle). Opens slots, hence not const.
  std::size_t earliest() {
    if (due_.size() < foresight_ || changes_left_ <= 0) open_slots();
    return due_.empty() ? 0 : due_.front().particle;
  }

  /// How many particles have been announced, and one of the last 64 of these: number k, counted from 0.
  std::uint64_t announcements() const { return announcements_; }
  std::size_t announced(std::uint64_t k) const { return announced_[k % remembered]; }

  /// Asks the memory for what a change of this particle's time will read.
  void read_ahead(std::size_t particle) const {
    ask_memory(&time_[particle]);
    ask_memory(&links_[particle]);
  }

  void set(std::size_t particle, double time) {
    assert(time > -never);
    const auto i = static_cast<Index>(particle);
    const Index from = slot_of(time_[i]);
    const Index to = slot_of(time);
    time_[i] = time;
    --changes_left_;
    if (from < opened_) {
      if (to < opened_) return settle(links_[i].next, {time, i});
      take_from_heap(links_[i].next);
      link(i, to);
    } else if (from != to) {
      unlink(i);
      if (to < opened_)
        add_to_heap({time, i});
      else
        link(i, to);
    }
  }

 private:
  using Index = std::uint32_t;

  static constexpr double never = std::numeric_limits<double>::infinity();
  // The cost is flat around these: fewer slots mean more renewals, wider ones a higher heap.
  static constexpr std::size_t slots_per_particle = 2;
  static constexpr double particles_per_slot = 4;
  static constexpr std::size_t least_counted = 8;
  static constexpr std::int64_t changes_per_particle = 64;
  static constexpr std::size_t arity = 4;
  static constexpr std::size_t remembered = 64;  // announcements
  static constexpr double narrowest = 1e-300;    // of one slot: its inverse stays finite

  /// Neighbours in a circular list. The particles come first, then the heads of the slots. A particle
  /// that is in the heap keeps its place there in `next`.
  struct Link {
    Index next = 0, previous = 0;
  };
  struct Entry {
    double time = never;
    Index particle = 0;
  };

  static bool before(const Entry& one, const Entry& two) {
    return one.time < two.time || (one.time == two.time && one.particle < two.particle);
  }

  // It never decreases with time, so that slots are in order whatever the rounding.
  Index slot_of(double time) const {
    const double slot = std::max((time - begin_) * slots_per_time_, 0.0);
    return static_cast<Index>(std::min(slot, static_cast<double>(slots_)));
  }

  Index head_of(Index slot) const { return static_cast<Index>(time_.size()) + slot; }

  void link(Index particle, Index slot) {
    const Index head = head_of(slot);
    const Index next = links_[head].next;
    links_[particle] = {next, head};
    links_[head].next = particle;
    links_[next].previous = particle;
  }

  void unlink(Index particle) {
    const Link old = links_[particle];
    links_[old.next].previous = old.previous;
    links_[old.previous].next = old.next;
  }

  void link_all() {
    const Index end = head_of(slots_);
    for (Index head = head_of(0); head <= end; ++head) links_[head] = {head, head};
    for (Index i = 0; i < time_.size(); ++i) link(i, slot_of(time_[i]));
  }

  // Until enough are due; nobody is if nothing is planned.
  void open_slots() {
    if (changes_left_ <= 0) renew_window();
    while (due_.size() < foresight_) {
      if (opened_ == slots_ && due_.empty()) renew_window();
      if (opened_ == slots_) return;
      open(opened_++);
    }
  }

  void open(Index slot) {
    const Index head = head_of(slot);
    for (Index i = links_[head].next; i != head;) {
      const Index next = links_[i].next;
      add_to_heap({time_[i], i});
      announced_[announcements_++ % remembered] = i;
      i = next;
    }
  }

  void renew_window() {
    due_.clear();
    changes_left_ = changes_per_particle * static_cast<std::int64_t>(time_.size());
    place_window();
    link_all();
  }

  void place_window() {
    std::vector<double> planned;
    planned.reserve(time_.size());
    std::copy_if(time_.begin(), time_.end(), std::back_inserter(planned),
                 [](double time) { return time < never; });
    opened_ = planned.empty() ? slots_ : 0;
    begin_ = -never;  // everything is later than the window
    if (planned.empty()) return;
    const std::size_t counted = std::min(planned.size() - 1, least_counted + planned.size() / 8);
    const auto last = planned.begin() + static_cast<std::ptrdiff_t>(counted);
    std::nth_element(planned.begin(), last, planned.end());
    begin_ = *std::min_element(planned.begin(), last + 1);
    const double width = particles_per_slot * (*last - begin_) / static_cast<double>(counted + 1);
    slots_per_time_ = 1 / std::max(width, narrowest);
  }

  void put(std::size_t place, const Entry& entry) {
    due_[place] = entry;
    links_[entry.particle].next = static_cast<Index>(place);
  }

  void add_to_heap(const Entry& entry) {
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
  Index slots_;   // of the window
  Index opened_;  // of these
  double begin_ = -never;
  double slots_per_time_ = 1;
  std::int64_t changes_left_ = 1;  // until the window is renewed
  std::vector<double> time_;
  std::vector<Link> links_;
  std::vector<Entry> due_;  // the heap
};

}  // namespace vitrel
