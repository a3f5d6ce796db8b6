#include "edmd/calendar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "bench/baselines/heap_calendar.h"
#include "core/random/stream.h"

namespace vitrel {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// The slow reference: a sorted set of (time, particle).
class SortedCalendar {
 public:
  explicit SortedCalendar(std::size_t particles) : time_(particles, never) {
    for (std::size_t i = 0; i < particles; ++i) order_.insert({never, i});
  }

  std::size_t size() const { return time_.size(); }
  double time(std::size_t particle) const { return time_[particle]; }
  std::size_t earliest() const { return order_.begin()->second; }
  void set(std::size_t particle, double time) {
    order_.erase({time_[particle], particle});
    time_[particle] = time;
    order_.insert({time, particle});
  }

 private:
  std::vector<double> time_;
  std::set<std::pair<double, std::size_t>> order_;
};

/// A calendar and its slow reference, with the same changes applied to both.
template <class C>
class CalendarPair {
 public:
  explicit CalendarPair(std::size_t n) : fast_(n), slow_(n) {}

  void set(std::size_t i, double time) {
    fast_.set(i, time);
    slow_.set(i, time);
  }
  std::size_t earliest() {
    const std::size_t i = slow_.earliest();
    EXPECT_EQ(fast_.earliest(), i);
    EXPECT_EQ(fast_.time(i), slow_.time(i));
    return i;
  }
  double time(std::size_t i) const { return slow_.time(i); }
  bool all_times_agree() const {
    for (std::size_t i = 0; i < slow_.size(); ++i)
      if (fast_.time(i) != slow_.time(i)) return false;
    return fast_.size() == slow_.size();
  }

