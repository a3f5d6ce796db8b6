#include "bench/surveys/recorded_class.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>

#include "bench/baselines/method_engine.h"
#include "bench/surveys/engine_speed.h"
#include "edmd/brownian.h"
#include "mc/insertion.h"
#include "mc/swelling.h"

namespace vitrel::bench {
namespace {

constexpr std::size_t particles = 256;
constexpr double packing_fraction = 0.7;
// 50 collisions per particle; each collision involves two particles.
constexpr std::uint64_t collisions_before = 50 * particles / 2;

Configuration2 prepared(double aspect_ratio, std::uint64_t seed) {
  Configuration2 c;
  c.resize(particles);
  c.species_names = {"A"};
  std::ranges::fill(c.shape, of_unit_area(aspect_ratio));
  const double length = std::sqrt(particles * std::numbers::pi / packing_fraction);
  c.box = PeriodicBox<2>(Vec2(length, length));
  must_reach(insert_particles(c, {}, seed, {}));
  SwellingState swelling;
  must_reach(swell(c, {packing_fraction}, seed, swelling, {}));
  set_initial_velocities(c, seed, InitialVelocities::maxwell, Temperature::total);
  return c;
}

/// A state of the run after its first transient.
Configuration2 running(double aspect_ratio, std::uint64_t seed) {
  Configuration2 c = prepared(aspect_ratio, seed);
  const auto engine = make_engine(c, {});
  RunCounters counters;
  while (counters.collisions < collisions_before) {
    engine->load(c);
    engine->advance(std::numeric_limits<double>::infinity(), counters);
    engine->write(c);
  }
  return c;
}

/// One run and the predictions that it has requested so far.
class Recording {
 public:
  explicit Recording(double aspect_ratio) : aspect_ratio_(aspect_ratio) {}

  CollisionCase at(std::uint64_t seed, std::uint64_t index) {
    const std::lock_guard lock(mutex_);
    if (seed != seed_) {
      start_ = running(aspect_ratio_, seed);
      cases_.clear();
      seed_ = seed;
    }
    // If there are too few cases, all are recorded again from the start: the same ones, followed by more.
    constexpr std::uint64_t least = 8192;
    if (index >= cases_.size())
      cases_ = recorded_cases(start_, std::max(least, std::bit_ceil(index + 1)));
    return cases_[index];
  }

 private:
  double aspect_ratio_;
  std::mutex mutex_;
  std::optional<std::uint64_t> seed_;
  Configuration2 start_;
  std::vector<CollisionCase> cases_;
};

}  // namespace

std::vector<CaseClass> recorded_classes() {
  std::vector<CaseClass> list;
  for (const double aspect_ratio : {2.0, 6.0}) {
    const auto recording = std::make_shared<Recording>(aspect_ratio);
    list.push_back({"recorded", aspect_ratio, [recording](std::uint64_t seed, std::uint64_t index) {
                      return recording->at(seed, index);
                    }});
  }
  return list;
}

}  // namespace vitrel::bench
