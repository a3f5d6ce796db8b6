#include "bench/programs/thesis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "app/terminal/exit_codes.h"
#include "bench/programs/number_text.h"
#include "core/io/json.h"

namespace vitrel::bench {
namespace {

constexpr double brownian_step = 0.1;
constexpr double warm_up = 20;
constexpr double aspect_ratio = 2;
constexpr std::array programs{Program::ours, Program::thesis, Program::improved};
constexpr std::array side_lengths{4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 18, 20};
constexpr std::array aspect_ratios{1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0};

/// Energies per particle at a time of one run.
struct EnergySample {
  double time, kinetic, rotational;
};

struct Measured {
  std::vector<ThesisRow> by_size;          ///< figures 4.1 to 4.4
  std::vector<ThesisRow> by_aspect_ratio;  ///< figure 4.3 at equal area
  std::vector<EnergySample> energies;      ///< figure 4.6
  double energy_drift = 0;                 ///< of that run, largest |E − E₀|/E₀
  std::vector<Relaxation> relaxations;
};

/// The runs of the benchmark, one after the other.
class Runs {
 public:
  Runs(const ThesisOptions& options, Report& report)
      : options_(options), report_(report), control_(report.control()) {}

  Measured all() {
    by_size();
    by_aspect_ratio();
    energies();
    relaxations();
    return measured_;
  }

 private:
  ThesisScene scene(int particles, double kappa) const {
    return {particles, kappa, 0.5, options_.seed};
  }

  void run(std::vector<ThesisRow>& rows, Program program, const ThesisScene& scene, double tau,
           const Configuration2& start) {
    if (control_.stop_requested()) return;
    RunLimits limits{options_.duration, 1e9, tau, options_.seed};
    // Small systems run longer, so that all have as much to do.
    if (program == Program::ours)
      limits.duration *= std::max(
          1.0, static_cast<double>(side_lengths.back() * side_lengths.back()) / scene.particles);
    else
      limits.seconds = options_.seconds;
    const ThesisRun run = run_thesis(program, start, limits, control_);
    if (!control_.stop_requested()) rows.push_back({program, scene, tau, run});
  }

  void by_size() {
    report_.say("figures 4.1 to 4.4: particle numbers");
    for (const int side : side_lengths) {
      if (side * side > options_.largest) return;
      for (const double kappa : {aspect_ratio, 1.0}) {
        const ThesisScene of = scene(side * side, kappa);
        const Configuration2 start = equilibrated(of, warm_up);
        for (const Program program : programs)
          for (const double tau : {0.0, brownian_step})
            run(measured_.by_size, program, of, tau, start);
      }
      control_.report_progress({static_cast<double>(side * side) / options_.largest,
                                static_cast<double>(side * side), "particles"});
    }
  }

  void by_aspect_ratio() {
    report_.say("figure 4.3: aspect ratios");
    for (const double kappa : aspect_ratios) {
      if (control_.stop_requested()) return;
      const ThesisScene of = scene(100, kappa);
      const Configuration2 start = equilibrated(of, 5 * warm_up);
      for (const double tau : {0.0, brownian_step})
        run(measured_.by_aspect_ratio, Program::ours, of, tau, start);
    }
  }

  void energies() {
    report_.say("figure 4.6: energies");
    const auto note = [&](const Configuration2& now) {
      const Mechanics sums = mechanics(now);
      const auto n = static_cast<double>(now.size());
      measured_.energies.push_back(
          {now.time, sums.translational_energy / n, sums.rotational_energy / n});
    };
    const Configuration2 start = equilibrated(scene(100, aspect_ratio), warm_up);
    note(start);
    const ThesisRun run = run_thesis(Program::ours, start, {options_.duration}, control_, note);
    measured_.energy_drift = run.energy_drift;
  }

