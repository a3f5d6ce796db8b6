#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "bench/surveys/engine_speed.h"
#include "core/io/json.h"

namespace vitrel::bench {

/// Work that was done several times, here and there in alternation with other work.
class Repeats {
 public:
  void add(const Work& work) { works_.push_back(work); }
  double last_seconds() const { return works_.back().seconds; }

  /// The best time, the median, and counts per collision over all.
  Json json() const {
    std::vector<double> times;
    Work sum;
    for (const Work& work : works_) {
      times.push_back(work.ns_per_collision());
      sum.simulated_time += work.simulated_time;
      sum.counters.events += work.counters.events;
      sum.counters.collisions += work.counters.collisions;
      sum.counters.list_updates += work.counters.list_updates;
      sum.counters.virial += work.counters.virial;
      sum.counters.add_predictions(work.counters);
    }
    std::ranges::sort(times);
    const RunCounters& of = sum.counters;
    const auto per_collision = [&](std::uint64_t count) {
      return static_cast<double>(count) / static_cast<double>(of.collisions);
    };
    return {{"ns_per_collision", times.front()},
            {"median_ns_per_collision", times[times.size() / 2]},
            {"collisions", of.collisions},
            {"collision_rate", static_cast<double>(of.collisions) / sum.simulated_time},
            {"virial_rate", of.virial / sum.simulated_time},
            {"events", per_collision(of.events)},
            {"predictions", per_collision(of.predictions)},
            {"searches", per_collision(of.searches)},
            {"steps", per_collision(of.steps)},
            {"renewals", per_collision(of.list_updates)}};
  }

 private:
  std::vector<Work> works_;
};

}  // namespace vitrel::bench
