#include "app/workflow/bench/thesis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>

#include "app/workflow/bench/figures.h"

namespace vitrel {
namespace {

using Json = nlohmann::ordered_json;
using lab::Program;

constexpr double brownian_step = 0.1;
constexpr double warm_up = 20;
constexpr double long_enough = 1;  // simulated time of a run, to count its collisions
constexpr double aspect_ratio = 2;
constexpr std::array programs{Program::ours, Program::thesis, Program::improved};
constexpr std::array side_lengths{4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 18, 20};
constexpr std::array aspect_ratios{1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0};

/// The runs of the benchmark, one after the other.
class Runs {
 public:
  Runs(const ThesisRequest& request, const RunControl& control,
       const std::function<void(const std::string&)>& say)
      : request_(request), control_(control), say_(say) {}

  ThesisBench all() {
    by_size();
    by_aspect_ratio();
    energies();
    relaxations();
    bench_.stopped = control_.stop_requested();
    return bench_;
  }

 private:
  lab::ThesisScene scene(int particles, double kappa) const {
    return {particles, kappa, 0.5, request_.seed};
  }

  void run(std::vector<ThesisRow>& rows, Program program, const lab::ThesisScene& scene, double tau,
           const Configuration2& start) {
    if (control_.stop_requested()) return;
    lab::RunLimits limits{request_.duration, 1e9, tau, request_.seed};
    // Small systems run longer, so that all have as much to do.
    if (program == Program::ours)
      limits.duration *= std::max(
          1.0, static_cast<double>(side_lengths.back() * side_lengths.back()) / scene.particles);
    else
      limits.seconds = request_.seconds;
    const lab::ThesisRun run = lab::run_thesis(program, start, limits, control_);
    if (!control_.stop_requested()) rows.push_back({program, scene, tau, run});
  }

  void by_size() {
    say_("figures 4.1 to 4.4: particle numbers");
    for (const int side : side_lengths) {
      if (side * side > request_.largest) return;
      for (const double kappa : {aspect_ratio, 1.0}) {
        const lab::ThesisScene of = scene(side * side, kappa);
        const Configuration2 start = lab::equilibrated(of, warm_up);
        for (const Program program : programs)
          for (const double tau : {0.0, brownian_step})
            run(bench_.by_size, program, of, tau, start);
      }
      control_.report_progress({static_cast<double>(side * side) / request_.largest,
                                static_cast<double>(side * side), "particles"});
    }
  }

  void by_aspect_ratio() {
    say_("figure 4.3: aspect ratios");
    for (const double kappa : aspect_ratios) {
      if (control_.stop_requested()) return;
      const lab::ThesisScene of = scene(100, kappa);
      const Configuration2 start = lab::equilibrated(of, 5 * warm_up);
      for (const double tau : {0.0, brownian_step})
        run(bench_.by_aspect_ratio, Program::ours, of, tau, start);
    }
  }

  void energies() {
    say_("figure 4.6: energies");
    const auto note = [&](const Configuration2& now) {
      const Mechanics sums = mechanics(now);
      const auto n = static_cast<double>(now.size());
      bench_.energies.push_back(
          {now.time, sums.translational_energy / n, sums.rotational_energy / n});
    };
    const Configuration2 start = lab::equilibrated(scene(100, aspect_ratio), warm_up);
    note(start);
    const lab::ThesisRun run =
        lab::run_thesis(Program::ours, start, {request_.duration}, control_, note);
    bench_.energy_drift = run.energy_drift;
  }

  void relaxations() {
    say_("figure 4.7: relaxation");
    constexpr double dense = 0.5, dilute = 0.001, tau = brownian_step;
    for (const auto& [density, share, step, duration] : {std::tuple{dense, 1.0, 0.0, 1e2},
                                                         {dense, 0.0, 0.0, 1e2},
                                                         {dilute, 1.0, 0.0, 1e4},
                                                         {dense, 1.0, tau, 1e2},
                                                         {dense, 0.0, tau, 1e2},
                                                         {dilute, 1.0, tau, 1e2}}) {
      if (control_.stop_requested()) return;
      bench_.relaxations.push_back(lab::relax(
          {density, share, step, duration, request_.relaxations, request_.seed}, control_));
    }
  }

