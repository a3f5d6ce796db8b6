// Do event chains forget a state sooner than local moves, per second of one processor?

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <complex>
#include <ctime>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "bench/lab/engine_speed.h"
#include "core/error.h"
#include "core/neighbors/pairs.h"
#include "core/state/check.h"
#include "core/state/species.h"
#include "mc/contact_pressure.h"
#include "mc/event_chain.h"
#include "mc/insertion.h"
#include "mc/sampler.h"
#include "mc/swelling.h"

namespace vitrel::lab {
namespace {

using Json = nlohmann::ordered_json;
using Complex = std::complex<double>;

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Configuration2 binary_disks(int n, double ratio, double phi) {
  Species small, large;
  small.name = "A", large.name = "B";
  small.fraction = large.fraction = 0.5;
  small.size = Distribution{.mean = 1};
  large.size = Distribution{.mean = ratio};
  Configuration2 c = draw_particles({small, large}, static_cast<std::size_t>(n), 0.2, 1, 1);
  if (insert_particles(c, {0.2, 1'000'000, false}, 1, {}).end != StageEnd::reached)
    throw InvariantError("no state");
  std::uint64_t sweep = 0;
  if (swell(c, {phi}, 1, sweep, {}).end != StageEnd::reached) throw InvariantError("no state");
  return c;
}

/// A series of several components that are measured alike.
struct Series {
  int components = 0;  // real and independent
  std::vector<std::vector<Complex>> values;

  Json json(double seconds_per_tick) const {
    const std::size_t n = values.size();
    if (n < 10) return nullptr;
    const auto correlation = [&](std::size_t lag) {
      double sum = 0;
      for (std::size_t t = 0; t + lag < n; ++t)
        for (std::size_t k = 0; k < values[t].size(); ++k)
          sum += (values[t + lag][k] * std::conj(values[t][k])).real();
      return sum / static_cast<double>(n - lag);
    };
    const double norm = correlation(0);
    double tau = 0.5;
    std::size_t window = 1;
    for (; window < n / 3; ++window) {
      tau += correlation(window) / norm;
      if (static_cast<double>(window) >= 6 * tau) break;
    }
    const double samples = static_cast<double>(n) * components;
    return {{"seconds", tau * seconds_per_tick},
            {"relative_error", std::sqrt(2 * (2 * static_cast<double>(window) + 1) / samples)},
            {"ticks", tau},
            {"in_run", static_cast<double>(n) / tau},
            {"mean_square", norm / components},
            {"closed", window < n / 3}};
  }
};

class Measured {
 public:
  Measured(const Configuration2& c, std::size_t ticks_of_block)
      : start_(c), block_(c), ticks_of_block_(ticks_of_block), round_(rotor_count(c) == 0) {
    density_.components = 8;
    nematic_.components = 2;
    hexatic_.components = 2;
  }

  void add(const Configuration2& c) {
    const std::size_t n = c.size();
    const Vec2 drift = mean_displacement(c, start_);
    Complex rho[4] = {}, q = 0;
    const Vec2 k = 2 * std::numbers::pi * c.box.lengths().cwiseInverse();
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 at = c.position[i] - drift;
      const Complex x = std::polar(1., k.x() * at.x()), y = std::polar(1., k.y() * at.y());
      rho[0] += x, rho[1] += y, rho[2] += x * y, rho[3] += x * std::conj(y);
      if (!round_) q += std::polar(1., 2 * c.angle[i]);
    }
    const double root = 1 / std::sqrt(static_cast<double>(n));
    density_.values.push_back({root * rho[0], root * rho[1], root * rho[2], root * rho[3]});
    if (!round_) nematic_.values.push_back({root * q});
    if (round_) {
      Complex psi = 0;
      for_each_pair(c, 1.45, [&](std::size_t, std::size_t, const Vec2& d) {
        const Complex u = Complex(d.x(), d.y()) / d.norm();
        const Complex cube = u * u * u;
        psi += cube * cube;
      });
      hexatic_.values.push_back({root / 3 * psi});
    }
    // Places and angles, block by block.
    const Vec2 moved = mean_displacement(c, block_);
    double square = 0, cosine = 0;
    for (std::size_t i = 0; i < n; ++i) {
      square += (c.unwrapped(i) - block_.unwrapped(i) - moved).squaredNorm();
      cosine += std::cos(2 * (c.angle[i] - block_.angle[i]));
    }
    if (msd_.size() <= in_block_) msd_.emplace_back(), cosine_.emplace_back();
    msd_[in_block_].push_back(square / static_cast<double>(n));
    cosine_[in_block_].push_back(cosine / static_cast<double>(n));
    if (++in_block_ == ticks_of_block_) {
      in_block_ = 0;
      block_ = c;
    }
    pressure_.add(c);
    if (density_.values.size() % 50 == 0) {
      z_.push_back(pressure_.compressibility());
      pressure_.clear();
    }
  }

