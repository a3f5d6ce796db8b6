#pragma once

#include <cstddef>
#include <limits>
#include <set>
#include <utility>
#include <vector>

namespace vitrel::bench {

/// The baseline of Calendar: a sorted set of (time, particle).
class SortedCalendar {
 public:
  explicit SortedCalendar(std::size_t particles)
      : time_(particles, std::numeric_limits<double>::infinity()) {
    for (std::size_t i = 0; i < particles; ++i) order_.insert({time_[i], i});
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

}  // namespace vitrel::bench
