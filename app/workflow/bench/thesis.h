#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/workflow/bench/chart.h"
#include "bench/lab/thesis_run.h"

/// `vitrel bench thesis`: the figures of chapter 4 of the thesis, with its program (all pairs, SLSQP)
/// and with this one.
namespace vitrel {

struct ThesisRequest {
  double seconds = 1;     ///< that one run of the thesis's program may work; it then is cut short
  double duration = 100;  ///< simulated time of runs; longer for fewer than 400 particles
  int largest = 400;      ///< number of particles
  int relaxations = 32;   ///< runs that are averaged in figure 4.7
  std::uint64_t seed = 1;
};

struct ThesisRow {
  lab::Program program;
  lab::ThesisScene scene;
  double brownian_step = 0;  ///< 0: Newtonian
  lab::ThesisRun run;

  double per_unit_of_time() const { return run.seconds / run.simulated_time; }  ///< seconds
  double collision_rate() const {
    return static_cast<double>(run.counters.collisions) / run.simulated_time;
  }
  double moves_per_thousand() const {
    return 1000 * static_cast<double>(run.counters.correction_moves) /
           static_cast<double>(run.counters.collisions);
  }
};

/// Energies per particle at a time of one run.
struct EnergySample {
  double time, kinetic, rotational;
};

struct ThesisBench {
  std::vector<ThesisRow> by_size;          ///< figures 4.1 to 4.4
  std::vector<ThesisRow> by_aspect_ratio;  ///< figure 4.3 at equal area
  std::vector<EnergySample> energies;      ///< figure 4.6
  double energy_drift = 0;                 ///< of that run, largest |E − E₀|/E₀
  std::vector<lab::Relaxation> relaxations;
  bool stopped = false;
};

ThesisBench bench_thesis(const ThesisRequest& request, const RunControl& control,
                         const std::function<void(const std::string&)>& say);

/// How the time per unit of simulated time grows with N: the slope of a straight line through the
/// logarithms, Newtonian and Brownian runs together; NaN for fewer than two sizes.
double growth_exponent(const std::vector<ThesisRow>& rows, lab::Program program,
                       double aspect_ratio);

nlohmann::ordered_json thesis_rows_json(const std::vector<ThesisRow>& rows);
/// Everything, for the file.
nlohmann::ordered_json thesis_json(const ThesisBench& bench);
/// The rows as lines; "·" stands for 0.
std::string thesis_text(const ThesisBench& bench);

/// A chart and the name of its file.
struct ThesisFigure {
  std::string file;
  Chart chart;
};
std::vector<ThesisFigure> thesis_figures(const ThesisBench& bench);

}  // namespace vitrel
