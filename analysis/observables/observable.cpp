#include "analysis/observables/observable.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "analysis/observables/dynamics_tables.h"
#include "analysis/observables/energy_tables.h"
#include "analysis/observables/frame_observable.h"
#include "analysis/observables/motion_tables.h"
#include "core/error.h"
#include "core/io/suggestion.h"

namespace vitrel {
namespace {

/// Returns a chart over the packing fraction, unless the sweep varies something else.
Chart of_study(const char* heading, const char* symbol, const char* column,
               Chart::Scale scale = Chart::Scale::linear) {
  return {.section = Chart::Section::study,
          .heading = heading,
          .symbol = symbol,
          .curves = {{column, symbol}},
          .scale = scale,
          .x = "packing_fraction",
          .x_symbol = "φ"};
}

Observable summary_observable() {
  return {
      .table = "summary",
      .what =
          "One row: packing fraction, and averages over the run, of the compressibility "
          "factor, energies, diffusion coefficients and the shear viscosity.",
      .columns = {
          {"particles", "1", "N"},
          {"rotors", "1", "R, particles that are not round"},
          {"rotations", "1", "rotational degrees of freedom"},
          {"frames", "1", "frames of the run"},
          {"duration", "time", "of the run"},
          {"collisions", "1", "of pairs"},
          {"packing_fraction", "1", "φ = Σ v_i/V"},
          {"box_*", "length", "sides of the box (in space)"},
          {"translational_energy", "kT", "⟨Σ m v²/2⟩/N", true},
          {"rotational_energy", "kT", "⟨Σ ω·I ω/2⟩/N", true},
          {"compressibility_factor", "1", "Z = PV/(N kT)", true},
          {"diffusion", "length^2/time", "D, the slope of ⟨|Δr|²⟩/(2d)", true},
          {"rotational_diffusion", "rad^2/time",
           "D_r, the slope of ⟨|Δφ|²⟩/(2n), n = 1 in the plane; in space 2, of scalene bodies 3",
           true},
          {"viscosity", "kT time/length^*", "η, the slope of the Helfand moment", true},
          {"*_from", "time", "shortest time difference of a fitted slope"},
          {"*_to", "time", "longest time difference of a fitted slope"},
          {"hexatic_order", "1", "mean over frames of |⟨ψ₆⟩| (in the plane)", true},
          {"orientation_ratio", "1",
           "largest over smallest eigenvalue of the orientation tensor (in space)"},
          {"isotropic_ratio", "1", "what as many random axes have (in space)"},
          {"isotropic_ratio_deviation", "1", "its standard deviation (in space)"}}};
}

}  // namespace

const Observable* find(const std::vector<Observable>& all, std::string_view table) {
  // The name of a group may be that of another table: orientation_distribution.
  for (const bool groups : {false, true})
    for (const Observable& observable : all)
      if (observable.has_groups == groups &&
          (groups ? table.starts_with(observable.table + "_") : table == observable.table))
        return &observable;
  return nullptr;
}

TableChoice::TableChoice(std::string_view names) {
  if (names.empty()) return;
  std::vector<std::string> known;
  std::map<std::string, std::string> table_of;
  for (const int dimension : {2, 3})
    for (const Observable& observable : observables(dimension)) {
      table_of[observable.table] = observable.table;
      for (const std::string& name : observable.also) table_of[name] = observable.table;
    }
  for (const auto& [name, table] : table_of) known.push_back(name);
  std::istringstream list{std::string(names)};
  for (std::string name; std::getline(list, name, ',');) {
    std::erase(name, ' ');
    if (!table_of.contains(name))
      throw UserError(
          fmt::format("names the table \"{}\", which `vitrel analyze --list` does not have{}", name,
                      suggestion(name, known)));
    tables_.push_back(table_of.at(name));
  }
}

bool TableChoice::has(std::initializer_list<std::string_view> tables) const {
  return tables_.empty() || std::ranges::any_of(tables, [&](std::string_view table) {
           return std::ranges::find(tables_, table) != tables_.end();
         });
}

Observable jobs_observable() {
  constexpr auto over_decades = Chart::Scale::logarithmic, from_zero = Chart::Scale::from_zero;
  return {.table = "runs",
          .what =
              "One row for every job of a sweep: its summary, relaxation times, what the "
              "preparation says of a state, and the cost.",
          .charts = {
              of_study("Relaxation of translation", "τα", "tau_translation", over_decades),
              of_study("Relaxation of rotation", "τ₂", "tau_rotation", over_decades),
              of_study("Diffusion", "D", "diffusion", over_decades),
              of_study("Rotational diffusion", "Dᵣ", "rotational_diffusion", over_decades),
              of_study("Shear viscosity", "η", "viscosity", over_decades),
              of_study("Compressibility factor", "Z = βP/ρ", "compressibility_factor"),
              of_study("Packing fraction", "φ", "packing_fraction"),
              of_study("Pressure of the prepared state", "βP/ρ", "reduced_pressure", over_decades),
              of_study("Nematic order", "S", "nematic_order", from_zero),
              of_study("Hexatic order", "ψ₆", "hexatic_order", from_zero),
              of_study("Orientation ratio", "ρ = λmax/λmin", "orientation_ratio"),
              of_study("Contacts", "contacts per particle", "contact_number"),
              of_study("Early releases", "share of collisions", "early_releases_per_collision",
                       over_decades),
              of_study("Blocked rotations", "share of collisions",
                       "blocked_rotations_per_collision", over_decades),
              of_study("Collisions", "collisions", "collisions", over_decades),
              of_study("Computing time", "computing time", "wall_seconds", over_decades),
              of_study("Speed of the simulation", "collisions per second",
                       "collisions_per_second_with_output")}};
}

std::vector<std::string> jobs_quantities() {
  std::vector<std::string> columns;
  for (const Chart& chart : jobs_observable().charts)
    columns.push_back(chart.curves.front().column);
  return columns;
}

std::vector<Observable> observables(int dimension) {
  const std::vector<Observable> parts[] = {
      {summary_observable()},
      dynamics_observables(dimension),
      motion_observables(),
      energy_observables(),
      frame_observables(dimension),
      {{.table = "on_the_fly",
        .what = "The same correlations, measured while the run went on (output.correlations).",
        .columns = {time_difference_column(),
                    {"msd", "length^2", "⟨|Δr|²⟩", true},
                    {"msr", "rad^2", "⟨|Δφ|²⟩", true},
                    {"fs_#", "1", "F_s at the k-th of on_the_fly_wave_numbers", true},
                    {"index", "1", "k (in on_the_fly_wave_numbers)"},
                    {"q", "1/length", "q_k (there)"},
                    {"l_#", "1", "⟨cos nΔθ⟩ (in the plane)", true},
                    {"p_#", "1", "⟨P_n(u(0)·u(t))⟩ (in space)", true},
                    origins_column()},
        .has_groups = true},
       {.table = "relaxation_times",
        .what = "When correlations have fallen to 1/e, or bounds of that time.",
        .columns = {{"group", "1", "species, or all"},
                    {"kind", "1", "which correlation"},
                    {"parameter", "1/length or 1", "its q or n"},
                    {"tau", "time", "τ, when it has fallen to 1/e", true},
                    {"least", "time", "a lower bound of τ"},
                    {"most", "time", "an upper bound of τ"}},
        .needs = {.motion = true}},
       {.table = "relaxation",
        .what = "One row: relaxation times, nematic order, and whether the run was long enough.",
        .columns = {{"run", "1", "file"},
                    {"seed", "1", "of the run"},
                    {"packing_fraction", "1", "φ"},
                    {"duration", "time", "of the run"},
                    {"wave_number", "1/length", "q of τ_α"},
                    {"tau_translation", "time",
                     "τ_α: F_s(q, τ) = 1/e, in the plane relative to the cage", true},
                    {"tau_rotation", "time",
                     "τ₂: L₂ = 1/e, in space ⟨P₂⟩, in a nematic its connected part", true},
                    {"verdict", "1", "whether the run was equilibrated"},
                    {"tests", "1", "how many tests say so"},
                    {"verdict_translation", "1", "the same of translation alone"},
                    {"tests_translation", "1", "how many tests say so"},
                    {"nematic_order", "1", "S", true},
                    {"nematic_by_chance", "1", "S of as many random axes"},
                    {"plateau", "1", "of L₂ in a nematic"},
                    {"orientation", "1", "whether orientations relax, are kept by order, or last"}},
        .needs = {.motion = true}}}};
  std::vector<Observable> all;
  for (const std::vector<Observable>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace vitrel
