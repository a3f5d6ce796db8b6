#include "analysis/observables/motion_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace vitrel {
namespace {

constexpr auto in_motion = Chart::Section::motion, in_relaxation = Chart::Section::relaxation;

std::vector<Observable> velocity_observables() {
  const Needs needs{.motion = true, .velocities = true};
  const Chart correlation{
      .section = in_relaxation,
      .heading = "Velocity autocorrelation",
      .symbol = "C(t)",
      .curves = {{"c", "of velocities"}, {"c_angular", "of angular velocities"}},
      .is_x_logarithmic = true,
      .levels = {0}};
  const Chart spectrum{.section = in_relaxation,
                       .heading = "Spectrum of velocities",
                       .symbol = "g(ω)",
                       .curves = {{"g", "of velocities"}, {"g_angular", "of angular velocities"}},
                       .x = "frequency",
                       .x_symbol = "ω"};
  return {
      {.table = "velocity_autocorrelation",
       .what = "Autocorrelations <v(0).v(t)>/<v^2> of velocities and of angular velocities.",
       .columns = {time_difference_column(),
                   {"c", "1", "⟨v(0)·v(t)⟩/⟨v²⟩", true},
                   {"c_angular", "1", "⟨ω(0)·ω(t)⟩/⟨ω²⟩", true},
                   origins_column()},
       .needs = needs,
       .charts = {correlation}},
      {.table = "velocity_spectrum",
       .what = "Spectra (2/pi) int C(t) cos(wt) dt of these autocorrelations, for evenly sampled "
               "runs: the density of states of vibrations; the integral over w is 1.",
       .columns = {{"frequency", "rad/time", "angular frequency w"},
                   {"g", "time/rad", "(2/π) ∫ C(t) cos(wt) dt", true},
                   {"g_angular", "time/rad", "the same of ω", true}},
       .needs = needs,
       .charts = {spectrum}}};
}

std::vector<Table> velocity_tables(const VelocityCorrelations& found) {
  const std::vector<Observable> observables = velocity_observables();
  Table correlation{
      observables[0].table,
      observables[0].what + fmt::format(" <v^2> = {:.6g}, <omega^2> = {:.6g}.",
                                        found.translation.mean_square, found.rotation.mean_square),
      {{"time", "time", found.lag}}};
  Table spectrum{
      observables[1].table, observables[1].what, {{"frequency", "rad/time", found.frequency}}};
  const auto add = [&](const std::string& ending, const VelocityCorrelation& of) {
    if (of.correlation.value.empty()) return;
    correlation.columns.push_back({"c" + ending, "1", of.correlation.value, of.correlation.error});
    spectrum.columns.push_back({"g" + ending, "time/rad", of.spectrum.mean, of.spectrum.error});
  };
  add("", found.translation);
  add("_angular", found.rotation);
  correlation.columns.push_back({"origins", "1", {found.origins.begin(), found.origins.end()}});
  if (found.frequency.empty()) return {correlation};
  return {correlation, spectrum};
}

Observable viscosity_observable() {
  return {.table = "viscosity",
          .what =
              "Mean squared change of the Helfand moments, <(G(t) - G(0))^2>/(2 V kT), whose "
              "slope is the shear viscosity; of elastic Newtonian runs.",
          .columns = {time_difference_column(),
                      {"moment", "kT time^2/length^*", "⟨(G(t) − G(0))²⟩/(2 V kT)", true},
                      origins_column()},
          .needs = {.motion = true},
          .charts = {{.section = in_motion,
                      .heading = "Helfand moment of the shear stress",
                      .symbol = "⟨ΔG(t)²⟩/(2VkT)",
                      .curves = {{"moment", "⟨ΔG²⟩"}},
                      .scale = Chart::Scale::logarithmic,
                      .is_x_logarithmic = true,
                      .has_power_laws = true}}};
}

Table viscosity_table(const Viscosity& found, int dimension) {
  const Observable observable = viscosity_observable();
  return {observable.table,
          observable.what,
          {{"time", "time", found.lag},
           {"moment", fmt::format("kT time^2/length^{}", dimension), found.moment.value,
            found.moment.error},
           {"origins", "1", {found.origins.begin(), found.origins.end()}}}};
}

/// Returns the description of the table of a function of two times, which has a column for every lag.
Observable of_two_times(const char* name, const char* what, std::vector<ColumnKind> columns,
                        Chart chart) {
  chart.numbers = {"lag_times", "time", "t"};
  return {.table = name,
          .what = what,
          .columns = std::move(columns),
          .needs = {.motion = true},
          .charts = {std::move(chart)}};
}

std::vector<Observable> two_time_tables() {
  return {of_two_times("van_hove_self",
                       "Self part of the Van Hove function: density of the distances that "
                       "particles move in the times of table lag_times, 2 pi r G_s in the plane "
                       "and 4 pi r^2 G_s in space.",
                       {{"r", "length", "distance"},
                        {"density_#", "1/length",
                         "density of |Δr(t_k)|: 2π r G_s, in space 4π r² G_s", true}},
                       {.section = in_motion,
                        .heading = "Van Hove function, self part",
                        .symbol = "density of |Δr|",
                        .curves = {{"density_#", "#"}},
                        .scale = Chart::Scale::logarithmic,
                        .x = "r",
                        .x_symbol = "r",
                        .is_x_logarithmic = true}),
          of_two_times("van_hove_distinct",
                       "Distinct part of the Van Hove function: G_d/density of other particles "
                       "around where one was the times of table lag_times before, g(r) for t = 0.",
                       {{"r", "length", "distance"}, {"g_#", "1", "G_d(r, t_k)/ρ", true}},
                       {.section = in_motion,
                        .heading = "Van Hove function, distinct part",
                        .symbol = "G_d(r, t)/ρ",
                        .curves = {{"g_#", "#"}},
                        .scale = Chart::Scale::around_one,
                        .x = "r",
                        .x_symbol = "r",
                        .levels = {1}}),
          of_two_times("four_point_structure",
                       "Four-point structure factor <|sum_i w_i exp(iq.r_i(0))|^2>/N at small q: "
                       "w_i = 1 for particles closer than analysis.overlap_distance to where they "
                       "were the times of table lag_times before, else 0.",
                       {{"q", "1/length", "wave number"},
                        {"s4_#", "1",
                         "⟨|Σ w_i exp(iq·r_i(0))|²⟩/N, w_i = 1 if |Δr_i(t_k)| < "
                         "analysis.overlap_distance, else 0",
                         true}},
                       {.section = in_relaxation,
                        .heading = "Four-point structure factor",
                        .symbol = "S₄(q, t)",
                        .curves = {{"s4_#", "#"}},
                        .scale = Chart::Scale::from_zero,
                        .x = "q",
                        .x_symbol = "q"})};
}

Table lag_table(const std::vector<Lag>& lags) {
  Table table{"lag_times",
              "Time differences t_k of the tables with a column for each, and their origins.",
              {{"index", "1"}, {"time", "time"}, {"origins", "1"}}};
  for (const Lag& lag : lags)
    add_row(table,
            {static_cast<double>(table.rows() + 1), lag.time, static_cast<double>(lag.origins)});
  return table;
}

Table table_of(const Observable& kind, const TwoTimeAverages& found) {
  const ColumnKind &x = kind.columns.front(), &at_lags = kind.columns.back();
  Table table{kind.table, kind.what, {{x.name, x.unit, found.x}}};
  const std::string name = at_lags.name.substr(0, at_lags.name.size() - 1);  // without #
  for (const Averages& lag : found.at_lag)
    table.columns.push_back(
        {fmt::format("{}{}", name, table.columns.size()), at_lags.unit, lag.mean, lag.error});
  return table;
}

}  // namespace

std::vector<Table> motion_tables(const RunMotion& motion) {
  std::vector<Table> tables;
  if (motion.velocities) tables = velocity_tables(*motion.velocities);
  if (motion.viscosity) tables.push_back(viscosity_table(*motion.viscosity, motion.dimension));
  tables.push_back(lag_table(motion.lags));
  const std::vector<Observable> kinds = two_time_tables();
  for (std::size_t k = 0; k < motion.two_times.size(); ++k)
    tables.push_back(table_of(kinds[k], motion.two_times[k]));
  return tables;
}

std::vector<Observable> motion_observables() {
  std::vector<Observable> observables = velocity_observables();
  observables.push_back(viscosity_observable());
  observables.push_back(
      {.table = "lag_times",
       .what = "Time differences of the tables with a column for each, about ten.",
       .columns = {{"index", "1", "k"}, {"time", "time", "t_k"}, origins_column()},
       .needs = {.motion = true}});
  std::ranges::move(two_time_tables(), std::back_inserter(observables));
  return observables;
}

}  // namespace vitrel
