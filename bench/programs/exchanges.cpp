// How long does each method take to forget a dense polydisperse liquid: places, orientations and sizes?
//
// Prints JSON. scripts/validate exchanges builds and runs this, and writes the page, exchanges.md.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "bench/programs/parts.h"
#include "bench/surveys/engine_speed.h"
#include "bench/surveys/mean.h"
#include "core/elementary.h"
#include "core/error.h"
#include "core/neighbors/pairs.h"
#include "core/state/check.h"
#include "core/state/figure_axis.h"
#include "core/state/species.h"
#include "edmd/brownian.h"
#include "edmd/engine.h"
#include "mc/event_chain.h"
#include "mc/insertion.h"
#include "mc/sampler.h"
#include "mc/swelling.h"

namespace vitrel::bench {
namespace {

struct Effort {
  int particles = 1000;
  double seconds = 10;       ///< of each method in each state
  double mixing = 8;         ///< seconds before
  int passages = 30;         ///< enough of them
  std::size_t states = 100;  ///< of each liquid, at most
};
const Effort quick{64, 0.05, 0.05, 2, 2};

/// Sizes ∝ σ⁻³ between 0.45 and 1 of the largest, 23 % polydispersity (ghimenti2024).
template <int Dim>
Configuration<Dim> dilute_liquid(double aspect_ratio, int particles) {
  const double dilute = Dim == 2 ? 0.2 : 0.1;
  Species species;
  species.name = std::string("A");
  species.aspect_ratio = Distribution{.mean = aspect_ratio};
  species.size = Distribution{
      .kind = Distribution::Kind::power_law, .low = 0.725, .high = 1.61, .exponent = -3};
  Configuration<Dim> c = draw_particles<Dim>({species}, static_cast<std::size_t>(particles), dilute,
                                             Vec<Dim>::Ones(), 1);
  if (insert_particles(c, {dilute}, 1, {}).end != StageEnd::reached)
    throw InvariantError("no state to measure");
  return c;
}

// ---- what is measured ---------------------------------------------------------------------------------

enum Quantity { places, orientations_of_bodies, sizes, quantities };
constexpr std::array<const char*, quantities> quantity_names{"places", "orientations", "sizes"};
using Overlap = std::array<double, quantities>;

/// How much of a configuration another one still shows, whatever the numbers of its particles: sums over pairs of
/// particles of both whose centres are closer than 0.3 (V/N)^(1/D), relative to the motion of all. Of 1, of the alignment
/// and of the product of the deviations of sizes from their mean; 1 at the beginning.
template <int Dim>
class Memory {
 public:
  explicit Memory(const Configuration<Dim>& from) : from_(from), cells_(make_cells(from)) {
    const auto n = static_cast<double>(from.size());
    for (const Solid<Dim>& shape : from.shape) mean_ += root(shape.volume(), Dim) / n;
    for (std::size_t i = 0; i < from.size(); ++i) square_ += deviation(i) * deviation(i);
    reach_ = share * root(from.box.volume() / n, Dim);
  }

  Overlap overlap(const Configuration<Dim>& now) const {
    Vec<Dim> drift = Vec<Dim>::Zero();
    const auto n = static_cast<double>(now.size());
    for (std::size_t i = 0; i < now.size(); ++i)
      drift += (now.unwrapped(i) - from_.unwrapped(i)) / n;
    Overlap sum{};
    for (std::size_t j = 0; j < now.size(); ++j)
      cells_.for_each_near(now.position[j] - drift, reach_,
                           [&](std::size_t i, const Shift<Dim>&, const Vec<Dim>&) {
                             sum[places] += 1 / n;
                             sum[orientations_of_bodies] += alignment(from_, i, now, j) / n;
                             sum[sizes] += deviation(i) * deviation(j) / square_;
                           });
    return sum;
  }

  /// When a quantity counts as forgotten: what is more than chance has fallen to 1/e.
  Overlap goals() const {
    const double ball = Dim == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3;
    const double chance = ball * power(share, Dim);
    return {chance + (1 - chance) / std::numbers::e, 1 / std::numbers::e, 1 / std::numbers::e};
  }

 private:
  static constexpr double share = 0.3;  // of (V/N)^(1/D)

  double deviation(std::size_t i) const { return root(from_.shape[i].volume(), Dim) - mean_; }

  Configuration<Dim> from_;
  CellGrid<Dim> cells_;
  double mean_ = 0, square_ = 0, reach_ = 0;
};

// ---- methods ------------------------------------------------------------------------------------------

/// A method with a state of its own.
template <int Dim>
struct Method {
  Method(std::string what, const Configuration<Dim>& start) : name(std::move(what)), state(start) {}
  virtual ~Method() = default;
  virtual void sweep() = 0;
  virtual void tune() {}
  /// Brings `state` up to date.
  virtual void write() {}
  virtual Json counts() const { return Json::object(); }

