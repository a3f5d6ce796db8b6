#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "bench/surveys/engine_speed.h"
#include "core/io/json.h"

namespace vitrel::bench {

/// Measurements of work that was repeated in alternation with other work.
class Repeats {
 public:
  void add(const Work& work) { works_.push_back(work); }
  double last_seconds() const { return works_.back().seconds; }

  /// The best time, the median, and the counts per collision over all repeats.
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

template <int Dim>
using MakeEngine = std::function<std::unique_ptr<Engine<Dim>>()>;
template <int Dim>
using MadeEngines = std::vector<std::pair<std::string, MakeEngine<Dim>>>;

/// Runs the engines in turns from the same state. The result has a row for each engine, with its name as method, and
/// its times and counts.
template <int Dim>
Json alternating_runs(const Configuration<Dim>& start, const MadeEngines<Dim>& engines, int repeats,
                      double min_seconds) {
  std::vector<TimedRun<Dim>> runs;
  for (const auto& [name, make] : engines) runs.emplace_back(make(), start);
  std::vector<Repeats> of(runs.size());
  for (int k = 0; k < repeats; ++k)
    for (std::size_t n = 0; n < runs.size(); ++n) of[n].add(runs[n].blocks(min_seconds));
  Json rows = Json::array();
  for (std::size_t n = 0; n < runs.size(); ++n) {
    rows.push_back(of[n].json());
    rows.back()["method"] = engines[n].first;
  }
  return rows;
}

}  // namespace vitrel::bench
