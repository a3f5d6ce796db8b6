// How does the cost of the analysis of motion grow with frames, particles, time differences and threads, and how far is
// it below that of plain loops?
//
// Random walks of ellipses, in memory. MSD, MSR, F_s and L_n with their errors by `displacements`, beside loops over
// time differences, particles and origins that compute the means of the same four and no errors. Prints JSON.
// scripts/validate growth runs this and writes its section of docs/validation.md.

#include <algorithm>
#include <cmath>

#include "analysis/dynamics/displacement.h"
#include "bench/programs/parts.h"
#include "bench/surveys/best_seconds.h"
#include "core/random/stream.h"

namespace vitrel::bench {
namespace {

struct Size {
  std::size_t frames = 2000, particles = 100, lags = 100;
  int threads = 1;
};

MemoryTrajectory2 random_walks(const Size& size) {
  Stream draw(1, Purpose::benchmark_cases);
  Configuration2 now;
  now.species_names = {"A"};
  now.box = PeriodicBox<2>(Vec2(30, 30));
  now.resize(size.particles);
  for (Ellipse& shape : now.shape) shape = {std::sqrt(2.), std::sqrt(0.5)};
  std::vector<Configuration2> frames;
  for (std::size_t k = 0; k < size.frames; ++k) {
    now.time = static_cast<double>(k);
    for (std::size_t i = 0; i < now.size(); ++i) {
      const double x = draw.normal(), y = draw.normal();
      now.position[i] += 0.1 * Vec2(x, y);
      now.box.wrap(now.position[i], now.image[i]);
      now.angle[i] += 0.1 * draw.normal();
    }
    frames.push_back(now);
  }
  return MemoryTrajectory2(std::move(frames));
}

DisplacementOptions options_of(const Size& size) {
  DisplacementOptions options;
  options.axis = {
      .longest_lag = static_cast<double>(size.lags) / static_cast<double>(size.frames - 1),
      .every_lag_up_to = size.lags};
  options.wave_numbers = {3};
  options.orders = {2};
  options.parts.overlap = false;
  options.threads = size.threads;
  return options;
}

struct Means {
  double msd = 0, msr = 0, fs = 0, order = 0;
};

/// At every time difference, from the same origins.
std::vector<Means> plain_means(MemoryTrajectory2& run, const DisplacementOptions& options) {
  const std::size_t frames = run.frames(), particles = run.read(0).size();
  std::vector<Vec2> position(frames * particles);
  std::vector<double> angle(frames * particles);
  for (std::size_t k = 0; k < frames; ++k)
    for (std::size_t i = 0; i < particles; ++i) {
      position[i * frames + k] = run.read(k).unwrapped(i);
      angle[i * frames + k] = run.read(k).angle[i];
    }
  std::vector<Means> all;
  for (const Lag& lag : time_axis(run.times(), options.axis)) {
    Means sum;
    for (std::size_t i = 0; i < particles; ++i)
      for (std::size_t o = 0; o < lag.origins; ++o) {
        const std::size_t from = i * frames + lag.from(o), to = i * frames + lag.to(o);
        const double square = (position[to] - position[from]).squaredNorm();
        const double turn = angle[to] - angle[from];
        sum.msd += square;
        sum.msr += turn * turn;
        sum.fs += std::cyl_bessel_j(0., options.wave_numbers[0] * std::sqrt(square));
        sum.order += std::cos(options.orders[0] * turn);
      }
    const double count = static_cast<double>(lag.origins * particles);
    all.push_back({sum.msd / count, sum.msr / count, sum.fs / count, sum.order / count});
  }
  return all;
}

/// The largest difference of a mean, relative to its value at the longest time difference if that is above 1.
double difference(const Displacements& found, const std::vector<Means>& plain) {
  const DisplacementGroup& all = found.groups.front();
  double largest = 0;
  const auto compare = [&](double one, double other) {
    largest = std::max(largest, std::abs(one - other) / std::max(1., std::abs(other)));
  };
  for (std::size_t l = 0; l < plain.size(); ++l) {
    compare(all.translation.value[l], plain[l].msd);
    compare(all.rotation.value[l], plain[l].msr);
    compare(all.self_scattering[0].value[l], plain[l].fs);
    compare(all.orientation[0].value[l], plain[l].order);
  }
  return largest;
}

Json measure(const Size& size, int repeats) {
  say(std::to_string(size.frames) + " frames, " + std::to_string(size.particles) + " particles, " +
      std::to_string(size.lags) + " time differences");
  MemoryTrajectory2 run = random_walks(size);
  const DisplacementOptions options = options_of(size);
  Displacements found;
  const double seconds = best_seconds(repeats, [&] { found = displacements(run, options); });
  std::vector<Means> plain;
  const double plain_seconds = best_seconds(1, [&] { plain = plain_means(run, options); });
  return {{"frames", size.frames},
          {"particles", size.particles},
          {"lags", found.lag.size()},
          {"threads", size.threads},
          {"seconds", seconds},
          {"plain_seconds", plain_seconds},
          {"difference", difference(found, plain)}};
}

}  // namespace

int analysis_growth(bool quick) {
  const int repeats = quick ? 1 : 5;
  const std::size_t scale = quick ? 10 : 1;
  Json result = Json::object();
  const auto add = [&](const char* what, auto Size::*number, std::initializer_list<int> factors) {
    for (const int factor : factors) {
      Size size{2000 / scale, 100, 100 / scale};
      size.*number *= static_cast<std::decay_t<decltype(size.*number)>>(factor);
      result[what].push_back(measure(size, repeats));
    }
  };
  add("frames", &Size::frames, {1, 2, 4, 8});
  add("particles", &Size::particles, {1, 2, 4, 8});
  add("lags", &Size::lags, {1, 2, 4, 8});
  add("threads", &Size::threads, {1, 2});
  print(result);
  return 0;
}

}  // namespace vitrel::bench
