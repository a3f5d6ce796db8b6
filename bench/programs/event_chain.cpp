// Do event chains decorrelate states faster than local moves, in CPU time?
//
// Prints JSON. scripts/validate event_chain builds and runs this, and writes the page, event_chain.md.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/programs/parts.h"
#include "bench/surveys/engine_speed.h"
#include "bench/surveys/mean.h"
#include "core/error.h"
#include "core/io/json.h"
#include "core/neighbors/pairs.h"
#include "core/state/check.h"
#include "core/state/species.h"
#include "mc/contact_pressure.h"
#include "mc/event_chain.h"
#include "mc/insertion.h"
#include "mc/sampler.h"
#include "mc/swelling.h"

namespace vitrel::bench {
namespace {

using Complex = std::complex<double>;

/// How much is measured.
struct Effort {
  int share_of_particles = 1;  ///< one in so many
  double seconds = 1;          ///< as many times those of every state
  double ticks = 1;            ///< as many times as far apart as those of every state
  double mixing = 3;           ///< seconds of either method, before
};
const Effort quick{16, 0.004, 0.05, 0.02};

/// A fluid: equal particles, or disks of two sizes.
struct State {
  FluidScene scene;
  double size_ratio = 1;
  double seconds;  ///< of either method
  double tick;     ///< approximate seconds between measurements of the state
};

double ratio(std::uint64_t part, std::uint64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0;
}

Configuration2 disks_of_two_sizes(const State& state) {
  constexpr double dilute = 0.2;
  Species small, large;
  small.name = std::string("A"), large.name = std::string("B");
  small.fraction = large.fraction = 0.5;
  small.size = Distribution{.mean = 1};
  large.size = Distribution{.mean = state.size_ratio};
  Configuration2 c =
      draw_particles<2>({small, large}, static_cast<std::size_t>(state.scene.particles), dilute,
                        Vec2::Ones(), state.scene.seed);
  SwellingState swelling;
  if (insert_particles(c, {dilute}, state.scene.seed, {}).end != StageEnd::reached ||
      swell(c, {state.scene.packing_fraction}, state.scene.seed, swelling, {}).end !=
          StageEnd::reached)
    throw InvariantError("no state to measure");
  return c;
}

// ---- what is measured ---------------------------------------------------------------------------------

/// A complex quantity of mean zero, of several components that are independent and alike, at every tick.
class Series {
 public:
  void add(std::vector<Complex> values) { values_.push_back(std::move(values)); }

  /// The autocorrelation time ½ + Σ C(t)/C(0), summed up to six times itself (Sokal), in seconds.
  Json json(double seconds_per_tick) const {
    constexpr double window = 6;
    const double norm = correlation(0);
    double time = 0.5;
    std::size_t lag = 1;
    for (; lag < values_.size() / 3 && static_cast<double>(lag) < window * time; ++lag)
      time += correlation(lag) / norm;
    const double samples = static_cast<double>(2 * values_[0].size() * values_.size());
    const double spread = std::sqrt(2 * (2 * static_cast<double>(lag) + 1) / samples);
    return {{"seconds", time * seconds_per_tick},
            {"error", spread * time * seconds_per_tick},
            {"times_in_run", static_cast<double>(values_.size()) / time},
            {"is_long_enough", lag < values_.size() / 3}};
  }

 private:
  double correlation(std::size_t lag) const {
    double sum = 0;
    for (std::size_t t = 0; t + lag < values_.size(); ++t)
      for (std::size_t k = 0; k < values_[t].size(); ++k)
        sum += (values_[t + lag][k] * std::conj(values_[t][k])).real();
    return sum / static_cast<double>(values_.size() - lag);
  }

  std::vector<std::vector<Complex>> values_;
};

/// How long it takes, again and again, until a quantity that starts at `start` has come to `goal`.
class Passages {
 public:
  Passages(double start, double goal) : start_(start), goal_(goal), last_(start) {}

  void add(double value) {
    if (there_) return;
    if ((value - goal_) * (start_ - goal_) <= 0) {
      times_.push_back(ticks_ + (goal_ - last_) / (value - last_));
      there_ = true;
    }
    last_ = value;
    ++ticks_;
  }
  bool there() const { return there_; }
  void again() { there_ = false, ticks_ = 0, last_ = start_; }