  void relaxations() {
    report_.say("figure 4.7: relaxation");
    constexpr double dense = 0.5, dilute = 0.001, tau = brownian_step;
    for (const auto& [density, share, step, duration] : {std::tuple{dense, 1.0, 0.0, 1e2},
                                                         {dense, 0.0, 0.0, 1e2},
                                                         {dilute, 1.0, 0.0, 1e4},
                                                         {dense, 1.0, tau, 1e2},
                                                         {dense, 0.0, tau, 1e2},
                                                         {dilute, 1.0, tau, 1e2}}) {
      if (control_.stop_requested()) return;
      measured_.relaxations.push_back(
          relax({density, share, step, duration, options_.relaxations, options_.seed}, control_));
    }
  }

  const ThesisOptions& options_;
  Report& report_;
  const RunControl& control_;
  Measured measured_;
};

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

std::string relaxation_name(const RelaxationScene& scene) {
  return fmt::format("φ = {:g}, {}{}", scene.packing_fraction, dynamics_name(scene.brownian_step),
                     scene.share == 0 ? ", spinning" : "");
}

Json row_json(const ThesisRow& row) {
  const ThesisRun& run = row.run;
  return {{"program", name_of(row.program)},
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

Json relaxation_json(const Relaxation& of) {
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
      list.push_back({{"program", name_of(program)},
                      {"aspect_ratio", kappa},
                      {"exponent", growth_exponent(rows, program, kappa)}});
  return list;
}

Json rows_json(const std::vector<ThesisRow>& rows) {
  Json list = Json::array();
  for (const ThesisRow& row : rows) list.push_back(row_json(row));
  return list;
}

Json measured_json(const Measured& measured) {
  Json energies = Json::array(), relaxations = Json::array();
  for (const EnergySample& at : measured.energies)
    energies.push_back({at.time, at.kinetic, at.rotational});
  for (const Relaxation& of : measured.relaxations) relaxations.push_back(relaxation_json(of));
  return {{"rows", rows_json(measured.by_size)},
          {"exponents", exponents_json(measured.by_size)},
          {"by_aspect_ratio", rows_json(measured.by_aspect_ratio)},
          {"energies", energies},
          {"energy_drift", measured.energy_drift},
          {"relaxations", relaxations}};
}

/// The rows as lines; "·" stands for 0.
std::string text_of(const Measured& measured) {
  std::string text =
      fmt::format("{:<11} {:<9} {:<10} {:>5} {:>8} {:>11} {:>13} {:>12}\n", "program", "shape",
                  "dynamics", "N", "time", "collisions", "corrections", "s per time");
  for (const ThesisRow& row : measured.by_size)
    text +=
        fmt::format("{:<11} {:<9} {:<10} {:>5} {:>8.4g} {:>11} {:>13} {:>12.3g}{}\n",
                    program_name(row.program), shape_name(row.scene.aspect_ratio),
                    dynamics_name(row.brownian_step), row.scene.particles, row.run.simulated_time,
                    row.run.counters.collisions, count_text(row.run.counters.correction_moves),
                    row.per_unit_of_time(), row.run.stood_still ? " stood still" : "");
  for (const Relaxation& of : measured.relaxations)
    text +=
        fmt::format("relaxation, {}: kinetic energy {:.4f}, in equilibrium {:.4f} ± {:.4f}\n",
                    relaxation_name(of.scene), of.kinetic.back(), of.expected, of.standard_error);
  return text;
}

}  // namespace

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

int thesis(const ThesisOptions& options, const OutputOptions& output) {
  Report report(output);
  const Measured measured = Runs(options, report).all();
  report.print(rows_json(measured.by_size), text_of(measured));
  if (report.control().stop_requested()) return report.stopped_early();
  if (!report.is_wanted()) return success;
  Json data = measured_json(measured);
  report.add_provenance(
      data,
      {{"runs", fmt::format("{:g} units of time, up to {} particles, seed {}", options.duration,
                            options.largest, options.seed)},
       {"time limit", fmt::format("{:g} s for a run of the thesis's program", options.seconds)}});
  report.write_data("thesis", data);
  return success;
}

}  // namespace vitrel::bench