  Json json(double seconds_per_tick) const {
    Json j;
    j["density"] = density_.json(seconds_per_tick);
    if (!round_) j["nematic"] = nematic_.json(seconds_per_tick);
    if (round_) j["hexatic"] = hexatic_.json(seconds_per_tick);
    const auto mean = [](const std::vector<double>& v) {
      double sum = 0, square = 0;
      for (double x : v) sum += x, square += x * x;
      const double n = static_cast<double>(v.size()), m = sum / n;
      return std::pair(m, std::sqrt(std::max(0., square / n - m * m) / std::max(1., n - 1)));
    };
    Json rows = Json::array();
    std::size_t last = 0;
    for (std::size_t k = 0; k < msd_.size(); ++k) {
      if (k + 1 < msd_.size() && static_cast<double>(k + 1) < 1.5 * static_cast<double>(last))
        continue;
      if (msd_[k].size() < 2) continue;
      last = k + 1;
      const auto [m, e] = mean(msd_[k]);
      const auto [c, ce] = mean(cosine_[k]);
      rows.push_back({{"s", static_cast<double>(k + 1) * seconds_per_tick},
                      {"msd", m},
                      {"msd_error", e},
                      {"c2", c},
                      {"c2_error", ce}});
    }
    j["single"] = rows;
    const auto [z, ze] = mean(z_);
    j["z"] = z, j["z_error"] = ze;
    return j;
  }

 private:
  static Vec2 mean_displacement(const Configuration2& c, const Configuration2& from) {
    Vec2 sum = Vec2::Zero();
    for (std::size_t i = 0; i < c.size(); ++i) sum += c.unwrapped(i) - from.unwrapped(i);
    return sum / static_cast<double>(c.size());
  }

