// Which estimators of the analysis are exact, what do they cost, and how does that grow?

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/dynamics/displacement.h"
#include "analysis/dynamics/multiple_tau.h"
#include "analysis/structure/fourier_arrays.h"
#include "analysis/structure/structure_factor.h"
#include "bench/studies/study.h"
#include "bench/surveys/best_seconds.h"
#include "bench/surveys/engine_speed.h"
#include "core/random/stream.h"
#include "mc/insertion.h"

namespace vitrel::bench {
namespace {

// ---- motion -----------------------------------------------------------------------------------------

struct Size {
  std::size_t frames, particles, lags, threads;
};

/// The standard deviation of a step of a particle in every direction, and of its turn.
constexpr double step = 0.1;

MemoryTrajectory2 random_walks(const Size& size, std::uint64_t seed = 1) {
  Stream draw(seed, Purpose::benchmark_cases);
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
      now.position[i] += step * Vec2(x, y);
      now.box.wrap(now.position[i], now.image[i]);
      now.angle[i] += step * draw.normal();
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
  options.threads = static_cast<int>(size.threads);
  return options;
}

struct Means {
  double msd = 0, msr = 0, fs = 0, order = 0;
};

/// Computes the means at every time difference directly, with the same origins.
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

/// The largest difference between means, relative to the mean if that is above 1.
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

Json measure_motion(const StudyContext& context) {
  const bool quick = context.options.quick;
  const std::size_t scale = quick ? 10 : 1;
  Json rows = Json::array();
  const auto add = [&](const char* varied, std::size_t Size::*number, std::size_t largest) {
    for (std::size_t factor = 1; factor <= largest; factor *= 2) {
      Size size{2000 / scale, 100, 100 / scale, 1};
      size.*number *= factor;
      MemoryTrajectory2 run = random_walks(size);
      const DisplacementOptions options = options_of(size);
      Displacements found;
      std::vector<Means> plain;
      const double seconds =
          best_seconds(quick ? 1 : 5, [&] { found = displacements(run, options); });
      const double plain_seconds = best_seconds(1, [&] { plain = plain_means(run, options); });
      const Json about = {{"varied", varied}, {"size", size.*number}};
      rows.push_back(
          {{"method", "vitrel"}, {"ns", 1e9 * seconds}, {"difference", difference(found, plain)}});
      rows.back().update(about);
      rows.push_back({{"method", "plain_loops"}, {"ns", 1e9 * plain_seconds}});
      rows.back().update(about);
    }
  };
  add("frames", &Size::frames, 8);
  add("particles", &Size::particles, 8);
  add("time differences", &Size::lags, 8);
  add("threads", &Size::threads, 2);
  return rows;
}

// ---- estimators of motion -----------------------------------------------------------------------------

/// Pairs of a number of steps and a mean squared displacement.
using Curve = std::vector<std::pair<std::size_t, double>>;

Curve by_displacements(MemoryTrajectory2& run, const Size& size, std::size_t origins) {
  DisplacementOptions options = options_of(size);
  options.axis.max_origins = origins;
  options.parts = {.scattering = false, .orientation = false, .overlap = false};
  const Displacements found = displacements(run, options);
  const std::vector<Lag> lags = time_axis(run.times(), options.axis);
  Curve curve;
  for (std::size_t l = 0; l < lags.size(); ++l)
    curve.emplace_back(lags[l].frames, found.groups.front().translation.value[l]);
  return curve;
}

Curve by_multiple_tau(MemoryTrajectory2& run, const Size& size) {
  MultipleTau<2> correlator(run.read(0), {1, static_cast<double>(size.lags), {}});
  for (std::size_t k = 0; k < run.frames(); ++k)
    correlator.observe({static_cast<std::int64_t>(k), run.read(k), {}});
  const CorrelatedGroup all = correlator.correlations().front();
  const auto column = [&](const char* name) {
    return std::ranges::find(all.columns, name, &vitrel::Column::name)->value;
  };
  const std::vector<double> time = column("time"), msd = column("msd");
  Curve curve;
  for (std::size_t l = 0; l < time.size(); ++l) curve.emplace_back(std::llround(time[l]), msd[l]);
  return curve;
}

/// Uses all origins: ⟨r(t)²⟩ + ⟨r(0)²⟩ by running sums, and ⟨r(t)·r(0)⟩ by Fourier transforms of twice the length.
Curve by_transforms(MemoryTrajectory2& run, const Size& size) {
  const std::size_t frames = run.frames(), length = 2 * frames;
  const FourierArray<double> path = real_array(length);
  const FourierArray<fftw_complex> modes = complex_array(frames + 1);
  const int n = static_cast<int>(length);
  const FourierPlan forward(
      frames + 1, [&] { return fftw_plan_dft_r2c_1d(n, path.get(), modes.get(), FFTW_ESTIMATE); });
  const FourierPlan backward(
      frames + 1, [&] { return fftw_plan_dft_c2r_1d(n, modes.get(), path.get(), FFTW_ESTIMATE); });
  std::vector<double> sums(size.lags + 1);
  for (std::size_t i = 0; i < size.particles; ++i)
    for (int axis = 0; axis < 2; ++axis) {
      std::vector<double> squares(frames);
      double all = 0;
      for (std::size_t k = 0; k < frames; ++k) {
        path[k] = run.read(k).unwrapped(i)[axis] - run.read(0).unwrapped(i)[axis];
        path[k + frames] = 0;
        squares[k] = path[k] * path[k];
        all += 2 * squares[k];
      }
      fftw_execute(forward.get());
      for (std::size_t k = 0; k <= frames; ++k) {
        modes[k][0] = modes[k][0] * modes[k][0] + modes[k][1] * modes[k][1];
        modes[k][1] = 0;
      }
      fftw_execute(backward.get());
      for (std::size_t lag = 1; lag <= size.lags; ++lag) {
        all -= squares[lag - 1] + squares[frames - lag];
        sums[lag] += all - 2 * path[lag] / static_cast<double>(length);
      }
    }
  Curve curve;
  for (std::size_t lag = 1; lag <= size.lags; ++lag)
    curve.emplace_back(lag, sums[lag] / static_cast<double>((frames - lag) * size.particles));
  return curve;
}

/// The mean of (relative deviation from 2 · step² t)², the law in the plane, over the time differences that all
/// estimators have.
double squared_deviation(const Curve& curve) {
  double sum = 0, count = 0;
  for (const auto& [steps, msd] : curve) {
    if (steps == 0 || (steps & (steps - 1)) != 0) continue;  // only powers of two
    const double exact = 2 * step * step * static_cast<double>(steps);
    sum += (msd / exact - 1) * (msd / exact - 1), ++count;
  }
  return sum / count;
}

Json measure_estimators(const StudyContext& context) {
  const bool quick = context.options.quick;
  const Size size{quick ? 500u : 4000u, quick ? 10u : 100u, 100, 1};
  struct Estimator {
    std::string name;
    Json origins;
    std::function<Curve(MemoryTrajectory2&)> curve;
    double seconds = 0, square = 0;
  };
  std::vector<Estimator> all;
  for (const std::size_t origins : {4096, 1024, 256, 64, 16})
    all.push_back({origins == 4096 ? "all origins" : "thinned origins", origins,
                   [=](MemoryTrajectory2& run) { return by_displacements(run, size, origins); }});
  all.push_back({"transforms", size.frames,
                 [=](MemoryTrajectory2& run) { return by_transforms(run, size); }});
  all.push_back({"multiple tau", size.frames,
                 [=](MemoryTrajectory2& run) { return by_multiple_tau(run, size); }});
  const std::uint64_t seeds = quick ? 2 : 16;
  for (std::uint64_t seed = 1; seed <= seeds && !context.control.stop_requested(); ++seed) {
    MemoryTrajectory2 run = random_walks(size, seed);
    for (Estimator& one : all) {
      const double begin = processor_seconds();
      const Curve curve = one.curve(run);
      one.seconds += (processor_seconds() - begin) / static_cast<double>(seeds);
      one.square += squared_deviation(curve) / static_cast<double>(seeds);
    }
  }
  Json rows = Json::array();
  for (const Estimator& one : all)
    rows.push_back({{"method", one.name},
                    {"origins", one.origins},
                    {"ns", 1e9 * one.seconds},
                    {"error", std::sqrt(one.square)}});
  return rows;
}

// ---- structure factor -------------------------------------------------------------------------------

Configuration2 fluid_of_ellipses(std::size_t particles) {
  constexpr double packing_fraction = 0.3;
  Configuration2 c;
  c.resize(particles);
  for (Ellipse& shape : c.shape) shape = {2, 0.5};
  insert_particles(c, {packing_fraction, 1'000'000, false}, 1, {});
  return c;
}

Json measure_structure_factor(const StudyContext& context) {
  Json rows = Json::array();
  for (const std::size_t particles : {10, 30, 100, 1000, 10'000}) {
    if (context.options.quick && particles > 100) break;
    const Configuration2 c = fluid_of_ellipses(particles);
    const ScatteringShells shells(c.box.lengths(), {});
    StructureFactor fast, exact;
    const double transform =
        best_seconds(20, [&] { fast = shells.transformed_structure_factor(c); });
    const double direct =
        best_seconds(particles > 100 ? 1 : 20, [&] { exact = shells.direct_structure_factor(c); });
    double error = 0, share = 0;
    for (std::size_t k = 0; k < exact.q.size(); ++k) {
      if (exact.modes[k] == 0) continue;
      const double n = static_cast<double>(particles);
      const double off = std::abs(fast.total[k] - exact.total[k]);
      error = std::max(error, off);
      share = std::max(share, off / (alias_tolerance *
                                     (2 * std::sqrt(n * exact.total[k]) + alias_tolerance * n)));
    }
    rows.push_back({{"method", "direct_sum"}, {"particles", particles}, {"ns", 1e9 * direct}});
    rows.push_back({{"method", "transform"},
                    {"particles", particles},
                    {"ns", 1e9 * transform},
                    {"largest_error", error},
                    {"share_of_bound", share}});
  }
  return rows;
}

const Column time_of_all = {"ns", "time", Shown::time};

}  // namespace

Study analysis_study() {
  return {
      .name = "analysis",
      .aliases = {{"structure-factor", {"structure_factor"}}, {"analysis-growth", {"motion"}}},
      .question =
          "Which estimators of the analysis are exact, what do they cost, and how does that grow?",
      .parts = {{.name = "motion",
                 .about = "Random walks of ellipses, in memory: mean squared displacement and "
                          "rotation, F_s and L_2 with their errors, beside loops over time "
                          "differences, particles and origins that compute the means alone. 2000 "
                          "frames of 100 particles and 100 time differences, of which one is "
                          "varied.",
                 .measure = measure_motion,
                 .cases = {{"varied"}},
                 .cost = time_of_all,
                 .others = {{"difference", "largest difference of a mean", Shown::error}},
                 .varied = "size"},
                {.name = "estimators",
                 .about = "The mean squared displacement of 100 random walks of 4000 steps, up to "
                          "64 steps, on one thread. The error is the root mean square deviation "
                          "from 2 d D t, over 16 walks. The first two have standard errors, which "
                          "are in their time; transforms have none.",
                 .measure = measure_estimators,
                 .cases = {},
                 .cost = time_of_all,
                 .error = {"error", "relative error of the MSD", Shown::error},
                 .varied = "origins"},
                {.name = "structure_factor",
                 .about = "Ellipses with κ = 4 at φ = 0.3. Centres and orientations in shells up "
                          "to q = 12, by a B-spline grid of order 12 and by sums over the same "
                          "wave vectors. The error bound is 2 ε √(N S) + ε² N with ε = 10⁻⁶ "
                          "(analysis/structure/density_grid.h). For 16 or fewer particles the "
                          "analysis sums.",
                 .measure = measure_structure_factor,
                 .cases = {},
                 .cost = time_of_all,
                 .others = {{"largest_error", "largest error of S", Shown::error},
                            {"share_of_bound", "error/bound", Shown::error}},
                 .varied = "particles"}}};
}

}  // namespace vitrel::bench