 private:
  C fast_;
  SortedCalendar slow_;
};

template <class C>
class CalendarTest : public testing::Test {
 protected:
  const std::vector<std::size_t> sizes_ = {1, 2, 3, 5, 8, 9, 17, 64, 65, 1000};
};

/// One that looks ahead.
struct ForesightedCalendar : Calendar {
  explicit ForesightedCalendar(std::size_t n) : Calendar(n, 5) {}
};

using Calendars = testing::Types<Calendar, ForesightedCalendar, bench::HeapCalendar>;
TYPED_TEST_SUITE(CalendarTest, Calendars, );

// Waiting times as a run draws them.
double exponential(Stream& draw) {
  return -std::log1p(-draw.uniform());
}

TYPED_TEST(CalendarTest, NothingIsPlannedAtTheStart) {
  for (const std::size_t n : this->sizes_) {
    TypeParam calendar(n);
    ASSERT_EQ(calendar.size(), n);
    EXPECT_EQ(calendar.earliest(), 0U);
    for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(calendar.time(i), never);
  }
}

TYPED_TEST(CalendarTest, EqualTimesAreInOrderOfParticles) {
  for (const std::size_t n : this->sizes_) {
    TypeParam calendar(n);
    for (std::size_t i = n; i-- > 0;) calendar.set(i, 1);
    for (std::size_t i = 0; i < n; ++i) {
      ASSERT_EQ(calendar.earliest(), i);
      calendar.set(i, 2);
    }
    ASSERT_EQ(calendar.earliest(), 0U);
  }
}

TYPED_TEST(CalendarTest, OrderOfTimesSetInAnyOrder) {
  Stream draw(3, Purpose::tests);
  for (const std::size_t n : this->sizes_) {
    std::vector<double> times(n);
    for (double& time : times) time = std::exp(draw.uniform(-28, 14));  // 1e-12 … 1e6
    TypeParam calendar(n);
    for (std::size_t i = 0; i < n; ++i) calendar.set(i, times[i]);
    std::sort(times.begin(), times.end());
    for (const double time : times) {
      const std::size_t i = calendar.earliest();
      ASSERT_EQ(calendar.time(i), time);
      calendar.set(i, never);
    }
    EXPECT_EQ(calendar.earliest(), 0U);
  }
}

// Few distinct times, so that ties are common, and not in order of time: the present does not exist.
TYPED_TEST(CalendarTest, EqualsASortedSetThroughUnorderedChanges) {
  for (const std::size_t n : this->sizes_) {
    CalendarPair<TypeParam> both(n);
    Stream draw(n, Purpose::tests, 1);
    for (int change = 0; change < 20'000; ++change) {
      const std::uint64_t time = draw.below(50);
      both.set(draw.below(n), time < 40 ? static_cast<double>(time) : never);
      if (draw.below(3) == 0) both.earliest();
    }
    EXPECT_TRUE(both.all_times_agree());
    ASSERT_FALSE(this->HasFailure());
  }
}

// As the event loop does it: the earliest is always changed, often to the same time or a little later,
// often never; some others become sooner or later.
TYPED_TEST(CalendarTest, EqualsASortedSetThroughARun) {
  for (const std::size_t n : this->sizes_) {
    CalendarPair<TypeParam> both(n);
    Stream draw(n, Purpose::tests, 2);
    for (std::size_t i = 0; i < n; ++i) both.set(i, exponential(draw));
    double now = 0;
    for (int event = 0; event < 30'000; ++event) {
      const std::size_t i = both.earliest();
      const double next = both.time(i);
      ASSERT_GE(next, now);
      if (next < never) now = next;
      const std::uint64_t kind = draw.below(8);
      const double wait = kind == 0 ? 0 : kind == 1 ? 1e-9 : exponential(draw);
      both.set(i, kind == 2 ? never : now + wait);
      for (std::uint64_t more = draw.below(4); more > 0; --more) {
        const std::size_t other = draw.below(n);
        both.set(other, draw.below(10) == 0 ? never : now + exponential(draw));
      }
    }
    EXPECT_TRUE(both.all_times_agree());
    ASSERT_FALSE(this->HasFailure());
  }
}

// The rate of events jumps by many orders of magnitude, up and down.
TYPED_TEST(CalendarTest, EqualsASortedSetWhenTheScaleOfTimeChanges) {
  for (const std::size_t n : {2, 17, 300}) {
    CalendarPair<TypeParam> both(n);
    Stream draw(n, Purpose::tests, 3);
    double now = 0;
    for (const double scale : {1.0, 1e-12, 1e6, 1e-6, 1e3, 0.0, 1e-3}) {
      for (std::size_t event = 0; event < 100 * n; ++event) {
        const std::size_t i = both.earliest();
        if (both.time(i) < never) now = both.time(i);
        both.set(i, now + scale * exponential(draw));
        const std::size_t other = draw.below(n);
        both.set(other, now + scale * exponential(draw));
      }
      ASSERT_FALSE(this->HasFailure());
    }
    EXPECT_TRUE(both.all_times_agree());
  }
}

TYPED_TEST(CalendarTest, EqualsASortedSetOverAMillionEventsOfManyParticles) {
  const std::size_t n = 20'000;
  CalendarPair<TypeParam> both(n);
  Stream draw(n, Purpose::tests, 4);
  for (std::size_t i = 0; i < n; ++i) both.set(i, exponential(draw));
  for (int event = 0; event < 500'000; ++event) {
    const std::size_t i = both.earliest();
    const double now = both.time(i);
    both.set(i, now + exponential(draw));
    const std::size_t other = (i + draw.below(100)) % n;
    both.set(other, now + exponential(draw));
  }
  EXPECT_TRUE(both.all_times_agree());
}

// Whatever was planned in between, the order is that of the times alone.
TYPED_TEST(CalendarTest, OrderDoesNotDependOnHistory) {
  const std::size_t n = 200;
  Stream draw(5, Purpose::tests);
  TypeParam fresh(n), used(n);
  for (int change = 0; change < 10'000; ++change) {
    const std::size_t i = draw.below(n);
    used.set(i, draw.uniform());
    if (change % 7 == 0) used.set(used.earliest(), 1 + draw.uniform());
  }
  for (std::size_t i = 0; i < n; ++i) {
    const auto time = static_cast<double>(draw.below(20));
    fresh.set(i, time);
    used.set(n - 1 - i, 100);
    used.set(i, time);
  }
  for (std::size_t i = 0; i < n; ++i) used.set(i, fresh.time(i));
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = fresh.earliest();
    ASSERT_EQ(used.earliest(), i);
    fresh.set(i, never);
    used.set(i, never);
  }
}

// A thousand particles with one event per unit of time each. Whoever comes was upcoming, and mostly
// some events before, unless it was planned so late that it came at once.
TEST(Calendar, AnnouncesWhoComesSoon) {
  const std::size_t n = 1000, lookahead = 5;
  constexpr double soon = 0.03;  // thirty events
  Calendar calendar(n, lookahead);
  Stream draw(8, Purpose::tests);
  for (std::size_t i = 0; i < n; ++i) calendar.set(i, exponential(draw));
  std::vector<double> planned_at(n, 0), announced_at(n, -1);
  std::uint64_t heard = 0, foreseen = 0;
  double now = 0;
  constexpr int events = 20'000;
  for (int event = 0; event < events; ++event) {
    const std::size_t i = calendar.earliest();
    for (; heard < calendar.upcoming_count(); ++heard)
      announced_at[calendar.upcoming(heard)] = event;
    now = calendar.time(i);
    if (now - planned_at[i] > soon) {
      ASSERT_GE(announced_at[i], 0);
    }
    foreseen += announced_at[i] >= 0 && event - announced_at[i] >= static_cast<int>(lookahead) - 1;
    announced_at[i] = -1;
    planned_at[i] = now;
    calendar.set(i, now + exponential(draw));
  }
  EXPECT_GT(foreseen, 0.9 * events);
}

}  // namespace
}  // namespace vitrel
