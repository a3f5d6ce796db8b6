// Which method of sampling a hard liquid in equilibrium is the most efficient for its processor time?

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "analysis/statistics/blocking.h"
#include "analysis/structure/structure_factor.h"
#include "bench/studies/sampling_method.h"
#include "bench/studies/study.h"
#include "bench/surveys/best_seconds.h"
#include "bench/surveys/engine_speed.h"
#include "bench/surveys/mean.h"
#include "core/error.h"
#include "core/state/check.h"
#include "core/state/species.h"
#include "mc/insertion.h"
#include "mc/place_correlation.h"
#include "mc/swelling.h"

namespace vitrel::bench {
namespace {

struct Effort {
  int particles = 1000;
  double seconds = 10;  ///< for each method in each state
  /// Limit for motion, with which others are compared, until it has forgotten a few times.
  double motion_seconds = 150;
  double mixing = 8;               ///< processor time of mixing before the measurement
  int few = 3, passages = 30;      ///< a few passages, and enough of them
  std::size_t states = 100;        ///< largest number for each liquid
  int stretches = 40, sweeps = 3;  ///< number of timed stretches, and sweeps in each
  int tiles = 10;
};

Effort effort_of(const StudyContext& context) {
  Effort effort = context.options.quick ? Effort{64, 0.05, 0.05, 0.05, 1, 2, 2, 2, 1, 2} : Effort{};
  if (!context.options.quick) effort.seconds = context.options.seconds;
  return effort;
}

template <int Dim>
Configuration<Dim> swollen(Configuration<Dim> c, double packing_fraction) {
  SwellingState swelling;
  must_reach(swell(c, {packing_fraction}, 1, swelling, {}));
  return c;
}

template <int Dim>
Configuration<Dim> dilute_liquid(const Species& species, int particles) {
  const double dilute = Dim == 2 ? 0.2 : 0.1;
  Configuration<Dim> c = draw_particles<Dim>({species}, static_cast<std::size_t>(particles), dilute,
                                             Vec<Dim>::Ones(), 1);
  must_reach(insert_particles(c, {dilute}, 1, {}));
  return c;
}

Species equal_particles(double aspect_ratio) {
  Species species;
  species.name = std::string("A");
  species.aspect_ratio = Distribution{.mean = aspect_ratio};
  return species;
}

/// Sizes that are distributed ∝ σ⁻³ between 0.45 and 1 of the largest, with 23 % polydispersity (ghimenti2024).
Species of_many_sizes(double aspect_ratio) {
  Species species = equal_particles(aspect_ratio);
  species.size = Distribution{
      .kind = Distribution::Kind::power_law, .low = 0.725, .high = 1.61, .exponent = -3};
  return species;
}

template <int Dim>
void mix(SamplingMethod<Dim>& method, double seconds) {
  const double end = processor_seconds() + seconds;
  for (int k = 0; k < 40 || processor_seconds() < end; ++k) {
    method.sweep();
    if (k % 20 == 19) method.tune();
  }
}

constexpr ExchangeOptions none{}, any_two_local{.trials = 0.2}, collective{.collective = 4},
    any_two{.trials = 0.8}, close_two{.trials = 0.8, .partners = 0.1};

template <int Dim>
Configuration<Dim> mixed(const Configuration<Dim>& c, double seconds,
                         const ExchangeOptions& exchanges) {
  Chains<Dim> chains("mixing", c, exchanges);
  mix(chains, seconds);
  return chains.state;
}

void require_no_overlap(const auto& method) {
  if (!exact_check(method.state).clean()) throw InvariantError(method.name + ": overlap");
}

// ---- the error of Z ---------------------------------------------------------------------------------

/// Measures Z by blocks, and the processor time until its standard error is a thousandth.
template <int Dim>
Json pressure_row(SamplingMethod<Dim>& method, const Effort& effort) {
  constexpr int blocks = 256;
  constexpr double wanted = 1e-3;
  mix(method, 0.1 * effort.mixing);
  method.compressibility();
  std::vector<double> values;
  double seconds = 0;
  for (int block = 0; block < blocks; ++block) {
    const double begin = processor_seconds();
    for (int sweeps = 0; sweeps < 10 || processor_seconds() - begin < effort.seconds / blocks;
         ++sweeps)
      method.sweep();
    values.push_back(method.compressibility());
    seconds += processor_seconds() - begin;
  }
  method.write();
  require_no_overlap(method);
  const Estimate z = block_average(values);
  const double times = z.error / (wanted * z.mean);
  return {{"method", method.name},
          {"ns", 1e9 * seconds * times * times},
          {"z", z.mean},
          {"z_error", z.error}};
}

template <int Dim>
SamplingMethods<Dim> plain_methods(const Configuration<Dim>& start) {
  SamplingMethods<Dim> methods;
  methods.push_back(std::make_unique<Motion<Dim>>(start));
  methods.push_back(std::make_unique<LocalMoves<Dim>>("local moves", start));
  methods.push_back(std::make_unique<Chains<Dim>>("chains", start));
  return methods;
}

/// Calls measure(state, add) for a liquid at each of these packing fractions. add(row) completes a row and adds it to
/// `rows`.
template <int Dim, class Measure>
void each_state(const StudyContext& context, const char* shape, double aspect_ratio,
                std::initializer_list<double> packing_fractions, Json& rows, Measure&& measure) {
  const Effort effort = effort_of(context);
  Configuration<Dim> c = dilute_liquid<Dim>(equal_particles(aspect_ratio), effort.particles);
  for (const double phi : packing_fractions) {
    if (context.control.stop_requested()) return;
    c = mixed(swollen(c, phi), effort.mixing, none);
    measure(c, [&](const Json& row) {
      rows.push_back(row);
      rows.back().update({{"shape", shape}, {"packing_fraction", phi}});
    });
  }
}

template <int Dim>
void add_pressures(const StudyContext& context, const char* shape, double aspect_ratio,
                   std::initializer_list<double> packing_fractions, Json& rows) {
  const Effort effort = effort_of(context);
  each_state<Dim>(context, shape, aspect_ratio, packing_fractions, rows,
                  [&](const Configuration<Dim>& c, auto&& add) {
                    for (const auto& method : plain_methods(c)) add(pressure_row(*method, effort));
                    ConstantPressure<Dim> compressed(c, rows.back()["z"].template get<double>());
                    Effort longer = effort;
                    longer.seconds *= 6;  // because volumes change slowly
                    add(pressure_row(compressed, longer));
                  });
}

Json measure_pressure(const StudyContext& context) {
  Json rows = Json::array();
  add_pressures<2>(context, "disks", 1, {0.3, 0.5, 0.6, 0.7}, rows);
  add_pressures<2>(context, "κ = 2", 2, {0.3, 0.5, 0.6, 0.7}, rows);
  add_pressures<2>(context, "κ = 6", 6, {0.3, 0.5}, rows);
  add_pressures<3>(context, "spheres", 1, {0.2, 0.3, 0.4, 0.49}, rows);
  add_pressures<3>(context, "spheroids 3", 3, {0.2, 0.3, 0.4}, rows);
  return rows;
}

// ---- the error of S(q) --------------------------------------------------------------------------------

/// Measures the processor time until the standard error of S(q) is a hundredth, in the first shell and in the shell
/// of the main peak. The time to compute S(q) does not count.
template <int Dim>
Json structure_row(SamplingMethod<Dim>& method, const Effort& effort) {
  constexpr int blocks = 20, samples = 10;
  constexpr double wanted = 1e-2;
  const ScatteringShells<Dim> shells(method.state.box.lengths(),
                                     {.wave_number_max = 5, .wave_number_step = 0.2});
  mix(method, 0.1 * effort.mixing);
  std::vector<std::vector<double>> of_block;
  double seconds = 0;
  for (int block = 0; block < blocks; ++block) {
    std::vector<double> sum;
    for (int sample = 0; sample < samples; ++sample) {
      const double begin = processor_seconds();
      do method.sweep();
      while (processor_seconds() - begin < effort.seconds / (blocks * samples));
      seconds += processor_seconds() - begin;
      method.write();
      const std::vector<double> now = shells.structure_factor(method.state).total;
      sum.resize(now.size());
      for (std::size_t k = 0; k < now.size(); ++k) sum[k] += now[k] / samples;
    }
    of_block.push_back(sum);
  }
  require_no_overlap(method);
  Json row = {{"method", method.name}};
  const auto add = [&](const std::string& name, std::size_t shell) {
    std::vector<double> values;
    for (const std::vector<double>& one : of_block) values.push_back(one[shell]);
    const Mean mean = mean_of(values);
    const double times = mean.error / (wanted * mean.value);
    row[name] = 1e9 * seconds * times * times;
    row[name + "_s"] = mean.value;
  };
  const std::vector<double>& last = of_block.back();
  const auto known = [](double s) { return !std::isnan(s); };
  const auto first = std::ranges::find_if(last, known);
  const auto peak = std::ranges::max_element(last, {}, [&](double s) { return known(s) ? s : -1; });
  add("longest", static_cast<std::size_t>(first - last.begin()));
  add("peak", static_cast<std::size_t>(peak - last.begin()));
  return row;
}

template <int Dim>
void add_structures(const StudyContext& context, const char* shape, double aspect_ratio,
                    std::initializer_list<double> packing_fractions, Json& rows) {
  const Effort effort = effort_of(context);
  each_state<Dim>(context, shape, aspect_ratio, packing_fractions, rows,
                  [&](const Configuration<Dim>& c, auto&& add) {
                    for (const auto& method : plain_methods(c)) add(structure_row(*method, effort));
                  });
}

Json measure_structure(const StudyContext& context) {
  Json rows = Json::array();
  if (context.options.quick) {
    add_structures<2>(context, "disks", 1, {0.3}, rows);
    return rows;
  }
  add_structures<2>(context, "disks", 1, {0.3, 0.5, 0.7}, rows);
  add_structures<2>(context, "κ = 2", 2, {0.3, 0.5, 0.7}, rows);
  add_structures<3>(context, "spheres", 1, {0.2, 0.49}, rows);
  return rows;
}

// ---- forgetting a dense liquid ----------------------------------------------------------------------

enum Quantity { places, orientations_of_bodies, sizes, quantities };
constexpr std::array<const char*, quantities> quantity_names{"places", "orientations", "sizes"};

template <int Dim>
SamplingMethods<Dim> all_methods(const Configuration<Dim>& start) {
  SamplingMethods<Dim> all;
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

/// Measures repeatedly the processor time until each quantity is forgotten.
template <int Dim>
class Passages {
 public:
  Passages(SamplingMethod<Dim>& method, const Effort& effort)
      : method_(method),
        effort_(effort),
        longest_(method.name == "motion" ? std::max(effort.motion_seconds, effort.seconds)
                                         : effort.seconds) {}

  Json measure() {
    while (seconds_ < longest_ && passages_ < effort_.passages &&
           (seconds_ < effort_.seconds || passages_ < effort_.few))
      pass();
    Json json = {{"method", method_.name}};
    for (std::size_t q = 0; q < quantities; ++q) {
      if (times_[q].empty()) continue;
      const Mean mean = mean_of(times_[q]);
      json[quantity_names[q]] = 1e9 * mean.value;
      json[quantity_names[q] + std::string("_error")] = 1e9 * mean.error;
    }
    const ExchangeCounts n = method_.exchanges();
    if (n.tried > 0) json["exchanges_accepted"] = share_of(n.accepted, n.tried);
    if (n.steps > 0) json["exchanges_accepted"] = share_of(n.accepted_steps, n.steps);
    return json;
  }
  bool has_forgotten() const { return passages_ > 0; }

 private:
  /// Runs until everything is forgotten or the time is up. Comparisons are made after numbers of sweeps that grow by
  /// a tenth.
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
      spent += took, seconds_ += took, sweeps += more;
      method_.write();
      const PlaceCorrelations found = first.with(method_.state);
      const std::array<double, quantities> now{found.places, found.orientations, found.sizes};
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

  SamplingMethod<Dim>& method_;
  const Effort& effort_;
  double longest_;  // limit in seconds
  double seconds_ = 0;
  int passages_ = 0;
  std::array<std::vector<double>, quantities> times_;
};

/// Measures increasingly dense states of one liquid, each of which is first mixed by collective exchanges. A method
/// that has not forgotten one of them is left out for the denser ones.
template <int Dim>
void add_liquid(const StudyContext& context, const char* liquid, double aspect_ratio,
                const std::vector<double>& packing_fractions, Json& rows) {
  const Effort effort = effort_of(context);
  Configuration<Dim> c = dilute_liquid<Dim>(of_many_sizes(aspect_ratio), effort.particles);
  std::set<std::string> too_slow;
  for (std::size_t k = 0; k < std::min(effort.states, packing_fractions.size()); ++k) {
    c = mixed(swollen(c, packing_fractions[k]), effort.mixing, collective);
    for (auto& method : all_methods(c)) {
      if (context.control.stop_requested()) return;
      if (too_slow.contains(method->name)) continue;
      mix(*method, 0.1 * effort.mixing);
      Passages<Dim> passages(*method, effort);
      rows.push_back(passages.measure());
      rows.back().update({{"liquid", liquid}, {"packing_fraction", packing_fractions[k]}});
      if (!passages.has_forgotten()) too_slow.insert(method->name);
      require_no_overlap(*method);
    }
  }
}

Json measure_forgetting(const StudyContext& context) {
  Json rows = Json::array();
  add_liquid<2>(context, "disks", 1, {0.6, 0.7, 0.75, 0.77, 0.78, 0.79, 0.8, 0.82, 0.84}, rows);
  add_liquid<2>(context, "ellipses", 2, {0.6, 0.7, 0.8, 0.82, 0.84, 0.86, 0.88}, rows);
  add_liquid<3>(context, "spheres", 1, {0.4, 0.5, 0.55, 0.58, 0.6, 0.62}, rows);
  return rows;
}

// ---- threads ----------------------------------------------------------------------------------------

Json measure_threads(const StudyContext& context) {
  const Effort effort = effort_of(context);
  Json rows = Json::array();
  for (const auto& [shape, kappa] : {std::pair("κ = 2", 2.), std::pair("κ = 6", 6.)}) {
    const Configuration2 start =
        tiled(fluid({effort.particles, kappa, 0.5}), effort.tiles, effort.tiles);
    Configuration2 first = start, second = start;
    Sampler one(first, 1, {}, 1), two(second, 1, {}, 2);
    double best_of_one = std::numeric_limits<double>::infinity(), best_of_two = best_of_one;
    const auto seconds = [&](Sampler<Ellipse>& sampler) {
      return seconds_of([&] {
        for (int k = 0; k < effort.sweeps; ++k) sampler.sweep();
      });
    };
    for (int k = 0; k < effort.stretches; ++k) {
      best_of_one = std::min(best_of_one, seconds(one));
      best_of_two = std::min(best_of_two, seconds(two));
    }
    const double trials = static_cast<double>(start.size()) * effort.sweeps;
    for (const auto& [method, best] :
         {std::pair("one thread", best_of_one), std::pair("two threads", best_of_two)})
      rows.push_back({{"method", method},
                      {"shape", shape},
                      {"particles", start.size()},
                      {"ns_per_trial", 1e9 * best / trials}});
  }
  return rows;
}

}  // namespace

Study sampling_study() {
  return {
      .name = "sampling",
      .aliases = {{"event-chain", {"pressure"}},
                  {"exchanges", {"forgetting"}},
                  {"sampler", {"threads"}}},
      .question =
          "Which way of sampling a hard liquid in equilibrium gives most for the processor time?",
      .parts = {{.name = "pressure",
                 .about =
                     "Processor time on one thread until the standard error of Z = βP/ρ is "
                     "0.1 %, from blocks that may be correlated (–: too few to tell): motion by "
                     "the virial, local moves by the contact function, event chains by the "
                     "contacts of the chains; Monte Carlo at constant pressure by the packing "
                     "fraction that is found.",
                 .measure = measure_pressure,
                 .cases = {{"shape"}},
                 .cost = {"ns", "time for 0.1 %", Shown::time},
                 .others = {{"z", "Z"}, {"z_error", "its error", Shown::error}},
                 .varied = "packing_fraction"},
                {.name = "structure",
                 .about = "Processor time on one thread until the standard error of S(q) is 1 %, "
                          "from 20 blocks, at the longest wavelengths and at the main peak; that "
                          "of computing S(q) is not counted.",
                 .measure = measure_structure,
                 .cases = {{"shape"}},
                 .cost = {"longest", "time for 1 % of S at the longest wavelengths", Shown::time},
                 .others = {{"longest_s", "S"},
                            {"peak", "time for 1 % of S at the peak", Shown::time},
                            {"peak_s", "S at the peak"}},
                 .varied = "packing_fraction"},
                {.name = "forgetting",
                 .about = "A liquid of sizes ∝ σ⁻³ with a standard deviation of 23 %, mixed by "
                          "chains with collective exchanges: processor time until the sizes at "
                          "each place have fallen to 1/e of what is more than chance "
                          "(mc/place_correlation.h), also of places and orientations. A method "
                          "that does not forget within its time is left out of the denser states.",
                 .measure = measure_forgetting,
                 .cases = {{"liquid"}},
                 .cost = {"sizes", "sizes forgotten", Shown::time},
                 .others = {{"sizes_error", "error", Shown::time},
                            {"places", "places forgotten", Shown::time},
                            {"places_error", "error", Shown::time},
                            {"orientations", "orientations forgotten", Shown::time},
                            {"exchanges_accepted", "exchanges accepted", Shown::share}},
                 .varied = "packing_fraction"},
                {.name = "threads",
                 .about = "Local moves of many particles at φ = 0.5, wall time; the final states "
                          "are bit-identical.",
                 .measure = measure_threads,
                 .cases = {{"shape"}},
                 .cost = {"ns_per_trial", "time per trial", Shown::time},
                 .others = {{"particles", "N"}}}},
      .defaults = {.seconds = 10},
      .settled = {
          "Chains of 30 to 300 contacts with one trial rotation per contact decorrelate fastest; "
          "shorter and longer ones take up to four times as long (commit dcec11b7).",
          "Local moves with steps for an acceptance of 0.35 take up to 1.7 times as long as with "
          "twice these steps; the steps of rotations between chains do not matter (commit "
          "dcec11b7).",
          "Against the law of Vogel and Fulcher fitted to motion, chains with collective "
          "exchanges forget the places of disks 231 ± 80 times as fast at φ = 0.79 (commit "
          "e9c4d65a).",
          "Local moves in domains with batched overlap tests make 1.3 to 3.6 times as many trials "
          "as one trial after another, and the batches of four are 4 to 10 times as fast as "
          "single tests for ellipses (commit 57d84b51)."}};
}

}  // namespace vitrel::bench