  std::string name;
  Configuration<Dim> state;
};

Json exchange_counts(const ExchangeCounts& n) {
  Json json = Json::object();
  const auto share = [](std::uint64_t part, std::uint64_t all) {
    return static_cast<double>(part) / static_cast<double>(all);
  };
  if (n.tried > 0) json["exchanges_accepted"] = share(n.accepted, n.tried);
  if (n.steps > 0) json["steps_accepted"] = share(n.accepted_steps, n.steps);
  return json;
}

template <int Dim>
struct LocalMoves : Method<Dim> {
  LocalMoves(std::string what, const Configuration<Dim>& start, const ExchangeOptions& exchanges)
      : Method<Dim>(std::move(what), start), sampler(this->state, 11) {
    sampler.set_exchanges(exchanges);
  }
  void sweep() override { sampler.sweep(); }
  void tune() override { sampler.tune(); }
  Json counts() const override { return exchange_counts(sampler.counts().exchanges); }

  Sampler<Dim> sampler;
};

template <int Dim>
struct Chains : Method<Dim> {
  Chains(std::string what, const Configuration<Dim>& start, const ExchangeOptions& exchanges)
      : Method<Dim>(std::move(what), start), chains(this->state, {.exchanges = exchanges}, 12) {}
  void sweep() override { chains.sweep(); }
  void tune() override { chains.tune(); }
  Json counts() const override { return exchange_counts(chains.counts().exchanges); }

  EventChain<Dim> chains;
};

/// Newton's laws, in steps of about as many collisions as there are particles.
template <int Dim>
struct Motion : Method<Dim> {
  explicit Motion(const Configuration<Dim>& start)
      : Method<Dim>("motion", start), engine(make_engine(started(), EngineOptions{})) {
    engine->load(this->state);
  }
  Configuration<Dim>& started() {
    draw_velocities(this->state, 1, Purpose::velocities, 0, Temperature::total);
    return this->state;
  }
  void sweep() override {
    const std::uint64_t goal = counters.collisions + this->state.size();
    while (counters.collisions < goal) {
      time += step;
      while (engine->advance(time, counters) == Engine<Dim>::Stop::block_end) {
        engine->write(this->state);
        engine->load(this->state);
      }
    }
  }
  void write() override { engine->write(this->state); }

  static constexpr double step = 0.01;  // far less than it takes to forget anything
  std::unique_ptr<Engine<Dim>> engine;
  RunCounters counters;
  double time = this->state.time;
};

template <int Dim>
using Methods = std::vector<std::unique_ptr<Method<Dim>>>;

/// Of the part "choices", the best beside local moves and beside chains.
constexpr ExchangeOptions none{}, any_two_local{.trials = 0.2}, collective{.collective = 4},
    any_two{.trials = 0.8}, close_two{.trials = 0.8, .partners = 0.1};

template <int Dim>
Methods<Dim> all_methods(const Configuration<Dim>& start) {
  Methods<Dim> all;
  const auto add_local = [&](const char* name, const ExchangeOptions& exchanges) {
    all.push_back(std::make_unique<LocalMoves<Dim>>(name, start, exchanges));
  };
  const auto add_chains = [&](const char* name, const ExchangeOptions& exchanges) {
    all.push_back(std::make_unique<Chains<Dim>>(name, start, exchanges));
  };
  all.push_back(std::make_unique<Motion<Dim>>(start));
  add_local("local moves", none);
  add_local("local moves, exchanges of any two", any_two_local);
  add_local("local moves, collective exchanges", collective);
  add_chains("chains", none);
  add_chains("chains, exchanges of any two", any_two);
  add_chains("chains, exchanges of two close in size", close_two);
  add_chains("chains, collective exchanges", collective);
  return all;
}

// ---- the comparison -----------------------------------------------------------------------------------

template <int Dim>
void mix(Method<Dim>& method, double seconds) {
  const double end = processor_seconds() + seconds;
  for (int k = 0; k < 40 || processor_seconds() < end; ++k) {
    method.sweep();
    if (k % 20 == 19) method.tune();
  }
}

/// Processor time until each quantity was forgotten, again and again.
template <int Dim>
class Passages {
 public:
  Passages(Method<Dim>& method, const Effort& effort) : method_(method), effort_(effort) {}

  Json measure() {
    while (seconds_ < effort_.seconds && passages_ < effort_.passages) pass();
    Json json = {{"method", method_.name}, {"seconds", seconds_}, {"sweeps", sweeps_}};
    json.update(method_.counts());
    for (std::size_t q = 0; q < quantities; ++q)
      if (q != orientations_of_bodies || rotor_count(method_.state) > 0)
        json[quantity_names[q]] = time_json(times_[q]);
    return json;
  }

