#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/glass/glass_names.h"
#include "analysis/structure/order.h"
#include "analysis/trajectory.h"
#include "core/special_values.h"
#include "workflow/report/report_page.h"

/// Made-up runs for the report page: every table that it knows, and particles whose motion and overlaps
/// are known.
namespace vitrel::report_example {

constexpr std::size_t overlapping_frame = 2;

/// n² ellipses (κ = 2) on a square lattice of spacing 4, in two species by turns. In frame k all have
/// moved by (1, 0.5) k, so that they cross the edges again and again, and turned by 0.1 k; in the
/// overlapping frame particle 1 is on particle 0.
inline MemoryTrajectory2 lattice(std::size_t n, std::size_t frames) {
  const double side = 4.0 * static_cast<double>(n);
  Configuration2 state;
  state.box = PeriodicBox<2>(Vec2(side, side));
  state.resize(n * n);
  state.species_names = {"A", "B"};
  std::vector<Configuration2> all;
  for (std::size_t k = 0; k < frames; ++k) {
    state.time = 0.5 * static_cast<double>(k);
    const auto step = static_cast<double>(k);
    for (std::size_t i = 0; i < n * n; ++i) {
      state.shape[i] = {std::sqrt(2.0), std::sqrt(0.5)};
      state.species[i] = static_cast<std::int32_t>(i % 2);
      state.image[i] = Shift<2>::Zero();
      const std::size_t x = i % n, y = i / n;
      state.position[i] = Vec2(4.0 * static_cast<double>(x) - 0.5 * side + 2 + step,
                               4.0 * static_cast<double>(y) - 0.5 * side + 2 + 0.5 * step);
      if (k == overlapping_frame && i == 1) state.position[i] = state.position[0] + Vec2(0.5, 0);
      state.box.wrap(state.position[i], state.image[i]);
      state.angle[i] = 0.3 + 0.1 * step;
    }
    all.push_back(state);
  }
  return MemoryTrajectory2(std::move(all));
}

inline std::vector<double> constant(std::size_t rows, double value) {
  std::vector<double> values(rows, value);
  return values;
}

/// A column of values with an error of 5 %.
template <class Function>
Column column(const std::string& name, const std::string& unit, const std::vector<double>& x,
              Function function) {
  Column result{name, unit, {}, {}};
  for (const double value : x) {
    result.value.push_back(function(value));
    result.error.push_back(0.05 * std::abs(result.value.back()));
  }
  return result;
}

inline Column plain(const std::string& name, const std::string& unit,
                    const std::vector<double>& value) {
  return {name, unit, value, {}};
}

inline std::vector<double> evenly(double first, double step, std::size_t count) {
  std::vector<double> values;
  for (std::size_t k = 0; k < count; ++k) values.push_back(first + step * static_cast<double>(k));
  return values;
}

inline Column single(const std::string& name, double value, double error) {
  return {name, "1", {value}, {error}};
}

/// Codes, and what they stand for.
template <std::size_t N>
Column codes(const char* name, const std::array<std::string_view, N>& labels,
             std::vector<double> value) {
  return {name, "1", std::move(value), {}, {labels.begin(), labels.end()}};
}

inline Table summary(double phi) {
  return {"summary",
          "",
          {plain("packing_fraction", "1", {phi}), plain("particles", "1", {1000}),
           plain("rotors", "1", {1000}), plain("rotations", "1", {1000}),
           plain("collisions", "1", {123'456}), plain("duration", "time", {250}),
           single("compressibility_factor", 4.4921, 0.0312), single("translational_energy", 1, 0),
           single("rotational_energy", 0.5, 0.001), single("diffusion", 0.02 * (0.8 - phi), 0.0002),
           plain("diffusion_from", "time", {10}), plain("diffusion_to", "time", {100}),
           single("rotational_diffusion", unknown, unknown),
           plain("collisions_per_second_with_output", "1/s", {300'000})}};
}

/// Brownian particles of relaxation time τ, as far as anything can be made of that.
inline std::vector<Table> correlations(double tau, const std::string& group) {
  const std::vector<double> t = evenly(0.5, 0.5, 500);
  const auto decay = [tau](double rate) {
    return [tau, rate](double time) { return std::exp(-std::pow(rate * time / tau, 0.7)); };
  };
  const auto square = [tau](double share) {
    return [tau, share](double time) { return share * (0.1 * time / (1 + time) + time / tau); };
  };
  const auto hump = [tau](double height) {
    return [tau, height](double time) {
      return height * std::exp(-std::pow(std::log(time / tau), 2));
    };
  };
  return {{"displacements_" + group,
           "",
           {plain("time", "time", t), column("msd", "length^2", t, square(1)),
            column("msd_parallel", "length^2", t, square(0.7)),
            column("msd_perpendicular", "length^2", t, square(0.3)),
            column("non_gaussian", "1", t, hump(1.2)), column("msr", "rad^2", t, square(0.5)),
            column("non_gaussian_rotation", "1", t, hump(0.6))}},
          {"self_scattering_" + group,
           "",
           {plain("time", "time", t), column("fs_1", "1", t, decay(1)),
            column("fs_2", "1", t, decay(4))}},
          {"orientation_" + group,
           "",
           {plain("time", "time", t), column("l_2", "1", t, decay(0.5)),
            column("l_4", "1", t, decay(2))}}};
}

inline std::vector<Table> collective(double tau) {
  const std::vector<double> t = evenly(0.5, 0.5, 500), from_zero = evenly(0, 0.5, 501);
  return {{"wave_numbers", "", {plain("index", "1", {1, 2}), plain("q", "1/length", {2.4, 5})}},
          {"susceptibility",
           "",
           {plain("time", "time", t),
            column("overlap", "1", t, [tau](double time) { return std::exp(-time / tau); }),
            column("chi_4", "1", t,
                   [tau](double time) { return 5 * time / tau * std::exp(-time / tau); })}},
          {"collective_scattering",
           "",
           {plain("time", "time", from_zero), column("f_1", "1", from_zero, [tau](double time) {
              return 2.1 * std::exp(-time / tau);
            })}}};
}

inline std::vector<Table> structure() {
  const std::vector<double> q = evenly(0.1, 0.1, 120), r = evenly(0.05, 0.1, 100);
  const std::vector<double> angle = evenly(-1.5, 0.1, 31);
  std::vector<double> by_chance;
  for (const double x : angle)
    by_chance.push_back((1 + 2 * nematic_order_by_chance(1000, 2) * std::cos(2 * x)) /
                        std::numbers::pi);
  const auto peak = [](double x) {
    return 1 - std::exp(-x * x) + std::exp(-8 * std::pow(x - 2.4, 2));
  };
  const auto flat = [](double) { return 1.0; };
  const auto shell = [](double x) { return x < 0.8 ? 0.0 : 1 + std::exp(-x) * std::cos(3 * x); };
  return {
      {"structure_factor",
       "",
       {plain("q", "1/length", q), column("s", "1", q, peak), column("s_A_B", "1", q, flat),
        column("s_orientation", "1", q, flat), plain("modes", "1", constant(120, 8))}},
      {"pair_correlation",
       "",
       {plain("r", "length", r), column("g", "1", r, shell), column("g_2", "1", r, shell),
        column("g_4", "1", r, shell)}},
      {"orientation_distribution",
       "",
       {plain("angle", "rad", angle),
        column("density", "1/rad", angle, [](double x) { return std::exp(std::cos(2 * x)) / 4; }),
        plain("by_chance", "1/rad", by_chance)}}};
}

inline std::vector<Table> series() {
  const std::vector<double> t = evenly(0, 0.25, 1000);
  return {
      {"energies",
       "",
       {plain("time", "time", t), plain("translational", "kT", constant(1000, 1)),
        plain("rotational", "kT", constant(1000, 0.5)), plain("total", "kT", constant(1000, 1.5))}},
      {"compressibility_factor",
       "",
       {plain("time", "time", t), plain("z", "1", constant(1000, 4.5))}},
      {"order",
       "",
       {plain("time", "time", t), plain("nematic", "1", constant(1000, 0.7)),
        plain("director", "rad", constant(1000, 0.1)),
        plain("hexatic", "1", constant(1000, 0.2))}}};
}

/// Relaxation slows down as (0.8 − φ)^−2.
inline double relaxation_time(double phi) {
  return 0.1 * std::pow(0.8 - phi, -2);
}

inline ReportRun run(double phi, MemoryTrajectory2 trajectory) {
  ReportRun run;
  run.name = "run <1>";
  run.dynamics = "Brownian, step 0.1";
  run.label = fmt::format("φ = {:.2f}", phi);
  run.packing_fraction = phi;
  std::vector<Table>& tables = run.results.tables;
  const auto add = [&tables](const std::vector<Table>& more) {
    tables.insert(tables.end(), more.begin(), more.end());
  };
  add({summary(phi)});
  for (const char* group : {"all", "A", "B"}) add(correlations(relaxation_time(phi), group));
  add(collective(relaxation_time(phi)));
  add(structure());
  add(series());
  run.movie = film(trajectory);
  return run;
}

/// Two seeds at every density. From 0.68 on particles are nematic, at 0.76 their orientations do not
/// relax; the densest are not equilibrated, and stay out of the fits.
inline Table relaxation_table() {
  std::vector<double> phi, seed, verdict, orientation, plateau, wave_number;
  for (const double density : {0.6, 0.62, 0.64, 0.66, 0.68, 0.7, 0.72, 0.74, 0.76})
    for (const double number : {1.0, 2.0}) {
      phi.push_back(density);
      seed.push_back(number);
      wave_number.push_back(5 * std::sqrt(density));
      verdict.push_back(density < 0.73 ? 0 : density < 0.75 ? 1 : 2);
      orientation.push_back(density < 0.67 ? 1 : density < 0.75 ? 2 : 3);
      plateau.push_back(density < 0.67 ? 0 : 0.4);
    }
  const auto rotation = [](double x) {
    return x > 0.75 ? unknown : (x < 0.67 ? 4 : 0.8) * std::pow(0.81 - x, -2.5);
  };
  return {
      "relaxation",
      "",
      {plain("packing_fraction", "1", phi), plain("seed", "1", seed),
       plain("duration", "time", constant(phi.size(), 2500)),
       codes("verdict", verdict_names, verdict),
       codes("verdict_translation", verdict_names, verdict),
       plain("wave_number", "1/length", wave_number),
       column("tau_translation", "time", phi, relaxation_time),
       column("tau_rotation", "time", phi, rotation),
       column("nematic_order", "1", phi, [](double x) { return x < 0.67 ? 0.1 : 0.6 + x - 0.67; }),
       plain("nematic_by_chance", "1", constant(phi.size(), 0.04)), plain("plateau", "1", plateau),
       codes("orientation", orientation_names, orientation)}};
}

/// Both laws are found for translation, and a bound or nothing for rotation; both laws agree with the
/// times, and at the middle of the window with one another.
inline Table fit_table() {
  const double vogel_fulcher = std::log(relaxation_time(0.66)) - 0.6 * 0.66 / (0.85 - 0.66);
  return {"glass_fit",
          "",
          {codes("kind", kind_names, {0, 0, 1, 1, 2}),
           codes("law", law_names, {0, 1, 0, 1, 0}),
           codes("verdict", fit_verdict_names, {0, 0, 1, 2, 1}),
           {"phi_c",
            "1",
            {0.8, 0.85, unknown, unknown, unknown},
            {0.005, 0.02, unknown, unknown, unknown}},
           plain("phi_c_least", "1", {0.792, 0.82, 0.795, unknown, 0.785}),
           {"exponent",
            "1",
            {2, 0.6, unknown, unknown, unknown},
            {0.1, 0.3, unknown, unknown, unknown}},
           plain("window_low", "1", {0.62, 0.62, 0.6, 0.6, 0.68}),
           plain("window_high", "1", {0.72, 0.72, 0.66, 0.66, 0.72}),
           plain("densities", "1", {6, 6, 4, 4, 3}),
           plain("window_phi_c", "1", {0.8, 0.85, 0.81, unknown, 0.81}),
           plain("window_exponent", "1", {2, 0.6, 2.5, unknown, 2.5}),
           plain("window_log_prefactor", "ln(time)",
                 {std::log(0.1), vogel_fulcher, std::log(4), unknown, std::log(0.8)}),
           plain("chi2", "1", {3.6, 4.5, 1, 20, 1}),
           plain("dof", "1", {3, 3, 1, 1, 1}),
           plain("scatter", "1", {1, 1, 1.5, 1.5, 1})}};
}

inline Results study() {
  return {{relaxation_table(), fit_table()},
          {{"row_0", "sweep/phi-0.6/run.h5"},
           {"note_1", "phi-0.74 (density 0.74, seed 1) stays out of the fits, ageing: S drifts"},
           {"note_2", "rotation, tau_2, Vogel-Fulcher: no phi_c, chi^2 <is> too large"}}};
}

/// The summaries of the runs below each other.
inline Table jobs_table(const std::vector<ReportRun>& runs) {
  Table jobs = *runs.front().results.find("summary");
  jobs.name = "runs";
  for (std::size_t k = 1; k < runs.size(); ++k)
    for (Column& column : jobs.columns) {
      const Column& more = *runs[k].results.find("summary")->find(column.name);
      column.value.push_back(more.value.front());
      if (!more.error.empty()) column.error.push_back(more.error.front());
    }
  return jobs;
}

/// The same runs, or others, as a sweep.
inline void set_runs(ReportData& data, std::vector<ReportRun> runs) {
  data.runs = std::move(runs);
  std::erase_if(data.study.tables, [](const Table& table) { return table.name == "runs"; });
  data.study.tables.push_back(jobs_table(data.runs));
}

/// A sweep of three densities.
inline ReportData sweep(std::size_t n, std::size_t frames) {
  ReportData data;
  data.title = "Ellipses & <disks>";
  data.subtitle = "N = " + std::to_string(n * n);
  data.study = study();
  set_runs(data, {run(0.5, lattice(n, frames)), run(0.6, lattice(n, frames)),
                  run(0.7, lattice(n, frames))});
  data.parameters = "[system]\nname = \"</script><b>\"\n";
  data.provenance = {{"version", "0.1.0"}, {"command", "vitrel run \"a\" > b"}};
  return data;
}

}  // namespace vitrel::report_example
