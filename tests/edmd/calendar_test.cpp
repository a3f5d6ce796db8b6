#include <gtest/gtest.h>

#include <set>

#include "core/random/stream.h"
#include "edmd/calendar.h"

namespace vitrel {
namespace {

// The slow twin: a sorted set of (time, particle).
class SortedCalendar {
 public:
  explicit SortedCalendar(std::size_t n) : time_(n, std::numeric_limits<double>::infinity()) {
    for (std::size_t i = 0; i < n; ++i) order_.insert({time_[i], i});
  }
  void set(std::size_t i, double time) {
    order_.erase({time_[i], i});
    time_[i] = time;
    order_.insert({time, i});
  }
  std::size_t earliest() const { return order_.begin()->second; }

 private:
  std::vector<double> time_;
  std::set<std::pair<double, std::size_t>> order_;
};

TEST(Calendar, EqualsASortedSetThroughRandomChanges) {
  for (std::size_t n : {1, 2, 5, 17, 300}) {
    Calendar calendar(n);
    SortedCalendar sorted(n);
    Stream draw(n, Purpose::tests);
    for (int change = 0; change < 20'000; ++change) {
      const std::size_t i = draw.below(n);
      // Few distinct times, so that ties are common.
      const double time = static_cast<double>(draw.below(50));
      calendar.set(i, time);
      sorted.set(i, time);
      ASSERT_EQ(calendar.earliest(), sorted.earliest());
      ASSERT_EQ(calendar.time(i), time);
    }
  }
}

TEST(Calendar, StartsWithNothingPlanned) {
  const Calendar calendar(3);
  EXPECT_EQ(calendar.time(calendar.earliest()), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace vitrel
