// How fast is Monte Carlo sampling, and what is the speed-up by two threads and by overlap batches?
//
// Prints JSON. scripts/validate sampler builds and runs this, compares with what is wanted, and
// writes the page, sampler.md.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bench/baselines/sequential_sampler.h"
#include "bench/programs/parts.h"
#include "bench/surveys/engine_speed.h"
#include "core/contact/ellipse_gap.h"
#include "core/contact/ellipse_overlap_batch.h"
#include "core/error.h"
#include "core/io/json.h"
#include "core/neighbors/pairs.h"
#include "core/random/stream.h"
#include "core/state/species.h"
#include "mc/hard_core.h"
#include "mc/insertion.h"
#include "mc/sampler.h"
#include "mc/swelling.h"

namespace vitrel::bench {
namespace {

/// How much is measured, and for how long.
struct Effort {
  int particles = 1024;
  int stretches = 40;
  double stretch = 0.05;  // seconds, at least
  int tile = 1000, tiles = 10;
  int questions = 20'000;
};
const Effort quick{64, 2, 0.001, 36, 3, 500};

constexpr double wanted_acceptance = 0.3;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double ratio(std::uint64_t part, std::uint64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0;
}

struct Steps {
  double translation = 0.3, rotation = 0.3;
};

struct Acceptance {
  double translation, rotation;
};

Acceptance acceptance(const TrialCounts& before, const TrialCounts& after) {
  return {ratio(after.translations_accepted - before.translations_accepted,
                after.translations_tried - before.translations_tried),
          ratio(after.rotations_accepted - before.rotations_accepted,
                after.rotations_tried - before.rotations_tried)};
}

/// Steps at which the wanted share of both kinds of moves is accepted. A turn of more than π is none.
template <class AnySampler>
Steps fitting_steps(AnySampler& sampler, int sweeps) {
  Steps steps;
  const auto adapted = [](double step, double found) {
    return step * std::clamp(found / wanted_acceptance, 0.5, 2.);
  };
  for (int round = 0; round < 20; ++round) {
    sampler.set_steps(steps.translation, steps.rotation);
    const TrialCounts before = sampler.counts();
    for (int k = 0; k < sweeps; ++k) sampler.sweep();
    const Acceptance found = acceptance(before, sampler.counts());
    steps.translation = adapted(steps.translation, found.translation);
    steps.rotation = std::min(std::numbers::pi, adapted(steps.rotation, found.rotation));
  }
  sampler.set_steps(steps.translation, steps.rotation);
  return steps;
}

/// Stretches of whole sweeps, the fastest and the median.
class Stretches {
 public:
  template <class AnySampler>
  void add(AnySampler& sampler, std::size_t particles, double min_seconds) {
    const double start = seconds_now();
    double seconds = 0;
    std::uint64_t sweeps = 0;
    do {
      sampler.sweep();
      ++sweeps;
      seconds = seconds_now() - start;
    } while (seconds < min_seconds);
    ns_.push_back(1e9 * seconds / static_cast<double>(sweeps * particles));
  }

  Json json() {
    std::ranges::sort(ns_);
    return {{"ns_per_trial", ns_.front()}, {"median_ns_per_trial", ns_[ns_.size() / 2]}};
  }

