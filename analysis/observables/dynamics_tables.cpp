#include "analysis/observables/dynamics_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace vitrel {
namespace {

Column time_column(const std::vector<double>& lag) {
  return {"time", "time", lag};
}

Column column(const std::string& name, const char* unit, const Correlation& correlation) {
  return {name, unit, correlation.value, correlation.error};
}

/// Adds a column for every function, whose number, from 1, replaces {} in the name.
void add_numbered(Table& table, const char* name, const std::vector<Correlation>& functions) {
  for (std::size_t k = 0; k < functions.size(); ++k)
    table.columns.push_back(column(fmt::format(fmt::runtime(name), k + 1), "1", functions[k]));
}

std::vector<double> numbers(const std::vector<std::size_t>& counts) {
  return {counts.begin(), counts.end()};
}

constexpr auto motion = Chart::Section::motion, relaxation = Chart::Section::relaxation;
constexpr auto logarithmic = Chart::Scale::logarithmic, decay = Chart::Scale::decay;
const double one_e = std::exp(-1);

/// Returns a chart against the logarithm of the time difference.
Chart against_time(Chart::Section section, const char* heading, const char* symbol,
                   std::vector<Curve> curves, Chart::Scale scale = Chart::Scale::linear) {
  return {.section = section,
          .heading = heading,
          .symbol = symbol,
          .curves = std::move(curves),
          .scale = scale,
          .is_x_logarithmic = true};
}

Chart mean_square(const char* heading, const char* symbol, std::vector<Curve> curves) {
  Chart chart = against_time(motion, heading, symbol, std::move(curves), logarithmic);
  chart.has_power_laws = true;
  return chart;
}

Chart correlation(const char* heading, const char* symbol, std::vector<Curve> curves) {
  Chart chart = against_time(relaxation, heading, symbol, std::move(curves), decay);
  chart.levels = {one_e};
  return chart;
}

/// Returns a chart of scattering functions, which are numbered like the wave numbers in this column.
Chart at_wave_numbers(Chart chart, const char* column = "q") {
  chart.numbers = {"wave_numbers", column, "q"};
  return chart;
}

Chart at_waiting_times(Chart chart) {
  chart.numbers = {"waiting_times", "waiting_time", "t_w"};
  return chart;
}

/// The words that differ between the plane and space.
struct Words {
  const char *axis, *non_gaussian, *unit_length, *unit_time, *orientation, *orientation_column;
};

Words words_of(int dimension) {
  if (dimension == 2)
    return {"long axis",
            "<r^4>/(2 <r^2>^2) - 1 and <turn^4>/(3 <turn^2>^2) - 1",
            "a b",
            "sqrt(m a b/kT)",
            "L_n(t) = <cos n(angle(t) - angle(0))>",
            "l"};
  return {"axis of symmetry, of scalene bodies the longest,",
          "3 <r^4>/(5 <r^2>^2) - 1 and 3 <turn^4>/(5 <turn^2>^2) - 1 of the rotation vector",
          "a b c",
          "sqrt(m (a b c)^(2/3)/kT)",
          "<P_n(u(0).u(t))> (Legendre) of the axis u of symmetry; of scalene bodies that of the "
          "longest, and of the middle and the shortest axis",
          "p"};
}

Table displacement_table(const Displacements& found, const DisplacementGroup& group) {
  const Words words = words_of(found.dimension);
  Table table;
  table.name = "displacements_" + identifier(group.name);
  table.description = fmt::format(
      "Displacements and rotations of {} particles ({}) against the time difference: mean squares, "
      "also along and across the {} at the origin of time, mean fourth powers, non-Gaussian "
      "parameters {}; lengths in units where {} = 1 for the reference species, time in {}.",
      group.particles, group.name, words.axis, words.non_gaussian, words.unit_length,
      words.unit_time);
  table.columns = {time_column(found.lag), column("msd", "length^2", group.translation)};
  if (group.rotors > 0) {
    table.columns.push_back(column("msd_parallel", "length^2", group.parallel));
    table.columns.push_back(column("msd_perpendicular", "length^2", group.perpendicular));
  }
  table.columns.push_back(column("quartic", "length^4", group.quartic));
  table.columns.push_back(column("non_gaussian", "1", group.non_gaussian));
  if (!group.rotation.value.empty()) {
    table.columns.push_back(column("msr", "rad^2", group.rotation));
    table.columns.push_back(column("quartic_rotation", "rad^4", group.quartic_rotation));
    table.columns.push_back(column("non_gaussian_rotation", "1", group.non_gaussian_rotation));
  }
  table.columns.push_back({"origins", "1", numbers(found.origins)});
  return table;
}

Observable displacement_observable(int dimension) {
  const bool in_plane = dimension == 2;
  Chart rotation = mean_square("Mean squared rotation", in_plane ? "⟨Δθ(t)²⟩" : "⟨|Δφ(t)|²⟩",
                               {{"msr", in_plane ? "⟨Δθ²⟩" : "⟨|Δφ|²⟩"}});
  rotation.if_missing = "All particles are round: their rotation is not modelled.";
  Chart non_gaussian = against_time(
      motion, "Non-Gaussian parameter", "α₂(t)",
      {{"non_gaussian", "of displacements"}, {"non_gaussian_rotation", "of rotations"}});
  non_gaussian.levels = {0};
  return {.table = "displacements",
          .what =
              "Mean squared displacements, also along and across the axis of the particles, mean "
              "squared rotations, fourth powers and non-Gaussian parameters.",
          .columns = {time_difference_column(),
                      {"msd", "length^2", "⟨|Δr|²⟩", true},
                      {"msd_parallel", "length^2", "⟨(Δr·u(0))²⟩ of the rotors", true},
                      {"msd_perpendicular", "length^2", "⟨|Δr|² − (Δr·u(0))²⟩ of the rotors", true},
                      {"quartic", "length^4", "⟨|Δr|⁴⟩", true},
                      {"non_gaussian", "1", "d⟨|Δr|⁴⟩/((d + 2)⟨|Δr|²⟩²) − 1", true},
                      {"msr", "rad^2", "⟨|Δφ|²⟩ of the rotors, φ the angle or the rotation vector",
                       true},
                      {"quartic_rotation", "rad^4", "⟨|Δφ|⁴⟩", true},
                      {"non_gaussian_rotation", "1",
                       "n⟨|Δφ|⁴⟩/((n + 2)⟨|Δφ|²⟩²) − 1, n = 1 in the plane, 3 in space", true},
                      origins_column()},
          .needs = {.motion = true},
          .charts = {mean_square("Mean squared displacement", "⟨|Δr(t)|²⟩",
                                 {{"msd", "⟨|Δr|²⟩"},
                                  {"msd_parallel", "⟨Δr²⟩ along the axis"},
                                  {"msd_perpendicular", "⟨Δr²⟩ across the axis"}}),
                     std::move(rotation), std::move(non_gaussian)},
          .has_groups = true,
          .also = {"msd", "msr"}};
}

Table scattering_table(const Displacements& found, const DisplacementGroup& group) {
  Table table{
      "self_scattering_" + identifier(group.name),
      fmt::format("Self intermediate scattering functions F_s(q_k, t) of {} particles ({}), "
                  "averaged over the directions of q; q_k in table wave_numbers.",
                  group.particles, group.name),
      {time_column(found.lag)}};
  add_numbered(table, "fs_{}", group.self_scattering);
  return table;
}

Observable scattering_observable() {
  return {.table = "self_scattering",
          .what = "Self-intermediate scattering functions at the wave numbers.",
          .columns = {time_difference_column(),
                      {"fs_#", "1",
                       "⟨exp(iq·Δr)⟩ at the k-th of wave_numbers, over all directions of q", true}},
          .needs = {.motion = true},
          .charts = {at_wave_numbers(
              correlation("Self-intermediate scattering", "Fₛ(q, t)", {{"fs_#", "#"}}))},
          .has_groups = true,
          .also = {"fs"}};
}

Table orientation_table(const Displacements& found, const DisplacementGroup& group) {
  constexpr const char* of_axis[] = {"", "_middle", "_short"};
  const Words words = words_of(found.dimension);
  Table table{"orientation_" + identifier(group.name),
              fmt::format("Orientational correlations {} of {} particles that are not round ({}).",
                          words.orientation, group.rotors, group.name),
              {time_column(found.lag)}};
  const std::size_t orders = found.orders.size();
  for (std::size_t k = 0; k < group.orientation.size(); ++k)
    table.columns.push_back(column(fmt::format("{}_{:g}{}", words.orientation_column,
                                               found.orders[k % orders], of_axis[k / orders]),
                                   "1", group.orientation[k]));
  return table;
}

Observable rotation_observable(int dimension) {
  Observable observable{
      .table = "orientation",
      .what = "Orientational correlations L_n(t) = <cos n(angle(t) - angle(0))>.",
      .columns = {time_difference_column(), {"l_#", "1", "⟨cos nΔθ⟩", true}},
      .needs = {.motion = true, .rotors = true},
      .charts = {correlation("Orientational correlation", "Lₙ(t) = ⟨cos nΔθ⟩", {{"l_#", "L#"}})},
      .has_groups = true};
  if (dimension == 2) return observable;
  observable.what =
      "Orientational correlations <P_n(u(0).u(t))> of the axis of symmetry; of scalene bodies "
      "those of all three axes.";
  observable.columns = {
      time_difference_column(),
      {"p_#", "1", "⟨P_n(u(0)·u(t))⟩, u the axis of symmetry or the longest", true},
      {"p_#_*", "1", "the same of the middle and the short axis of scalene bodies", true}};
  Chart& chart = observable.charts.front();
  chart.symbol = "⟨Pₗ(u(0)·u(t))⟩";
  chart.curves = {
      {"p_#", "P#"}, {"p_#_middle", "P#, middle axis"}, {"p_#_short", "P#, shortest axis"}};
  return observable;
}

Table susceptibility_table(const Displacements& found) {
  return {
      "susceptibility",
      fmt::format("Share Q of all particles that are less than {:g} from where they were a time "
                  "before, and its four-point susceptibility chi_4 = N (<Q^2> - <Q>^2).",
                  found.overlap_distance),
      {time_column(found.lag), column("overlap", "1", found.overlap),
       column("chi_4", "1", found.susceptibility)}};
}

Observable susceptibility_observable() {
  return {
      .table = "susceptibility",
      .what =
          "Overlap Q(t), the share of particles that have hardly moved, and its four-point "
          "susceptibility.",
      .columns = {time_difference_column(),
                  {"overlap", "1", "Q, the share with |Δr| < analysis.overlap_distance", true},
                  {"chi_4", "1", "N(⟨Q²⟩ − ⟨Q⟩²)", true}},
      .needs = {.motion = true},
      .charts = {against_time(relaxation, "Four-point susceptibility", "χ₄(t)", {{"chi_4", "χ₄"}}),
                 against_time(relaxation, "Overlap", "⟨Q(t)⟩", {{"overlap", "⟨Q⟩"}}, decay)},
      .also = {"overlap", "chi_4"}};
}

Table cage_relative_table(const CageRelative& found, double overlap_distance) {
  Table table{
      "cage_relative",
      fmt::format(
          "Displacements of all particles relative to the mean of their neighbours (Voronoi "
          "cells at the origin of time), which long waves do not change: mean square, "
          "scattering functions F_s(q_k, t) with q_k in table wave_numbers, share that has "
          "moved by less than {:g} and its four-point susceptibility.",
          overlap_distance),
      {time_column(found.lag), column("msd", "length^2", found.square)}};
  add_numbered(table, "fs_{}", found.self_scattering);
  table.columns.push_back(column("overlap", "1", found.overlap));
  table.columns.push_back(column("chi_4", "1", found.susceptibility));
  table.columns.push_back({"origins", "1", numbers(found.origins)});
  return table;
}

Observable cage_relative_observable() {
  return {
      .table = "cage_relative",
      .what =
          "Mean squared displacement, scattering functions, overlap and four-point "
          "susceptibility of motion relative to the neighbours.",
      .columns = {time_difference_column(),
                  {"msd", "length^2", "⟨|δ|²⟩, δ = Δr less the mean of the Voronoi neighbours",
                   true},
                  {"fs_#", "1", "⟨exp(iq·δ)⟩", true},
                  {"overlap", "1", "Q, the share with |δ| < analysis.overlap_distance", true},
                  {"chi_4", "1", "N(⟨Q²⟩ − ⟨Q⟩²)", true},
                  origins_column()},
      .needs = {.motion = true},
      .charts = {mean_square("Mean squared displacement relative to the cage", "⟨|Δr(t)|²⟩",
                             {{"msd", "⟨|Δr − Δr of the neighbours|²⟩"}}),
                 at_wave_numbers(correlation("Self-intermediate scattering relative to the cage",
                                             "Fₛ(q, t)", {{"fs_#", "#"}}))}};
}

constexpr double rounding = 1e-9;  // relative, of time differences after several waiting times

/// Returns all time differences of all waiting times, in ascending order.
std::vector<double> times_of(const std::vector<AgedMotion>& ageing) {
  std::vector<double> times;
  for (const AgedMotion& aged : ageing)
    times.insert(times.end(), aged.motion.lag.begin(), aged.motion.lag.end());
  std::ranges::sort(times);
  const auto same = [](double one, double next) { return next - one <= rounding * next; };
  times.erase(std::unique(times.begin(), times.end(), same), times.end());
  return times;
}

/// Returns a column with the values at these times, NaN where there is none.
Column aged_column(const std::string& name, const char* unit, const std::vector<double>& times,
                   const std::vector<double>& known, const Correlation& correlation) {
  Column column{name, unit, std::vector<double>(times.size(), std::nan("")),
                std::vector<double>(times.size(), std::nan(""))};
  for (std::size_t k = 0; k < known.size(); ++k) {
    const auto place = std::ranges::lower_bound(times, known[k] * (1 - rounding)) - times.begin();
    column.value[static_cast<std::size_t>(place)] = correlation.value[k];
    column.error[static_cast<std::size_t>(place)] = correlation.error[k];
  }
  return column;
}

Table ageing_table(const std::vector<AgedMotion>& ageing) {
  const std::vector<double> times = times_of(ageing);
  Table table{"ageing",
              "Correlations of the frame at a waiting time with that at a time after it; the k-th "
              "waiting time is in table waiting_times. msd and msr: mean squared displacement and "
              "rotation, fs: F_s at the first of the wave numbers, l: L_2, in space <P_2>.",
              {time_column(times)}};
  for (std::size_t k = 0; k < ageing.size(); ++k) {
    const Displacements& found = ageing[k].motion;
    const DisplacementGroup& all = found.groups.front();
    const auto add = [&](const char* name, const char* unit, const Correlation& correlation) {
      if (!correlation.value.empty())
        table.columns.push_back(
            aged_column(fmt::format("{}_{}", name, k + 1), unit, times, found.lag, correlation));
    };
    add("msd", "length^2", all.translation);
    add("msr", "rad^2", all.rotation);
    add("fs", "1", all.self_scattering.front());
    if (all.rotors > 0) add("l", "1", all.orientation.front());
  }
  return table;
}

Observable ageing_observable(int dimension) {
  const bool in_plane = dimension == 2;
  return {
      .table = "ageing",
      .what = "Displacements, rotations and correlations after every waiting time.",
      .columns = {time_difference_column(),
                  {"msd_#", "length^2", "⟨|r(t_w + t) − r(t_w)|²⟩ after the k-th of waiting_times",
                   true},
                  {"msr_#", "rad^2", "the same of rotations", true},
                  {"fs_#", "1", "F_s at the first wave number", true},
                  {"l_#", "1", "L₂, in space ⟨P₂⟩", true}},
      .needs = {.motion = true, .waiting_times = true},
      .charts = {at_waiting_times(mean_square("Mean squared displacement after waiting",
                                              "⟨|r(t_w + t) − r(t_w)|²⟩", {{"msd_#", "#"}})),
                 at_waiting_times(mean_square("Mean squared rotation after waiting",
                                              in_plane ? "⟨Δθ²⟩" : "⟨|Δφ|²⟩", {{"msr_#", "#"}})),
                 at_waiting_times(correlation("Self-intermediate scattering after waiting",
                                              "Fₛ(q, t)", {{"fs_#", "#"}})),
                 at_waiting_times(correlation("Orientational correlation after waiting",
                                              in_plane ? "L₂(t) = ⟨cos 2Δθ⟩" : "⟨P₂(u(0)·u(t))⟩",
                                              {{"l_#", "#"}}))}};
}

Table waiting_time_table(const std::vector<AgedMotion>& ageing) {
  Table table{"waiting_times",
              "Waiting times t_w of the ageing, and the length over which orientations were "
              "correlated then: beyond it <cos 2(difference of two angles)> stays below 1/e.",
              {{"index", "1"}, {"waiting_time", "time"}, {"nematic_length", "length"}}};
  for (const AgedMotion& aged : ageing)
    add_row(table, {static_cast<double>(table.rows() + 1), aged.waiting_time, aged.nematic_length});
  if (std::isnan(ageing.front().nematic_length)) table.columns.pop_back();
  return table;
}

Observable waiting_time_observable(int dimension) {
  Observable observable{
      .table = "waiting_times",
      .what = "Waiting times of the ageing.",
      .columns = {{"index", "1", "k"},
                  {"waiting_time", "time", "t_w"},
                  {"nematic_length", "length", "beyond it ⟨cos 2(θ_i − θ_j)⟩ stays below 1/e"}},
      .needs = {.motion = true, .waiting_times = true}};
  if (dimension != 2) {
    observable.columns.pop_back();
    return observable;
  }
  observable.what = "Waiting times of the ageing, and the length of nematic domains at them.";
  observable.charts = {{.section = Chart::Section::course,
                        .heading = "Length of nematic domains",
                        .symbol = "ξ",
                        .curves = {{"nematic_length", "ξ", true}},
                        .scale = Chart::Scale::from_zero,
                        .x = "waiting_time",
                        .x_symbol = "t_w",
                        .is_x_logarithmic = true}};
  return observable;
}

Table wave_number_table(const RunDynamics& dynamics) {
  Table table{
      "wave_numbers",
      "Wave numbers q_k of the scattering functions; of the collective ones mean length and "
      "number of the wave vectors of the box.",
      {}};
  const std::vector<double>& wave_numbers = dynamics.displacements.wave_numbers;
  const CollectiveScattering& collective = dynamics.collective;
  table.columns = {index_column(wave_numbers.size()), {"q", "1/length", wave_numbers}};
  if (!collective.modes.empty())
    table.columns.insert(table.columns.end(),
                         {{"q_collective", "1/length", collective.wave_numbers},
                          {"modes", "1", numbers(collective.modes)}});
  return table;
}

Table collective_table(const CollectiveScattering& found) {
  Table table{"collective_scattering",
              "Collective intermediate scattering functions F(q_k, t) of all particles, not "
              "normalised: F(q, 0) = S(q); q_k in table wave_numbers, column q_collective.",
              {time_column(found.lag)}};
  add_numbered(table, "f_{}", found.scattering);
  return table;
}

Observable collective_observable() {
  return {.table = "collective_scattering",
          .what = "Collective intermediate scattering functions, F(q, 0) = S(q).",
          .columns = {time_difference_column(), {"f_#", "1", "⟨ρ(q, t) ρ(−q, 0)⟩/N", true}},
          .needs = {.motion = true},
          .charts = {at_wave_numbers(
              against_time(relaxation, "Collective scattering", "F(q, t)", {{"f_#", "#"}}),
              "q_collective")}};
}

}  // namespace