  Configuration2 start_, block_;
  std::size_t ticks_of_block_, in_block_ = 0;
  bool round_;
  Series density_, nematic_, hexatic_;
  std::vector<std::vector<double>> msd_, cosine_;
  ContactPressure pressure_;
  std::vector<double> z_;
};

struct Request {
  int particles = 1024;
  double kappa = 1, phi = 0.5, ratio = 0;
  std::vector<double> lengths{10};   // of chains, in particles' spacings
  std::vector<double> rotations{1};  // per contact
  double seconds = 10, tick = 0.01, warm = 2;
  double acceptance = 0.35;
  std::size_t block = 100;
  bool local = true;
};

struct Contestant {
  std::string name;
  Configuration2 state;
  std::function<void()> tick;
  std::function<Json()> counts;
  double seconds = 0;
  std::vector<Measured> measured;
};

int run(const Request& r) {
  Configuration2 start = r.ratio > 0 ? binary_disks(r.particles, r.ratio, r.phi)
                                     : fluid({r.particles, r.kappa, r.phi});
  const bool round = rotor_count(start) == 0;
  const double spacing = std::sqrt(start.box.volume() / r.particles);
  double translation = 0.1, rotation = 0.1;
  {
    Sampler sampler(start, 3);
    for (const double until = processor_seconds() + r.warm; processor_seconds() < until;) {
      for (int k = 0; k < 10; ++k) sampler.sweep();
      sampler.tune();
    }
    translation = sampler.translation_step(), rotation = sampler.rotation_step();
  }
  if (!round || r.particles <= 5000) {
    EventChain chain(start, {}, 4);
    for (const double until = processor_seconds() + r.warm; processor_seconds() < until;) {
      chain.sweep();
      chain.tune();
    }
  }
  if (!exact_check(start).clean()) throw InvariantError("overlap at the start");

  std::vector<std::unique_ptr<Contestant>> all;
  std::vector<std::unique_ptr<Sampler>> samplers;
  std::vector<std::unique_ptr<EventChain>> chains;
  if (r.local) {
    auto c = std::make_unique<Contestant>();
    c->name = "local";
    c->state = start;
    samplers.push_back(std::make_unique<Sampler>(c->state, 11));
    Sampler* s = samplers.back().get();
    s->set_steps(translation, rotation);
    const double before = processor_seconds();
    for (int k = 0; k < 20; ++k) s->sweep();
    const double each = (processor_seconds() - before) / 20;
    const int sweeps = std::max(1, static_cast<int>(std::lround(r.tick / each)));
    c->tick = [s, sweeps] {
      for (int k = 0; k < sweeps; ++k) s->sweep();
    };
    c->counts = [s, sweeps]() -> Json {
      const StageReport& n = s->counts();
      return {
          {"moves", n.translations_tried + n.rotations_tried},
          {"sweeps_per_tick", sweeps},
          {"translation_step", s->translation_step()},
          {"rotation_step", s->rotation_step()},
          {"translations_accepted", double(n.translations_accepted) / double(n.translations_tried)},
          {"rotations_accepted",
           double(n.rotations_accepted) / double(std::max<std::uint64_t>(1, n.rotations_tried))}};
    };
    all.push_back(std::move(c));
  }
  for (const double length : r.lengths)
    for (const double ratio : round ? std::vector{0.} : r.rotations) {
      auto c = std::make_unique<Contestant>();
      c->name = fmt::format("chain l={} r={}", length, ratio);
      c->state = start;
      chains.push_back(
          std::make_unique<EventChain>(c->state, EventChainOptions{length, ratio}, 12));
      EventChain* s = chains.back().get();
      for (int k = 0; k < 60; ++k) s->sweep(), s->tune();
      const double before = processor_seconds();
      for (int k = 0; k < 20; ++k) s->sweep();
      const double each = (processor_seconds() - before) / 20;
      const int sweeps = std::max(1, static_cast<int>(std::lround(r.tick / each)));
      c->tick = [s, sweeps] {
        for (int k = 0; k < sweeps; ++k) s->sweep();
      };
      c->counts = [s, sweeps]() -> Json {
        const EventChain::Counts& m = s->counts();
        return {{"moves", m.contacts + m.rotations_tried},
                {"contacts", m.contacts},
                {"crossings", m.looks - m.contacts},
                {"rotations", m.rotations_tried},
                {"rotations_accepted", double(m.rotations_accepted) /
                                           double(std::max<std::uint64_t>(1, m.rotations_tried))},
                {"rotation_step", s->plan().rotation_step},
                {"free_path", m.length / double(m.contacts)},
                {"z_of_chains", m.compressibility()},
                {"chains_per_sweep", s->plan().chains},
                {"sweeps_per_tick", sweeps}};
      };
      all.push_back(std::move(c));
    }
  std::vector<Json> first;
  for (auto& c : all) {
    c->measured.emplace_back(c->state, r.block);
    first.push_back(c->counts());
  }
  std::size_t ticks = 0;
  double spent = 0;
  while (spent < r.seconds * static_cast<double>(all.size())) {
    for (auto& c : all) {
      const double before = processor_seconds();
      c->tick();
      const double took = processor_seconds() - before;
      c->seconds += took, spent += took;
      c->measured[0].add(c->state);
    }
    ++ticks;
  }
  Json out = {
      {"particles", r.particles}, {"kappa", r.kappa}, {"phi", r.phi}, {"size_ratio", r.ratio}};
  for (std::size_t k = 0; k < all.size(); ++k) {
    Contestant& c = *all[k];
    const double per_tick = c.seconds / static_cast<double>(ticks);
    Json j = {
        {"name", c.name}, {"seconds", c.seconds}, {"ticks", ticks}, {"seconds_per_tick", per_tick}};
    Json counts = c.counts();
    j["ns_per_move"] =
        1e9 * c.seconds / (counts["moves"].get<double>() - first[k]["moves"].get<double>());
    j.update(counts);
    j.update(c.measured[0].json(per_tick));
    j["clean"] = exact_check(c.state).clean();
    out["results"].push_back(j);
  }
  fmt::print("{}\n", out.dump(1));
  return 0;
}

}  // namespace
}  // namespace vitrel::lab

int main(int argc, char** argv) {
  vitrel::lab::Request r;
  CLI::App app("Do event chains forget a state sooner than local moves?");
  app.add_option("-n", r.particles);
  app.add_option("--kappa", r.kappa);
  app.add_option("--phi", r.phi);
  app.add_option("--ratio", r.ratio);
  app.add_option("--lengths", r.lengths)->delimiter(',');
  app.add_option("--rotations", r.rotations)->delimiter(',');
  app.add_option("--seconds", r.seconds);
  app.add_option("--tick", r.tick);
  app.add_option("--warm", r.warm);
  app.add_option("--block", r.block);
  app.add_flag("!--no-local", r.local);
  CLI11_PARSE(app, argc, argv);
  try {
    return vitrel::lab::run(r);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_event_chain: {}\n", error.what());
    return 1;
  }
}
