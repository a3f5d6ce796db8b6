#include "workflow/analyze/dynamics_tables.h"

#include <fmt/format.h>

#include <algorithm>

namespace vitrel {
namespace {

Column time_column(const std::vector<double>& lag) {
  return {"time", "time", lag, {}};
}

Column column(const std::string& name, const char* unit, const Correlation& correlation) {
  return {name, unit, correlation.value, correlation.error};
}

std::vector<double> numbers(const std::vector<std::size_t>& counts) {
  return {counts.begin(), counts.end()};
}

/// What differs between the plane and space.
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
  table.columns.push_back({"origins", "1", numbers(found.origins), {}});
  return table;
}

Table scattering_table(const Displacements& found, const DisplacementGroup& group) {
  Table table{
      "self_scattering_" + identifier(group.name),
      fmt::format("Self intermediate scattering functions F_s(q_k, t) of {} particles ({}), "
                  "averaged over the directions of q; q_k in table wave_numbers.",
                  group.particles, group.name),
      {time_column(found.lag)}};
  for (std::size_t k = 0; k < group.self_scattering.size(); ++k)
    table.columns.push_back(column(fmt::format("fs_{}", k + 1), "1", group.self_scattering[k]));
  return table;
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

Table susceptibility_table(const Displacements& found) {
  return {
      "susceptibility",
      fmt::format("Share Q of all particles that are less than {:g} from where they were a time "
                  "before, and its four-point susceptibility chi_4 = N (<Q^2> - <Q>^2).",
                  found.overlap_distance),
      {time_column(found.lag), column("overlap", "1", found.overlap),
       column("chi_4", "1", found.susceptibility)}};
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
  for (std::size_t k = 0; k < found.self_scattering.size(); ++k)
    table.columns.push_back(column(fmt::format("fs_{}", k + 1), "1", found.self_scattering[k]));
  table.columns.push_back(column("overlap", "1", found.overlap));
  table.columns.push_back(column("chi_4", "1", found.susceptibility));
  table.columns.push_back({"origins", "1", numbers(found.origins), {}});
  return table;
}

Table wave_number_table(const RunDynamics& dynamics) {
  Table table{
      "wave_numbers",
      "Wave numbers q_k of the scattering functions; of the collective ones mean length and "
      "number of the wave vectors of the box.",
      {}};
  Column index{"index", "1", {}, {}}, shell{"q_collective", "1/length", {}, {}},
      modes{"modes", "1", {}, {}};
  for (std::size_t k = 0; k < dynamics.collective.modes.size(); ++k) {
    index.value.push_back(static_cast<double>(k + 1));
    shell.value.push_back(dynamics.collective.wave_numbers[k]);
    modes.value.push_back(static_cast<double>(dynamics.collective.modes[k]));
  }
  table.columns = {index, {"q", "1/length", dynamics.displacements.wave_numbers, {}}, shell, modes};
  return table;
}

Table collective_table(const CollectiveScattering& found) {
  Table table{"collective_scattering",
              "Collective intermediate scattering functions F(q_k, t) of all particles, not "
              "normalised: F(q, 0) = S(q); q_k in table wave_numbers, column q_collective.",
              {time_column(found.lag)}};
  for (std::size_t k = 0; k < found.scattering.size(); ++k)
    table.columns.push_back(column(fmt::format("f_{}", k + 1), "1", found.scattering[k]));
  return table;
}

}  // namespace

std::vector<Table> dynamics_tables(const RunDynamics& dynamics) {
  const Displacements& found = dynamics.displacements;
  std::vector<Table> tables;
  for (const DisplacementGroup& group : found.groups) {
    tables.push_back(displacement_table(found, group));
    tables.push_back(scattering_table(found, group));
    if (group.rotors > 0) tables.push_back(orientation_table(found, group));
  }
  if (dynamics.cage_relative)
    tables.push_back(cage_relative_table(*dynamics.cage_relative, found.overlap_distance));
  tables.push_back(wave_number_table(dynamics));
  tables.push_back(collective_table(dynamics.collective));
  if (std::ranges::any_of(found.origins, [](std::size_t n) { return n > 1; }))
    tables.push_back(susceptibility_table(found));
  return tables;
}

std::string time_axis_text(std::span<const double> times, const Displacements& found) {
  const std::size_t most = *std::ranges::max_element(found.origins);
  if (!evenly_spaced(times))
    return fmt::format("unevenly sampled: {} lags with up to {} origins", found.lag.size(), most);
  if (found.origins.front() == times.size() - 1) return "linear, every frame an origin";
  return fmt::format("linear, up to {} origins, evenly thinned", most);
}

}  // namespace vitrel