  const ThesisRequest& request_;
  const RunControl& control_;
  const std::function<void(const std::string&)>& say_;
  ThesisBench bench_;
};

bool is_round(const ThesisRow& row) {
  return row.scene.aspect_ratio == 1;
}

const char* dynamics_name(double tau) {
  return tau > 0 ? "Brownian" : "Newtonian";
}

std::string shape_name(double kappa) {
  return kappa == 1 ? "circles" : "ellipses";
}

std::string program_name(Program program) {
  switch (program) {
    case Program::ours:
      return "vitrel";
    case Program::thesis:
      return "all pairs";
    case Program::improved:
      return "all pairs, improved";
  }
  return "";
}

std::string row_note(const ThesisRow& row) {
  return fmt::format(
      "{}, {}, {}, N = {}: {:.3g} s per unit of time, {} collisions, {} correction "
      "moves in {:.4g} units of time",
      program_name(row.program), shape_name(row.scene.aspect_ratio),
      dynamics_name(row.brownian_step), row.scene.particles, row.per_unit_of_time(),
      row.run.counters.collisions, row.run.counters.correction_moves, row.run.simulated_time);
}

/// Mean time per unit of simulated time by N, over Newtonian and Brownian runs as in the thesis.
std::map<int, double> durations(const std::vector<ThesisRow>& rows, Program program, double kappa) {
  std::map<int, std::pair<double, int>> sums;
  for (const ThesisRow& row : rows) {
    if (row.program != program || row.scene.aspect_ratio != kappa || row.run.stood_still) continue;
    auto& [sum, count] = sums[row.scene.particles];
    sum += row.per_unit_of_time();
    ++count;
  }
  std::map<int, double> means;
  for (const auto& [particles, sum] : sums) means[particles] = sum.first / sum.second;
  return means;
}

ChartSeries duration_series(const std::vector<ThesisRow>& rows, Program program, double kappa) {
  ChartSeries series{program_name(program) + ", " + shape_name(kappa), {}, true};
  for (const auto& [particles, seconds] : durations(rows, program, kappa))
    series.points.push_back({static_cast<double>(particles), seconds, kappa == 1,
                             fmt::format("{}, N = {}: {:.3g} s", series.name, particles, seconds)});
  return series;
}

std::string exponent_note(const std::vector<ThesisRow>& rows, Program program, double kappa) {
  return fmt::format("{}, {}: N^{:.2f}", program_name(program), shape_name(kappa),
                     growth_exponent(rows, program, kappa));
}

Chart duration_chart(const std::vector<ThesisRow>& rows) {
  Chart chart;
  chart.title = "Figure 4.1: seconds of work for one unit of simulated time, φ = 0.5";
  chart.x = {"number of particles N", true, {}};
  chart.y = {"seconds per unit of time", true, {}};
  chart.notes = {"all pairs: the thesis's program,", "every pair asked after every event",
                 "improved: only those changed,", "and every answer checked",
                 "slopes of straight lines:"};
  for (const Program program : {Program::thesis, Program::improved, Program::ours})
    for (const double kappa : {aspect_ratio, 1.0}) {
      chart.series.push_back(duration_series(rows, program, kappa));
      chart.notes.push_back(exponent_note(rows, program, kappa));
    }
  return chart;
}

Chart linear_chart(const std::vector<ThesisRow>& rows) {
  Chart chart;
  chart.title = "Figure 4.2: milliseconds for one unit of simulated time, vitrel, φ = 0.5";
  chart.x = {"number of particles N", false, {}};
  chart.y = {"milliseconds per unit of time", false, {}};
  for (const double kappa : {aspect_ratio, 1.0}) {
    ChartSeries series = duration_series(rows, Program::ours, kappa);
    for (ChartPoint& point : series.points) point.y *= 1000;
    series.points.insert(series.points.begin(), {0, 0, true, "none"});
    chart.series.push_back(series);
  }
  return chart;
}

Chart ratio_chart(const std::vector<ThesisRow>& rows) {
  Chart chart;
  chart.title = "Cost of an ellipse (κ = 2) over that of a circle of the same area, φ = 0.5";
  chart.x = {"number of particles N", true, {}};
  chart.y = {"ratio of the times per unit of time", true, {}};
  for (const Program program : {Program::thesis, Program::improved, Program::ours}) {
    ChartSeries series{program_name(program), {}, true};
    const auto circles = durations(rows, program, 1);
    for (const auto& [particles, seconds] : durations(rows, program, aspect_ratio))
      if (circles.contains(particles))
        series.points.push_back({static_cast<double>(particles), seconds / circles.at(particles),
                                 false,
                                 fmt::format("{}, N = {}: {:.3g}", series.name, particles,
                                             seconds / circles.at(particles))});
    chart.series.push_back(series);
  }
  return chart;
}

/// One series for every kind of run that `choose` takes, in the order in which they come.
template <class Choose, class Point>
std::vector<ChartSeries> series_of(const std::vector<ThesisRow>& rows, Choose choose, Point point) {
  std::vector<ChartSeries> all;
  for (const ThesisRow& row : rows) {
    const std::optional<std::string> name = choose(row);
    if (!name) continue;
    auto at = std::ranges::find(all, *name, &ChartSeries::name);
    if (at == all.end()) at = all.insert(all.end(), {*name, {}, true});
    at->points.push_back(point(row));
  }
  return all;
}

Chart collisions_chart(const std::vector<ThesisRow>& rows) {
  Chart chart;
  chart.title = "Figure 4.3: collisions per unit of time, φ = 0.5";
  chart.x = {"number of particles N", false, {}};
  chart.y = {"collisions per unit of time", false, {}};
  chart.notes = {fmt::format("Brownian: τ_B = {:g}", brownian_step),
                 "ellipses: κ = 2, of the same area", "hollow: the thesis's program"};
  const auto choose = [](const ThesisRow& row) -> std::optional<std::string> {
    if (row.program == Program::improved || row.run.stood_still) return {};
    if (row.run.simulated_time < long_enough) return {};
    const std::string kind = shape_name(row.scene.aspect_ratio);
    if (row.program == Program::ours)
      return fmt::format("{} {}", dynamics_name(row.brownian_step), kind);
    if (is_round(row)) return {};
    return fmt::format("{} {}, all pairs", dynamics_name(row.brownian_step), kind);
  };
  const auto point = [](const ThesisRow& row) {
    return ChartPoint{static_cast<double>(row.scene.particles), row.collision_rate(),
                      row.program != Program::ours, row_note(row)};
  };
  chart.series = series_of(rows, choose, point);
  return chart;
}

Chart aspect_ratio_chart(const std::vector<ThesisRow>& rows) {
  Chart chart;
  chart.title = "Figure 4.3 at equal area: collisions against the aspect ratio, N = 100, φ = 0.5";
  chart.x = {"aspect ratio κ", false, {}};
  chart.y = {"collisions per particle and unit of time", false, {}};
  const auto choose = [](const ThesisRow& row) -> std::optional<std::string> {
    return dynamics_name(row.brownian_step);
  };
  const auto point = [](const ThesisRow& row) {
    return ChartPoint{row.scene.aspect_ratio, row.collision_rate() / row.scene.particles, false,
                      row_note(row)};
  };
  chart.series = series_of(rows, choose, point);
  return chart;
}

enum class Corrections { absolute, relative };

Chart corrections_chart(const std::vector<ThesisRow>& rows, Corrections kind) {
  const bool relative = kind == Corrections::relative;
  Chart chart;
  chart.title = relative ? "Figure 4.4: correction moves per 1000 collisions, ellipses"
                         : "Figure 4.4: correction moves per unit of time, ellipses";
  chart.x = {"number of particles N", true, {}};
  chart.y = {relative ? "moves per 1000 collisions" : "moves per unit of time", true, {}};
  chart.floor = relative ? 1e-2 : 1e-3;
  chart.floor_label = "none";
  chart.notes = {"hollow: the run stood still"};
  const auto choose = [](const ThesisRow& row) -> std::optional<std::string> {
    if (is_round(row) || row.run.simulated_time < long_enough) return {};
    if (row.program == Program::ours) return program_name(row.program);
    return program_name(row.program) + ", " + dynamics_name(row.brownian_step);
  };
  const auto point = [&](const ThesisRow& row) {
    const double moves = static_cast<double>(row.run.counters.correction_moves);
    return ChartPoint{static_cast<double>(row.scene.particles),
                      relative ? row.moves_per_thousand() : moves / row.run.simulated_time,
                      row.run.stood_still, row_note(row)};
  };
  chart.series = series_of(rows, choose, point);
  return chart;
}

ChartSeries level(const std::string& name, double from, double to, double value) {
  return {name, {{from, value, false, ""}, {to, value, false, ""}}, false};
}

Chart energies_chart(const std::vector<EnergySample>& samples) {
  Chart chart;
  chart.title = "Figure 4.6: energies of one run per particle, N = 100, κ = 2, φ = 0.5";
  chart.x = {"time", false, {}};
  chart.y = {"energy per particle / kT", false, {}};
  chart.series = {{"total", {}, false}, {"kinetic", {}, false}, {"rotational", {}, false}};
  for (const EnergySample& at : samples) {
    chart.series[0].points.push_back({at.time, at.kinetic + at.rotational, false, ""});
    chart.series[1].points.push_back({at.time, at.kinetic, false, ""});
    chart.series[2].points.push_back({at.time, at.rotational, false, ""});
  }
  if (samples.empty()) return chart;
  const double end = samples.back().time;
  chart.series.push_back(level("equipartition, 1", 0, end, 1));
  chart.series.push_back(level("equipartition, 1/2", 0, end, 0.5));
  return chart;
}

std::string relaxation_name(const lab::RelaxationScene& scene) {
  return fmt::format("φ = {:g}, {}{}", scene.packing_fraction, dynamics_name(scene.brownian_step),
                     scene.share == 0 ? ", spinning" : "");
}

Chart relaxation_chart(const std::vector<lab::Relaxation>& relaxations) {
  Chart chart;
  chart.title = "Figure 4.7: kinetic energy after a wrong split, N = 100, κ = 2";
  chart.x = {"time", true, {}};
  chart.y = {"kinetic energy per particle / kT", false, {}};
  for (const lab::Relaxation& of : relaxations) {
    ChartSeries series{relaxation_name(of.scene), {}, true};
    for (std::size_t k = 0; k < of.times.size(); ++k)
      series.points.push_back({of.times[k], of.kinetic[k], of.scene.brownian_step > 0,
                               fmt::format("t = {:.3g}: {:.4f}", of.times[k], of.kinetic[k])});
    chart.series.push_back(series);
  }
  chart.series.push_back(level("equipartition", 0.01, 1e4, 1));
  chart.notes = {"all energy begins in translation,", "or (spinning) in rotation;",
                 "Brownian: drawn so anew every", "τ_B = 0.1, shown just before"};
  return chart;
}

Json row_json(const ThesisRow& row) {
  const lab::ThesisRun& run = row.run;
  return {{"program", lab::name_of(row.program)},
          {"aspect_ratio", row.scene.aspect_ratio},
          {"dynamics", dynamics_name(row.brownian_step)},
          {"particles", row.scene.particles},
          {"simulated_time", run.simulated_time},
          {"seconds", run.seconds},
          {"collisions", run.counters.collisions},
          {"predictions", run.counters.predictions},
          {"correction_moves", run.counters.correction_moves},
          {"energy_drift", run.energy_drift},
          {"samples", run.samples},
          {"samples_with_overlap", run.samples_with_overlap},
          {"deepest_overlap", run.deepest_overlap},
          {"stood_still", run.stood_still}};
}

Json relaxation_json(const lab::Relaxation& of) {
  return {{"packing_fraction", of.scene.packing_fraction},
          {"share_in_translation", of.scene.share},
          {"dynamics", dynamics_name(of.scene.brownian_step)},
          {"brownian_step", of.scene.brownian_step},
          {"runs", of.scene.runs},
          {"times", of.times},
          {"kinetic", of.kinetic},
          {"expected", of.expected},
          {"standard_error", of.standard_error},
          {"samples", of.samples},
          {"samples_with_overlap", of.samples_with_overlap}};
}

Json exponents_json(const std::vector<ThesisRow>& rows) {
  Json list = Json::array();
  for (const Program program : programs)
    for (const double kappa : {aspect_ratio, 1.0})
      list.push_back({{"program", lab::name_of(program)},
                      {"aspect_ratio", kappa},
                      {"exponent", growth_exponent(rows, program, kappa)}});
  return list;
}

}  // namespace

ThesisBench bench_thesis(const ThesisRequest& request, const RunControl& control,
                         const std::function<void(const std::string&)>& say) {
  return Runs(request, control, say).all();
}

double growth_exponent(const std::vector<ThesisRow>& rows, Program program, double kappa) {
  const auto points = durations(rows, program, kappa);
  if (points.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [particles, seconds] : points) {
    const double log_n = std::log(particles), log_s = std::log(seconds);
    n += 1, x += log_n, y += log_s, xx += log_n * log_n, xy += log_n * log_s;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

Json thesis_rows_json(const std::vector<ThesisRow>& rows) {
  Json list = Json::array();
  for (const ThesisRow& row : rows) list.push_back(row_json(row));
  return list;
}

Json thesis_json(const ThesisBench& bench) {
  Json energies = Json::array(), relaxations = Json::array();
  for (const EnergySample& at : bench.energies)
    energies.push_back({at.time, at.kinetic, at.rotational});
  for (const lab::Relaxation& of : bench.relaxations) relaxations.push_back(relaxation_json(of));
  return {{"rows", thesis_rows_json(bench.by_size)},
          {"exponents", exponents_json(bench.by_size)},
          {"by_aspect_ratio", thesis_rows_json(bench.by_aspect_ratio)},
          {"energies", energies},
          {"energy_drift", bench.energy_drift},
          {"relaxations", relaxations}};
}

std::string thesis_text(const ThesisBench& bench) {
  std::string text =
      fmt::format("{:<11} {:<9} {:<10} {:>5} {:>8} {:>11} {:>13} {:>12}\n", "program", "shape",
                  "dynamics", "N", "time", "collisions", "corrections", "s per time");
  for (const ThesisRow& row : bench.by_size)
    text +=
        fmt::format("{:<11} {:<9} {:<10} {:>5} {:>8.4g} {:>11} {:>13} {:>12.3g}{}\n",
                    program_name(row.program), shape_name(row.scene.aspect_ratio),
                    dynamics_name(row.brownian_step), row.scene.particles, row.run.simulated_time,
                    row.run.counters.collisions, count_text(row.run.counters.correction_moves),
                    row.per_unit_of_time(), row.run.stood_still ? " stood still" : "");
  for (const lab::Relaxation& of : bench.relaxations)
    text +=
        fmt::format("relaxation, {}: kinetic energy {:.4f}, in equilibrium {:.4f} ± {:.4f}\n",
                    relaxation_name(of.scene), of.kinetic.back(), of.expected, of.standard_error);
  return text;
}

std::vector<ThesisFigure> thesis_figures(const ThesisBench& bench) {
  return {{"duration.svg", duration_chart(bench.by_size)},
          {"linear.svg", linear_chart(bench.by_size)},
          {"cost-ratio.svg", ratio_chart(bench.by_size)},
          {"collisions.svg", collisions_chart(bench.by_size)},
          {"collisions-aspect-ratio.svg", aspect_ratio_chart(bench.by_aspect_ratio)},
          {"corrections.svg", corrections_chart(bench.by_size, Corrections::absolute)},
          {"corrections-relative.svg", corrections_chart(bench.by_size, Corrections::relative)},
          {"energies.svg", energies_chart(bench.energies)},
          {"relaxation.svg", relaxation_chart(bench.relaxations)}};
}

}  // namespace vitrel
