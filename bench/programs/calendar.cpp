// Which calendar is cheapest, from a hundred to a million particles?
//
// Every calendar is driven by the same model of the event loop. Particles are on a square lattice. The
// earliest event is a collision (one half), after which two neighbours and sometimes particles around
// them are rescheduled; or a stale event (a quarter), after which only the particle itself is
// rescheduled; or a repeated contact screen (a quarter), after which it is rescheduled within a tenth of
// the usual waiting time. Waiting times are exponential. Rescheduling reads the times of seven
// neighbours and 64 bytes of each. The same loop without a calendar is timed as well, and its time is
// subtracted. Neighbours are near in memory, as after sorting, or anywhere, as in a liquid after a long
// time.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "app/terminal/session.h"
#include "bench/baselines/heap_calendar.h"
#include "bench/baselines/sorted_calendar.h"
#include "bench/baselines/tournament_calendar.h"
#include "bench/programs/programs.h"
#include "core/random/stream.h"
#include "edmd/calendar.h"

namespace vitrel::bench {
namespace {

/// Costs nothing and knows nothing: what is left is the loop itself.
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

/// Where everything stands in memory.
struct Scene {
  static constexpr std::size_t neighbors = 8;
  struct alignas(64) Record {
    std::array<double, 8> value{};
  };

  Scene(std::size_t n, bool shuffled) : records(n), around(n) {
    std::vector<std::uint32_t> index(n);
    std::iota(index.begin(), index.end(), 0U);
    Stream draw(n, Purpose::benchmark_cases);
    for (std::size_t k = n; shuffled && k > 1; --k) std::swap(index[k - 1], index[draw.below(k)]);
    const auto row = static_cast<std::size_t>(std::sqrt(static_cast<double>(n)));
    const std::array<std::size_t, neighbors> steps = {1,       n - 1,       row,     n - row,
                                                      row + 1, n - row - 1, row - 1, n - row + 1};
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t q = 0; q < neighbors; ++q) around[index[k]][q] = index[(k + steps[q]) % n];
  }

  std::vector<Record> records;
  std::vector<std::array<std::uint32_t, neighbors>> around;
};

/// Cheap enough not to be seen beside the calendar (Marsaglia's xorshift; waiting times by a table).
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
    const std::clock_t start = std::clock();  // of this process: others do not count
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

void measure(std::size_t n, bool shuffled, int repeats) {
  Scene scene(n, shuffled);
  Loop<NoCalendar> nothing(scene);
  std::tuple<Loop<Calendar>, Loop<HeapCalendar>, Loop<TournamentCalendar>, Loop<SortedCalendar>>
      loops{scene, scene, scene, scene};
  // Longer than a window of the calendar (some 9 N), so that every run has its share of renewals.
  const std::uint64_t events = std::max<std::uint64_t>(200'000, 10 * n);
  const auto each = [&](auto&& act) {
    std::apply([&](auto&... loop) { (act(loop), ...); }, loops);
  };
  each([&](auto& loop) { loop.run(2 * n); });
  for (int k = 0; k < repeats; ++k) {
    nothing.run_timed(events);
    each([&](auto& loop) { loop.run_timed(events); });
  }
  const auto& fast = std::get<0>(loops);
  each([&, now = fast.now()](const auto& loop) {
    if (loop.now() != now) throw std::logic_error("two calendars disagree about the same run");
  });
  const double rest = nothing.ns_per_event();
  const double ours = fast.ns_per_event() - rest;
  std::string row = fmt::format("| {:>8} | {:>8} | {:>5.0f} | {:>5.0f} |", n,
                                shuffled ? "anywhere" : "near", rest, ours);
  each([&](const auto& loop) {
    if (&loop == static_cast<const void*>(&fast)) return;
    const double theirs = loop.ns_per_event() - rest;
    row += fmt::format(" {:>5.0f} ({:>4.1f}) |", theirs, theirs / ours);
  });
  // What was read counts as used, or the reading would be left out.
  print_text(row + (std::isnan(fast.seen() + nothing.seen()) ? " nan\n" : "\n"));
}

}  // namespace

int calendar(const CalendarOptions& options) {
  print_text(
      "ns per event; in brackets: relative to the calendar of the engine\n\n"
      "| N | neighbours | loop alone | calendar | heap | tournament | sorted set |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n");
  for (std::size_t n = 100; n <= options.largest; n *= 10)
    for (const bool shuffled : {false, true}) measure(n, shuffled, options.repeats);
  return 0;
}

}  // namespace vitrel::bench