  Json json(double seconds_per_tick) const {
    if (times_.size() < 2) return nullptr;
    const Mean mean = mean_of(times_);
    return {{"seconds", mean.value * seconds_per_tick},
            {"error", mean.error * seconds_per_tick},
            {"times", times_.size()}};
  }

 private:
  double start_, goal_, last_, ticks_ = 0;
  bool there_ = false;
  std::vector<double> times_;
};

/// Everything about one run. Displacements are those relative to all: chains push all forwards.
class Measured {
 public:
  explicit Measured(const Configuration2& c)
      : start_(c), from_(c), is_round_(rotor_count(c) == 0) {}

  void add(const Configuration2& c) {
    add_modes(c);
    add_passages(c);
    if (ticks_++ % 20 == 0) {
      pressure_.add(c);
      if (ticks_ % 200 == 1 && ticks_ > 1) {
        compressibility_.push_back(pressure_.compressibility());
        pressure_.clear();
      }
    }
  }

  Json json(double seconds_per_tick) const {
    Json j = {{"density", density_.json(seconds_per_tick)},
              {is_round_ ? "hexatic" : "nematic", order_.json(seconds_per_tick)},
              {"place", place_.json(seconds_per_tick)}};
    if (!is_round_) j["orientation"] = orientation_.json(seconds_per_tick);
    if (compressibility_.size() > 1) {
      const Mean z = mean_of(compressibility_);
      j["compressibility"] = z.value, j["compressibility_error"] = z.error;
    }
    return j;
  }

 private:
  // ρ(k) at the four shortest k and opposite ones, ψ₆ of bonds or the nematic tensor, all over √N.
  void add_modes(const Configuration2& c) {
    const double scale = 1 / std::sqrt(static_cast<double>(c.size()));
    const Vec2 drift = mean_displacement(c, start_);
    const Vec2 k = 2 * std::numbers::pi * c.box.lengths().cwiseInverse();
    std::vector<Complex> density(4);
    Complex order = 0;
    for (std::size_t i = 0; i < c.size(); ++i) {
      const Vec2 at = c.position[i] - drift;
      const Complex x = std::polar(scale, k.x() * at.x()), y = std::polar(1., k.y() * at.y());
      density[0] += x, density[1] += scale * y, density[2] += x * y, density[3] += x * std::conj(y);
      if (!is_round_) order += std::polar(scale, 2 * c.angle[i]);
    }
    density_.add(std::move(density));
    // Closer than the first minimum of g(r).
    constexpr double bond = 1.45;
    if (is_round_)
      for_each_pair(c, bond, [&](std::size_t, std::size_t, const Vec2& d) {
        const Complex u = Complex(d.x(), d.y()) / d.norm(), cube = u * u * u;
        order += scale * cube * cube;
      });
    order_.add({order});
  }

  void add_passages(const Configuration2& c) {
    const Vec2 drift = mean_displacement(c, from_);
    double square = 0, cosine = 0;
    for (std::size_t i = 0; i < c.size(); ++i) {
      const double width = 2 * c.shape[i].b;
      square += (c.unwrapped(i) - from_.unwrapped(i) - drift).squaredNorm() / (width * width);
      cosine += std::cos(2 * (c.angle[i] - from_.angle[i]));
    }
    place_.add(square / static_cast<double>(c.size()));
    if (!is_round_) orientation_.add(cosine / static_cast<double>(c.size()));
    if (place_.there() && (is_round_ || orientation_.there())) {
      from_ = c;
      place_.again();
      orientation_.again();
    }
  }

  static Vec2 mean_displacement(const Configuration2& c, const Configuration2& from) {
    Vec2 sum = Vec2::Zero();
    for (std::size_t i = 0; i < c.size(); ++i) sum += c.unwrapped(i) - from.unwrapped(i);
    return sum / static_cast<double>(c.size());
  }

  Configuration2 start_, from_;
  bool is_round_;
  std::uint64_t ticks_ = 0;
  Series density_, order_;
  Passages place_{0, 1}, orientation_{1, 1 / std::numbers::e};
  ContactPressure pressure_;
  std::vector<double> compressibility_;
};

// ---- who is measured ------------------------------------------------------------------------------------

/// A method with a state of its own.
struct Contestant {
  Contestant(std::string what, const Configuration2& start) : name(std::move(what)), state(start) {}
  virtual ~Contestant() = default;
  virtual void sweep() = 0;
  virtual void tune() = 0;
  /// No more tuning: other steps now, if it is to have such.
  virtual void begin() = 0;
  virtual std::uint64_t moves() const = 0;
  virtual Json counts() const = 0;

