// How long does each method take to forget a dense polydisperse liquid: places, orientations and sizes?
//
// Prints JSON. scripts/validate exchanges builds and runs this, and writes the page, exchanges.md.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bench/programs/parts.h"
#include "bench/surveys/engine_speed.h"
#include "bench/surveys/mean.h"
#include "core/error.h"
#include "core/state/check.h"
#include "core/state/species.h"
#include "edmd/brownian.h"
#include "edmd/engine.h"
#include "mc/event_chain.h"
#include "mc/insertion.h"
#include "mc/place_correlation.h"
#include "mc/sampler.h"
#include "mc/swelling.h"

namespace vitrel::bench {
namespace {

struct Effort {
  int particles = 1000;
  double seconds = 10;  ///< of each method in each state
  double motion_seconds =
      150;  ///< of motion, what others are compared with, until it has forgotten a few times
  double mixing = 8;           ///< seconds before
  int few = 3, passages = 30;  ///< a few, and enough of them
  std::size_t states = 100;    ///< of each liquid, at most
};
const Effort quick{64, 0.05, 0.05, 0.05, 1, 2, 2};

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

enum Quantity { places, orientations_of_bodies, sizes, quantities };
constexpr std::array<const char*, quantities> quantity_names{"places", "orientations", "sizes"};

/// What the later configuration still shows of the first one.
template <int Dim>
std::array<double, quantities> shown(const PlaceCorrelation<Dim>& first,
                                     const Configuration<Dim>& later) {
  const PlaceCorrelations now = first.with(later);
  return {now.places, now.orientations, now.sizes};
}

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

constexpr const char* motion = "motion";

/// Newton's laws, in steps of about as many collisions as there are particles.
template <int Dim>
struct Motion : Method<Dim> {
  explicit Motion(const Configuration<Dim>& start)
      : Method<Dim>(motion, start), engine(make_engine(started(), EngineOptions{})) {
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
  Passages(Method<Dim>& method, const Effort& effort)
      : method_(method),
        effort_(effort),
        longest_(method.name == motion ? effort.motion_seconds : effort.seconds) {}

  Json measure() {
    while (seconds_ < longest_ && passages_ < effort_.passages &&
           (seconds_ < effort_.seconds || passages_ < effort_.few))
      pass();
    Json json = {{"method", method_.name}, {"seconds", seconds_}, {"sweeps", sweeps_}};
    json.update(method_.counts());
    for (std::size_t q = 0; q < quantities; ++q)
      if (q != orientations_of_bodies || rotor_count(method_.state) > 0)
        json[quantity_names[q]] = time_json(times_[q]);
    return json;
  }
  bool has_forgotten() const { return passages_ > 0; }

 private:
  /// Until everything is forgotten or the time is up. Looks at times that increase by a tenth.
  void pass() {
    method_.write();
    constexpr double goal = 1 / std::numbers::e;
    const PlaceCorrelation<Dim> first(method_.state);
    std::array<bool, quantities> done{};
    done[orientations_of_bodies] = rotor_count(method_.state) == 0;
    std::array<double, quantities> before;
    before.fill(1);
    double spent = 0, spent_before = 0;
    for (std::uint64_t sweeps = 0; seconds_ < longest_;) {
      const std::uint64_t more = 1 + sweeps / 10;
      const double start = processor_seconds();
      for (std::uint64_t k = 0; k < more; ++k) method_.sweep();
      const double took = processor_seconds() - start;
      spent += took, seconds_ += took, sweeps += more, sweeps_ += more;
      method_.write();
      const std::array<double, quantities> now = shown(first, method_.state);
      for (std::size_t q = 0; q < quantities; ++q) {
        if (done[q] || now[q] > goal) continue;
        const double share = (before[q] - goal) / (before[q] - now[q]);
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
  double longest_;  // in seconds
  double seconds_ = 0;
  std::uint64_t sweeps_ = 0;
  int passages_ = 0;
  std::array<std::vector<double>, quantities> times_;
};

/// Denser and denser states of one liquid, each mixed by collective exchanges before it is measured. A method that has not
/// forgotten one of them is left out of the next ones.
template <int Dim, class Make>
Json measure_liquid(double aspect_ratio, const std::vector<double>& packing_fractions,
                    const Effort& effort, const Make& make_methods) {
  Configuration<Dim> c = dilute_liquid<Dim>(aspect_ratio, effort.particles);
  Json rows = Json::array();
  std::set<std::string> too_slow;
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
      if (too_slow.contains(method->name)) continue;
      mix(*method, 0.1 * effort.mixing);
      Passages<Dim> passages(*method, effort);
      methods.push_back(passages.measure());
      if (!passages.has_forgotten()) too_slow.insert(method->name);
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
  return measure_liquid<2>(
      1, {0.6, 0.7, 0.75, 0.77, 0.78, 0.785, 0.79, 0.795, 0.8, 0.81, 0.82, 0.83, 0.84}, effort,
      all_methods<2>);
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