 private:
  std::vector<double> ns_;
};

std::vector<FluidScene> scenes(const Effort& effort) {
  std::vector<FluidScene> all;
  for (const double kappa : {1., 2., 6.})
    for (const double phi : {0.5, 0.7}) all.push_back({effort.particles, kappa, phi});
  return all;
}

// ---- trials per second, beside the plain way ----------------------------------------------------------

Json measure_speed(const Effort& effort) {
  Json rows = Json::array();
  for (const FluidScene& scene : scenes(effort)) {
    say(fmt::format("speed: kappa = {}, phi = {}", scene.aspect_ratio, scene.packing_fraction));
    Configuration2 ours = fluid(scene), plain = ours;
    Sampler sampler(ours, 1);
    SequentialSampler baseline(plain, 1);
    const Steps steps = fitting_steps(sampler, 20);
    baseline.set_steps(steps.translation, steps.rotation);
    const TrialCounts before = sampler.counts(), baseline_before = baseline.counts();
    const OverlapTestCounts tests = sampler.overlap_tests();
    const std::uint64_t decisions = baseline.decisions();
    Stretches of_ours, of_baseline;
    for (int k = 0; k < effort.stretches; ++k) {
      of_ours.add(sampler, ours.size(), effort.stretch);
      of_baseline.add(baseline, plain.size(), effort.stretch);
    }
    const auto trials = [](const TrialCounts& from, const TrialCounts& to) {
      return to.tried() - from.tried();
    };
    const std::uint64_t tried = trials(before, sampler.counts());
    const Acceptance accepted = acceptance(before, sampler.counts());
    const Acceptance baseline_accepted = acceptance(baseline_before, baseline.counts());
    Json row = scene_json(scene);
    row.update(of_ours.json());
    row["translation_step"] = steps.translation;
    row["rotation_step"] = steps.rotation;
    row["translations_accepted"] = accepted.translation;
    row["rotations_accepted"] = accepted.rotation;
    row["groups"] = ratio(sampler.overlap_tests().batches - tests.batches, tried);
    row["single"] = ratio(sampler.overlap_tests().scalar_pairs - tests.scalar_pairs, tried);
    row["plain"] = of_baseline.json();
    row["plain"]["translations_accepted"] = baseline_accepted.translation;
    row["plain"]["rotations_accepted"] = baseline_accepted.rotation;
    row["plain"]["decisions"] =
        ratio(baseline.decisions() - decisions, trials(baseline_before, baseline.counts()));
    rows.push_back(row);
  }
  return rows;
}

// ---- threads --------------------------------------------------------------------------------------------

Json measure_threads(const Effort& effort) {
  Json rows = Json::array();
  for (const double kappa : {2., 6.}) {
    FluidScene scene{effort.tile, kappa, 0.5};
    const Configuration2 start = tiled(fluid(scene), effort.tiles, effort.tiles);
    scene.particles = static_cast<int>(start.size());
    say(fmt::format("threads: kappa = {}, N = {}", kappa, scene.particles));
    Configuration2 first = start, second = start;
    Sampler one(first, 1, {}, 1), two(second, 1, {}, 2);
    const Steps steps = fitting_steps(one, 2);
    two.set_steps(steps.translation, steps.rotation);
    Stretches of_one, of_two;
    for (int k = 0; k < effort.stretches; ++k) {
      of_one.add(one, start.size(), effort.stretch);
      of_two.add(two, start.size(), effort.stretch);
    }
    Json row = scene_json(scene);
    row["one"] = of_one.json();
    row["two"] = of_two.json();
    rows.push_back(row);
  }
  return rows;
}

// ---- overlap batches ------------------------------------------------------------------------------------

/// A trial and all particles within its reach.
struct Question {
  Ellipse shape;
  Vec2 axis;
  std::vector<EllipseBatch> groups;
  int others = 0;
};

/// The overlap tests of trials in this state.
std::vector<Question> questions(const Configuration2& c, const Steps& steps, int count) {
  const CellGrid<2> cells = make_cells(c);
  Stream draw(5, Purpose::benchmark_cases);
  std::vector<Question> all;
  const auto plus_minus = [&](double step) { return draw.uniform(-step, step); };
  for (int k = 0; k < count; ++k) {
    const std::size_t i = draw.below(c.size());
    const bool turns = !c.shape[i].is_round() && draw.below(2) == 1;
    Vec2 position = c.position[i];
    if (!turns) {
      const double y = plus_minus(steps.translation), x = plus_minus(steps.translation);
      position += Vec2(x, y);
    }
    Question question{
        c.shape[i], direction(c.angle[i] + (turns ? plus_minus(steps.rotation) : 0)), {}};
    const double reach = 2 * c.shape[i].circumradius();
    cells.for_each_near(position, reach, [&](std::size_t j, const Shift<2>&, const Vec2& d) {
      if (j == i) return;
      const int lane = question.others++ % simd_width;
      if (lane == 0) question.groups.emplace_back();
      question.groups.back().set(lane, c.shape[j], d, direction(c.angle[j]));
    });
    all.push_back(std::move(question));
  }
  return all;
}

bool clear_in_batches(const Question& asked, double margin) {
  const OverlapBatch batch(asked.shape, asked.axis, margin);
  std::uint64_t alone = 0;
  return std::ranges::all_of(asked.groups, [&](const EllipseBatch& group) {
    return batch.clear_of(group, Vec2::Zero(), OverlapBatch::all_lanes, alone);
  });
}

bool clear_one_by_one(const Question& asked, double margin) {
  for (int k = 0; k < asked.others; ++k) {
    const EllipseBatch& group = asked.groups[static_cast<std::size_t>(k / simd_width)];
    const int lane = k % simd_width;
    if (!separated(asked.shape, asked.axis, group.shape(lane), group.axis(lane),
                   group.position(lane), margin))
      return false;
  }
  return true;
}

/// The best time per test, and the number of trials without an overlap.
template <class Decide>
std::pair<double, int> timed(const Effort& effort, const std::vector<Question>& asked,
                             Decide&& decide) {
  double best = std::numeric_limits<double>::infinity();
  int clear = 0;
  for (int k = 0; k < effort.stretches; ++k) {
    clear = 0;
    const double start = seconds_now();
    for (const Question& question : asked) clear += decide(question);
    best = std::min(best, seconds_now() - start);
  }
  return {1e9 * best / static_cast<double>(asked.size()), clear};
}

Json measure_batches(const Effort& effort) {
  Json rows = Json::array();
  for (const FluidScene& scene : scenes(effort)) {
    say(fmt::format("batches: kappa = {}, phi = {}", scene.aspect_ratio, scene.packing_fraction));
    Configuration2 c = fluid(scene);
    Sampler sampler(c, 1);
    const Steps steps = fitting_steps(sampler, 20);
    const double margin = hard_margin(c);
    const std::vector<Question> asked = questions(c, steps, effort.questions);
    const auto [batched, clear] =
        timed(effort, asked, [&](const Question& q) { return clear_in_batches(q, margin); });
    const auto [single, also_clear] =
        timed(effort, asked, [&](const Question& q) { return clear_one_by_one(q, margin); });
    if (clear != also_clear)
      throw InvariantError("overlap batches and single tests give different results");
    int others = 0;
    for (const Question& question : asked) others += question.others;
    Json row = scene_json(scene);
    row["others"] = ratio(static_cast<std::uint64_t>(others), asked.size());
    row["clear"] = ratio(static_cast<std::uint64_t>(clear), asked.size());
    row["ns_batched"] = batched;
    row["ns_single"] = single;
    rows.push_back(row);
  }
  return rows;
}

// ---- space beside the plane -----------------------------------------------------------------------------

/// Trials of local moves in this state, and the batches that they test.
template <int Dim>
Json measured_trials(Configuration<Dim>& c, const Effort& effort) {
  Sampler<Dim> sampler(c, 1);
  fitting_steps(sampler, 20);
  const OverlapTestCounts before = sampler.overlap_tests();
  const std::uint64_t tried = sampler.counts().tried();
  Stretches times;
  for (int k = 0; k < effort.stretches; ++k) times.add(sampler, c.size(), effort.stretch);
  const std::uint64_t trials = sampler.counts().tried() - tried;
  Json row = times.json();
  row["particles"] = c.size();
  row["packing_fraction"] = packing_fraction(c);
  row["batches"] = ratio(sampler.overlap_tests().batches - before.batches, trials);
  row["single"] = ratio(sampler.overlap_tests().scalar_pairs - before.scalar_pairs, trials);
  return row;
}

Configuration3 fluid_in_space(int particles, double aspect_ratio, double packing_fraction) {
  Species species;
  species.aspect_ratio = Distribution{.mean = aspect_ratio};
  Configuration3 c =
      draw_particles<3>({species}, static_cast<std::size_t>(particles), 0.2, Vec3::Ones(), 1);
  SwellingState swelling;
  if (insert_particles(c, {0.2}, 1, {}).end != StageEnd::reached ||
      swell(c, {packing_fraction}, 1, swelling, {}).end != StageEnd::reached)
    throw InvariantError("no fluid to measure");
  return c;
}

Json measure_space(const Effort& effort) {
  const int particles = 4 * effort.particles;
  Json rows;
  say("space: disks, phi = 0.7");
  Configuration2 disks = fluid({particles, 1, 0.7});
  rows["disks"] = measured_trials(disks, effort);
  for (const auto& [name, aspect_ratio, phi] :
       {std::tuple{"spheres", 1., 0.49}, std::tuple{"spheroids", 3., 0.45}}) {
    say(fmt::format("space: {}, phi = {}", name, phi));
    Configuration3 c = fluid_in_space(particles, aspect_ratio, phi);
    rows[name] = measured_trials(c, effort);
  }
  return rows;
}

// ---------------------------------------------------------------------------------------------------------

const BenchParts<Effort> parts = {{"speed", measure_speed},
                                  {"threads", measure_threads},
                                  {"batches", measure_batches},
                                  {"space", measure_space}};

}  // namespace

int sampler(const PartsOptions& options) {
  const Effort effort = options.quick ? quick : Effort{};
  return measure_parts(parts, effort, options.parts, 10 * effort.stretch);
}

}  // namespace vitrel::bench
