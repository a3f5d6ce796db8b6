// The same model of the event loop drives every calendar. Particles are on a square lattice. Half of the earliest
// events are collisions, after which two neighbours, and sometimes particles around them, are rescheduled. A quarter
// are stale events, after which only the particle itself is rescheduled. A quarter are repeated contact screens,
// after which the particle is rescheduled within a tenth of the usual waiting time. Waiting times are exponential.
// Rescheduling reads the times of seven neighbours and 64 bytes of each. The same loop without a calendar is timed as
// well, and its time is subtracted. Neighbours are anywhere in memory, as in a liquid after a long time.

#include "bench/studies/calendar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bench/baselines/heap_calendar.h"
#include "core/random/stream.h"
#include "edmd/calendar.h"

namespace vitrel::bench {
namespace {

/// A calendar that costs and stores nothing, so that only the loop itself remains.
class NoCalendar {
 public:
  explicit NoCalendar(std::size_t particles) : particles_(particles) {}
  double time(std::size_t) const { return time_; }
  std::size_t earliest() {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return ((state_ >> 32) * particles_) >> 32;
  }
  void set(std::size_t, double time) { time_ = std::min(time_ + 1e-9, time); }

 private:
  std::size_t particles_;
  std::uint64_t state_ = 1;
  double time_ = 0;
};

/// The places of particles in memory.
struct Scene {
  static constexpr std::size_t neighbors = 8;
  struct alignas(64) Record {
    std::array<double, 8> value{};
  };

  explicit Scene(std::size_t n) : records(n), around(n) {
    std::vector<std::uint32_t> index(n);
    std::iota(index.begin(), index.end(), 0U);
    Stream draw(n, Purpose::benchmark_cases);
    for (std::size_t k = n; k > 1; --k) std::swap(index[k - 1], index[draw.below(k)]);
    const auto row = static_cast<std::size_t>(std::sqrt(static_cast<double>(n)));
    const std::array<std::size_t, neighbors> steps = {1,       n - 1,       row,     n - row,
                                                      row + 1, n - row - 1, row - 1, n - row + 1};
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t q = 0; q < neighbors; ++q) around[index[k]][q] = index[(k + steps[q]) % n];
  }

  std::vector<Record> records;
  std::vector<std::array<std::uint32_t, neighbors>> around;
};

/// Random numbers whose cost is negligible beside that of the calendar (Marsaglia's xorshift; waiting times from a
/// table).
class Draws {
 public:
  Draws() {
    for (std::size_t k = 0; k < waits_.size(); ++k)
      waits_[k] = -std::log((static_cast<double>(k) + 0.5) / static_cast<double>(waits_.size()));
  }
  std::uint64_t bits() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return state_;
  }
  double wait() {
    const std::uint64_t drawn = bits();
    return waits_[drawn % waits_.size()] * (1 + 1e-7 * static_cast<double>(drawn >> 48));
  }

 private:
  std::uint64_t state_ = 88172645463325252;
  std::array<double, 1024> waits_{};
};

template <class C>
class Loop {
 public:
  explicit Loop(Scene& scene) : scene_(&scene), calendar_(scene.records.size()) {
    for (std::size_t i = 0; i < scene.records.size(); ++i) calendar_.set(i, draws_.wait());
  }

  void run(std::uint64_t events) {
    for (std::uint64_t k = 0; k < events; ++k) process(calendar_.earliest());
  }

  void run_timed(std::uint64_t events) {
    const std::clock_t start = std::clock();  // of this process, so that others do not count
    run(events);
    const double spent = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    best_ = std::min(best_, 1e9 * spent / static_cast<double>(events));
  }

  double ns_per_event() const { return best_; }
  double now() const { return now_; }
  double seen() const { return seen_; }

 private:
  void process(std::size_t i) {
    now_ = calendar_.time(i);
    const std::uint64_t drawn = draws_.bits();
    const std::uint64_t kind = drawn % 4;
    plan(i, kind == 0 ? 0.1 : 1);
    if (kind < 2) return;
    const std::size_t j = neighbor(i, drawn >> 8);
    plan(j, 1);
    for (const int digit : {16, 24, 32})
      if ((drawn >> digit) % 256 < 77) plan(neighbor(j, drawn >> (digit + 24)), 1);
  }

  void plan(std::size_t i, double scale) {
    for (std::size_t q = 0; q + 1 < Scene::neighbors; ++q) {
      const std::size_t j = scene_->around[i][q];
      seen_ += scene_->records[j].value[q] + std::min(calendar_.time(j), now_);
    }
    scene_->records[i].value[0] = now_;
    calendar_.set(i, now_ + scale * draws_.wait());
  }

  std::size_t neighbor(std::size_t i, std::uint64_t which) const {
    return scene_->around[i][which % Scene::neighbors];
  }

  Scene* scene_;
  C calendar_;
  Draws draws_;
  double now_ = 0;
  double seen_ = 0;
  double best_ = std::numeric_limits<double>::infinity();
};

void measure(std::size_t n, int repeats, Json& rows) {
  Scene scene(n);
  Loop<NoCalendar> nothing(scene);
  Loop<Calendar> calendar(scene);
  Loop<HeapCalendar> heap(scene);
  // More events than a window of the calendar holds (some 9 N), so that every run has its share of renewals.
  const std::uint64_t events = std::max<std::uint64_t>(200'000, 10 * n);
  calendar.run(2 * n);
  heap.run(2 * n);
  for (int k = 0; k < repeats; ++k) {
    nothing.run_timed(events);
    calendar.run_timed(events);
    heap.run_timed(events);
  }
  if (calendar.now() != heap.now())
    throw std::logic_error("two calendars disagree about the same run");
  // This uses the values that were read, so that the compiler keeps the reading.
  if (std::isnan(calendar.seen() + nothing.seen())) throw std::logic_error("a time is no number");
  for (const auto& [name, ns] :
       {std::pair("calendar", calendar.ns_per_event()), std::pair("heap", heap.ns_per_event())})
    rows.push_back({{"method", name},
                    {"particles", n},
                    {"ns_per_event", ns - nothing.ns_per_event()},
                    {"loop", nothing.ns_per_event()}});
}

Json measure_calendars(const StudyContext& context) {
  const std::size_t largest = context.options.quick ? 1000 : 1'000'000;
  Json rows = Json::array();
  for (std::size_t n = 100; n <= largest && !context.control.stop_requested(); n *= 10)
    measure(n, context.options.quick ? 1 : 5, rows);
  return rows;
}

}  // namespace

Part calendar_part() {
  return {.name = "calendar",
          .about =
              "The queue of the engine beside a 4-ary heap, in turns, in the same model of the "
              "event loop; the time of the loop without a calendar is subtracted. Neighbours are "
              "anywhere in memory.",
          .measure = measure_calendars,
          .cases = {},
          .cost = {"ns_per_event", "time per event", Shown::time},
          .others = {{"loop", "loop alone", Shown::time}},
          .varied = "particles"};
}

}  // namespace vitrel::bench