  std::string name;
  Configuration2 state;
};

struct LocalMoves : Contestant {
  LocalMoves(const Configuration2& start, double step_factor)
      : Contestant("local moves", start), sampler(state, 11), factor(step_factor) {}
  void sweep() override { sampler.sweep(); }
  void tune() override { sampler.tune(); }
  void begin() override {
    sampler.set_steps(factor * sampler.state().translation.size,
                      std::min(std::numbers::pi, factor * sampler.state().rotation.size));
  }
  std::uint64_t moves() const override { return sampler.counts().tried(); }
  Json counts() const override {
    const TrialCounts& n = sampler.counts();
    return {{"step_factor", factor},
            {"translation_step", sampler.state().translation.size},
            {"rotation_step", sampler.state().rotation.size},
            {"translations_accepted", ratio(n.translations_accepted, n.translations_tried)},
            {"rotations_accepted", ratio(n.rotations_accepted, n.rotations_tried)}};
  }

  Sampler<2> sampler;
  double factor;
};

struct Chains : Contestant {
  Chains(const Configuration2& start, const EventChainOptions& wanted, double step_factor = 1)
      : Contestant("event chains", start),
        options(wanted),
        chains(state, wanted, 12),
        factor(step_factor) {}
  void sweep() override { chains.sweep(); }
  void tune() override { chains.tune(); }
  void begin() override {
    EventChain<2>::Plan plan = chains.plan();
    plan.rotation_step = std::min(std::numbers::pi, factor * plan.rotation_step);
    chains.set_plan(plan);
  }
  std::uint64_t moves() const override {
    return chains.counts().contacts + chains.counts().rotations_tried;
  }
  Json counts() const override {
    const ChainCounts& n = chains.counts();
    return {{"contacts", options.contacts},
            {"rotations", options.rotations},
            {"step_factor", factor},
            {"length", chains.plan().length},
            {"chains_in_a_sweep", chains.plan().chains},
            {"searches_per_contact", ratio(n.searches, n.contacts)},
            {"rotations_accepted", ratio(n.rotations_accepted, n.rotations_tried)},
            {"compressibility_of_chains", n.compressibility()}};
  }

  EventChainOptions options;
  EventChain<2> chains;
  double factor;
};

using Contestants = std::vector<std::unique_ptr<Contestant>>;

// ---- the comparison -------------------------------------------------------------------------------------

/// Sweeps until so many seconds are over.
void mix(Contestant& method, double seconds) {
  const double end = processor_seconds() + seconds;
  for (int k = 0; k < 50 || processor_seconds() < end; ++k) {
    method.sweep();
    method.tune();
  }
}

Configuration2 mixed_state(const State& state, const Effort& effort) {
  const Configuration2 first =
      state.size_ratio == 1 ? fluid(state.scene) : disks_of_two_sizes(state);
  Chains chains(first, {});
  mix(chains, effort.mixing);
  LocalMoves local(chains.state, 1);
  mix(local, effort.mixing);
  return local.state;
}

Json compare(const State& state, const Effort& effort, Contestants all) {
  struct Run {
    int sweeps;
    double seconds = 0;
    std::uint64_t moves;
    Measured measured;
  };
  std::vector<Run> runs;
  for (const auto& method : all) {
    mix(*method, 0.5 * effort.mixing);
    method->begin();
    constexpr int trial = 20;
    const double before = processor_seconds();
    for (int k = 0; k < trial; ++k) method->sweep();
    const double sweep = (processor_seconds() - before) / trial;
    runs.push_back({std::max(1, static_cast<int>(std::lround(effort.ticks * state.tick / sweep))),
                    0, method->moves(), Measured(method->state)});
  }
  int ticks = 0;
  const double enough = effort.seconds * state.seconds * static_cast<double>(all.size());
  for (double spent = 0; spent < enough || ticks < 50; ++ticks)
    for (std::size_t k = 0; k < all.size(); ++k) {
      const double before = processor_seconds();
      for (int n = 0; n < runs[k].sweeps; ++n) all[k]->sweep();
      const double took = processor_seconds() - before;
      runs[k].seconds += took, spent += took;
      runs[k].measured.add(all[k]->state);
    }
  Json rows = Json::array();
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!exact_check(all[k]->state).clean()) throw InvariantError(all[k]->name + ": overlap");
    const Run& run = runs[k];
    Json row = {
        {"method", all[k]->name},
        {"seconds", run.seconds},
        {"seconds_per_sweep", run.seconds / ticks / run.sweeps},
        {"ns_per_move", 1e9 * run.seconds / static_cast<double>(all[k]->moves() - run.moves)}};
    row.update(all[k]->counts());
    row.update(run.measured.json(run.seconds / ticks));
    rows.push_back(row);
  }
  Json json = scene_json(state.scene);
  json["size_ratio"] = state.size_ratio;
  json["methods"] = rows;
  return json;
}