 private:
  /// Until everything is forgotten or the time is up. Looks at times that increase by a tenth.
  void pass() {
    method_.write();
    const Memory<Dim> memory(method_.state);
    const Overlap goals = memory.goals();
    std::array<bool, quantities> done{};
    done[orientations_of_bodies] = rotor_count(method_.state) == 0;
    Overlap before;
    before.fill(1);
    double spent = 0, spent_before = 0;
    for (std::uint64_t sweeps = 0; seconds_ < effort_.seconds;) {
      const std::uint64_t more = 1 + sweeps / 10;
      const double start = processor_seconds();
      for (std::uint64_t k = 0; k < more; ++k) method_.sweep();
      const double took = processor_seconds() - start;
      spent += took, seconds_ += took, sweeps += more, sweeps_ += more;
      method_.write();
      const Overlap now = memory.overlap(method_.state);
      for (std::size_t q = 0; q < quantities; ++q) {
        if (done[q] || now[q] > goals[q]) continue;
        const double share = (before[q] - goals[q]) / (before[q] - now[q]);
        times_[q].push_back(spent_before + share * (spent - spent_before));
        done[q] = true;
      }
      if (done[0] && done[1] && done[2]) {
        ++passages_;
        return;
      }
      before = now, spent_before = spent;
    }
  }

  static Json time_json(const std::vector<double>& times) {
    if (times.empty()) return nullptr;
    const Mean mean = mean_of(times);
    return {{"seconds", mean.value}, {"error", mean.error}, {"times", times.size()}};
  }

  Method<Dim>& method_;
  const Effort& effort_;
  double seconds_ = 0;
  std::uint64_t sweeps_ = 0;
  int passages_ = 0;
  std::array<std::vector<double>, quantities> times_;
};

/// Denser and denser states of one liquid, each mixed by collective exchanges before it is measured.
template <int Dim, class Make>
Json measure_liquid(double aspect_ratio, const std::vector<double>& packing_fractions,
                    const Effort& effort, const Make& make_methods) {
  Configuration<Dim> c = dilute_liquid<Dim>(aspect_ratio, effort.particles);
  Json rows = Json::array();
  for (const double phi : packing_fractions) {
    if (rows.size() == effort.states) break;
    say(fmt::format("{} dimensions, kappa = {}, phi = {}", Dim, aspect_ratio, phi));
    SwellingState swelling;
    if (swell(c, {phi}, 1, swelling, {}).end != StageEnd::reached)
      throw InvariantError("no state to measure");
    Chains<Dim> mixing("mixing", c, collective);
    mix(mixing, effort.mixing);
    c = mixing.state;
    Json methods = Json::array();
    for (auto& method : make_methods(c)) {
      mix(*method, 0.1 * effort.mixing);
      methods.push_back(Passages<Dim>(*method, effort).measure());
      if (!exact_check(method->state).clean()) throw InvariantError(method->name + ": overlap");
    }
    rows.push_back({{"dimension", Dim},
                    {"aspect_ratio", aspect_ratio},
                    {"particles", effort.particles},
                    {"packing_fraction", phi},
                    {"methods", methods}});
  }
  return rows;
}

Json measure_disks(const Effort& effort) {
  return measure_liquid<2>(1, {0.6, 0.7, 0.75, 0.77, 0.78, 0.79, 0.8, 0.81, 0.82, 0.83, 0.84},
                           effort, all_methods<2>);
}
Json measure_ellipses(const Effort& effort) {
  return measure_liquid<2>(2, {0.6, 0.7, 0.75, 0.8, 0.82, 0.84, 0.85, 0.86, 0.87, 0.88}, effort,
                           all_methods<2>);
}
Json measure_spheres(const Effort& effort) {
  return measure_liquid<3>(1, {0.4, 0.5, 0.55, 0.58, 0.6, 0.62, 0.64}, effort, all_methods<3>);
}

/// Exchanges of all kinds beside local moves and chains.
Json measure_choices(const Effort& effort) {
  return measure_liquid<2>(1, {0.8}, effort, [](const Configuration2& start) {
    Methods<2> all;
    const auto add = [&](const ExchangeOptions& options) {
      const std::string what =
          fmt::format("{} {} {}", options.trials, options.partners, options.collective);
      all.push_back(std::make_unique<LocalMoves<2>>("local " + what, start, options));
      all.push_back(std::make_unique<Chains<2>>("chains " + what, start, options));
    };
    for (const double partners : {1., 0.3, 0.1, 0.03, 0.01})
      add({.trials = 0.2, .partners = partners});
    for (const double trials : {0.05, 0.5, 0.8}) add({.trials = trials, .partners = 0.1});
    add({.trials = 0.8});
    for (const double steps : {1., 2., 4., 8., 16., 32.}) add({.collective = steps});
    return all;
  });
}

const BenchParts<Effort> parts = {{"disks", measure_disks},
                                  {"ellipses", measure_ellipses},
                                  {"spheres", measure_spheres},
                                  {"choices", measure_choices}};

}  // namespace

int exchanges(const PartsOptions& options) {
  const Effort effort = options.quick ? quick : Effort{};
  return measure_parts(parts, effort, options.parts, 0.25 * effort.seconds);
}

}  // namespace vitrel::bench