std::vector<Table> dynamics_tables(const RunDynamics& dynamics) {
  const Displacements& found = dynamics.displacements;
  std::vector<Table> tables;
  for (const DisplacementGroup& group : found.groups) {
    if (found.parts.displacement) tables.push_back(displacement_table(found, group));
    if (found.parts.scattering) tables.push_back(scattering_table(found, group));
    if (found.parts.orientation && group.rotors > 0)
      tables.push_back(orientation_table(found, group));
  }
  if (dynamics.cage_relative)
    tables.push_back(cage_relative_table(*dynamics.cage_relative, found.overlap_distance));
  tables.push_back(wave_number_table(dynamics));
  if (!dynamics.collective.lag.empty()) tables.push_back(collective_table(dynamics.collective));
  if (found.parts.overlap &&
      std::ranges::any_of(found.origins, [](std::size_t n) { return n > 1; }))
    tables.push_back(susceptibility_table(found));
  if (!dynamics.ageing.empty()) {
    tables.push_back(ageing_table(dynamics.ageing));
    tables.push_back(waiting_time_table(dynamics.ageing));
  }
  return tables;
}

std::vector<Observable> dynamics_observables(int dimension) {
  std::vector<Observable> observables = {displacement_observable(dimension),
                                         scattering_observable(), rotation_observable(dimension)};
  if (dimension == 2) observables.push_back(cage_relative_observable());
  observables.push_back(
      {.table = "wave_numbers",
       .what = "Wave numbers of the scattering functions.",
       .columns = {{"index", "1", "k"},
                   {"q", "1/length", "wave number of fs_k"},
                   {"q_collective", "1/length", "mean length of the wave vectors of f_k"},
                   {"modes", "1", "their number"}},
       .needs = {.motion = true}});
  observables.push_back(collective_observable());
  observables.push_back(susceptibility_observable());
  observables.push_back(ageing_observable(dimension));
  observables.push_back(waiting_time_observable(dimension));
  return observables;
}

std::string time_axis_text(std::span<const double> times, const Displacements& found) {
  const std::size_t most = *std::ranges::max_element(found.origins);
  if (!evenly_spaced(times))
    return fmt::format("unevenly sampled: {} lags with up to {} origins", found.lag.size(), most);
  if (found.origins.front() == times.size() - 1) return "linear, every frame an origin";
  return fmt::format("linear, up to {} origins, evenly thinned", most);
}

}  // namespace vitrel