/// Compares in every state what `contestants` makes of it.
template <class Make>
Json compare_all(std::vector<State> states, const Effort& effort, Make&& contestants) {
  Json rows = Json::array();
  for (State& state : states) {
    state.scene.particles /= effort.share_of_particles;
    say(fmt::format("kappa = {}, phi = {}, N = {}", state.scene.aspect_ratio,
                    state.scene.packing_fraction, state.scene.particles));
    const Configuration2 start = mixed_state(state, effort);
    rows.push_back(compare(state, effort, contestants(start)));
  }
  return rows;
}

Json measure_states(const Effort& effort) {
  const std::vector<State> states = {
      {{1024, 1, 0.5}, 1, 8, 0.002},    {{1024, 1, 0.7}, 1, 40, 0.01},
      {{1024, 1, 0.78}, 1.4, 25, 0.02}, {{1024, 2, 0.5}, 1, 8, 0.002},
      {{1024, 2, 0.7}, 1, 25, 0.01},    {{1024, 6, 0.3}, 1, 8, 0.003},
      {{1024, 6, 0.5}, 1, 25, 0.01},    {{1024, 6, 0.7}, 1, 25, 0.05},
      {{4096, 1, 0.7}, 1, 40, 0.05}};
  return compare_all(states, effort, [](const Configuration2& start) {
    Contestants all;
    all.push_back(std::make_unique<LocalMoves>(start, 1));
    all.push_back(std::make_unique<Chains>(start, EventChainOptions{}));
    return all;
  });
}

const std::vector<State> tuning_states = {
    {{1024, 1, 0.7}, 1, 4, 0.01}, {{1024, 2, 0.7}, 1, 4, 0.01}, {{1024, 6, 0.5}, 1, 4, 0.01}};

Json measure_lengths(const Effort& effort) {
  return compare_all(tuning_states, effort, [](const Configuration2& start) {
    Contestants all;
    for (const double contacts : {3., 10., 30., 100., 300., 1000., 3000.})
      all.push_back(std::make_unique<Chains>(start, EventChainOptions{contacts, 1}));
    return all;
  });
}

Json measure_rotations(const Effort& effort) {
  return compare_all(
      {tuning_states.begin() + 1, tuning_states.end()}, effort, [](const Configuration2& start) {
        Contestants all;
        for (const double rotations : {0.25, 0.5, 1., 2., 4., 8.})
          all.push_back(std::make_unique<Chains>(start, EventChainOptions{100, rotations}));
        return all;
      });
}

Json measure_steps(const Effort& effort) {
  return compare_all(tuning_states, effort, [](const Configuration2& start) {
    Contestants all;
    for (const double factor : {0.5, 1., 2., 3.})
      all.push_back(std::make_unique<LocalMoves>(start, factor));
    // Disks have no rotations whose steps could be others.
    for (const double factor : rotor_count(start) > 0 ? std::vector{1., 2., 3.} : std::vector{1.})
      all.push_back(std::make_unique<Chains>(start, EventChainOptions{}, factor));
    return all;
  });
}

const BenchParts<Effort> parts = {{"states", measure_states},
                                  {"lengths", measure_lengths},
                                  {"rotations", measure_rotations},
                                  {"steps", measure_steps}};

}  // namespace

int event_chain(const PartsOptions& options) {
  const Effort effort = options.quick ? quick : Effort{};
  return measure_parts(parts, effort, options.parts, 2 * effort.seconds);
}

}  // namespace vitrel::bench
