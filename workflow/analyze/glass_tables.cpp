#include "workflow/analyze/glass_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "analysis/glass/glass_names.h"
#include "core/error.h"
#include "core/special_values.h"
#include "core/whole_number.h"

namespace vitrel {
namespace {

constexpr const char* reason_key = "verdict_reason";
constexpr const char* translation_reason_key = "verdict_translation_reason";

double number(auto code) {
  return static_cast<double>(static_cast<int>(code));
}

constexpr const char* kinds_text =
    "kind: of tau_alpha (translation) or tau_2 (rotation; in the nematic of its connected part)";

/// A column whose values are codes with these labels.
template <std::size_t Count>
Column codes(const char* name, const std::array<std::string_view, Count>& labels) {
  return {name, "1", {}, {}, {labels.begin(), labels.end()}};
}

Table relaxation_table(const GlassStudy& study) {
  Table table{
      "relaxation",
      "Relaxation times, one row per run. tau_translation: F_s = 1/e at wave_number, in the plane "
      "relative to the cage; tau_rotation: L_2 = 1/e (P_2 in three dimensions), in a nematic its "
      "connected part, seen from the director. verdict: from so many tests; verdict_translation: "
      "whatever rotation does; only equilibrated runs enter the fits, of translation by the "
      "latter. nematic_order: S, beside that of as many rotors without order; plateau: of L_2 by "
      "order, 0 if not nematic; orientation: what becomes of it.",
      {{"run", "1"},
       {"packing_fraction", "1"},
       {"seed", "1"},
       {"duration", "time"},
       codes("verdict", verdict_names),
       {"tests", "1"},
       codes("verdict_translation", verdict_names),
       {"tests_translation", "1"},
       {"wave_number", "1/length"},
       {"tau_translation", "time"},
       {"tau_rotation", "time"},
       {"nematic_order", "1"},
       {"nematic_by_chance", "1"},
       {"plateau", "1"},
       codes("orientation", orientation_names)}};
  for (const GlassRun& run : study.runs) {
    const auto place = static_cast<double>(table.rows());
    add_row(table, {place, run.packing_fraction, static_cast<double>(run.seed), run.duration,
                    number(run.equilibration.verdict), static_cast<double>(run.equilibration.tests),
                    number(run.translation_equilibration.verdict),
                    static_cast<double>(run.translation_equilibration.tests), run.wave_number,
                    Entry(run.translation.value, run.translation.error),
                    Entry(run.rotation.value, run.rotation.error),
                    Entry(run.nematic_order.mean, run.nematic_order.error), run.nematic_by_chance,
                    run.plateau, number(run.orientation)});
    table.columns.front().labels.push_back(run.name);
  }
  return table;
}

Table fit_table(const GlassStudy& study) {
  Table table{
      "glass_fit",
      fmt::format(
          "Laws of the glass transition. {}. law: power law tau = A (phi_c - phi)^-s, "
          "Vogel-Fulcher tau = A exp(s phi/(phi_c - phi)). phi_c is above phi_c_least, and s below "
          "exponent_most, with a probability of 95 %; window: the largest in which the law fits, "
          "and its fit.",
          kinds_text),
      {codes("kind", kind_names),
       codes("law", law_names),
       codes("verdict", fit_verdict_names),
       {"phi_c", "1"},
       {"phi_c_least", "1"},
       {"exponent", "1"},
       {"exponent_most", "1"},
       {"window_low", "1"},
       {"window_high", "1"},
       {"densities", "1"},
       {"window_phi_c", "1"},
       {"window_exponent", "1"},
       {"window_log_prefactor", "ln(time)"},
       {"chi2", "1"},
       {"dof", "1"},
       {"scatter", "1"}}};
  for (const StudiedLaw& studied : study.laws) {
    const GlassFit& fit = studied.fit;
    const GlassWindow& w = fit.window;
    const bool found = fit.verdict == GlassVerdict::found;
    const bool any = !fit.windows.empty();
    const auto if_any = [&](double value) { return any ? value : unknown; };
    add_row(table, {number(studied.kind), number(studied.law), number(fit.verdict),
                    found ? Entry(w.density, w.error()) : Entry(unknown, unknown),
                    fit.verdict == GlassVerdict::refused ? unknown : w.least,
                    found ? Entry(w.strength, w.strength_error()) : Entry(unknown, unknown),
                    if_any(w.strength_most), if_any(w.lowest), if_any(w.highest),
                    if_any(static_cast<double>(w.densities)), if_any(w.density), if_any(w.strength),
                    if_any(w.log_prefactor), if_any(w.chi_square),
                    if_any(static_cast<double>(w.degrees)), fit.scatter});
  }
  return table;
}

Table window_table(const GlassStudy& study) {
  Table table{"glass_fit_windows",
              fmt::format("The laws fitted to every window of densities. {}. law as in glass_fit; "
                          "phi_c_low and phi_c_high: where chi^2 is 1 above its minimum.",
                          kinds_text),
              {codes("kind", kind_names),
               codes("law", law_names),
               {"window_low", "1"},
               {"window_high", "1"},
               {"phi_c", "1"},
               {"phi_c_low", "1"},
               {"phi_c_high", "1"},
               {"exponent", "1"},
               {"chi2", "1"},
               {"dof", "1"},
               {"goodness", "1"}}};
  for (const StudiedLaw& studied : study.laws)
    for (const GlassWindow& w : studied.fit.windows)
      add_row(table,
              {number(studied.kind), number(studied.law), w.lowest, w.highest, w.density, w.low,
               w.high, w.strength, w.chi_square, static_cast<double>(w.degrees), w.goodness});
  return table;
}

}  // namespace

void store_glass_run(const GlassRun& run, Results& results) {
  results.tables.push_back(relaxation_table({{run}, {}}));
  results.provenance.emplace_back(reason_key, run.equilibration.reason);
  results.provenance.emplace_back(translation_reason_key, run.translation_equilibration.reason);
}

std::optional<GlassRun> stored_glass_run(const std::string& name, const Results& results) {
  const Table* relaxation = results.find("relaxation");
  const Table* summary = results.find("summary");
  if (!relaxation || !summary || relaxation->rows() != 1) return std::nullopt;
  const auto column = [&](const Table& table, const char* name_of_column) -> const Column& {
    const Column* found = table.find(name_of_column);
    if (!found)
      throw FileError(
          fmt::format("{}: the results have no column '{}' in the table '{}': they are of "
                      "another version; analyse the run again",
                      name, name_of_column, table.name));
    return *found;
  };
  const auto value = [&](const Table& table, const char* name_of_column) {
    return column(table, name_of_column).value.front();
  };
  const auto count = [&](const Table& table, const char* name_of_column) {
    const double stored = value(table, name_of_column);
    const auto whole = whole_number<std::uint64_t>(stored);
    if (!whole)
      throw FileError(
          fmt::format("{}: the column '{}' of the table '{}' has {}, but should have a "
                      "whole number",
                      name, name_of_column, table.name, stored));
    return *whole;
  };
  const auto error = [&](const Table& table, const char* name_of_column) {
    const Column& found = column(table, name_of_column);
    return found.error.empty() ? unknown : found.error.front();
  };
  // Every version stores τ_α relative to the cage in this table; older versions store it nowhere else.
  const auto cage_time = [&]() -> std::optional<RelaxationTime> {
    constexpr double relative_to_cage = 4;  // this kind in relaxation_tables.h
    const Table* times = results.find("relaxation_times");
    if (!times) return std::nullopt;
    const std::vector<double>& kinds = column(*times, "kind").value;
    const auto found = std::ranges::find(kinds, relative_to_cage);
    if (found == kinds.end()) return std::nullopt;
    const auto row = static_cast<std::size_t>(found - kinds.begin());
    const Column& tau = column(*times, "tau");
    return RelaxationTime{tau.value[row], tau.error[row], unknown,
                          column(*times, "most").value[row], ""};
  };
  const auto verdict = [&](const char* code, const char* tests, const char* reason) {
    return Equilibration{static_cast<EquilibrationVerdict>(count(*relaxation, code)),
                         results.text(reason), count(*relaxation, tests)};
  };
  const auto time = [&](const char* of) {
    return RelaxationTime{value(*relaxation, of), error(*relaxation, of), unknown, unknown, ""};
  };
  const auto diffusion = [&](const std::string& of) {
    return DiffusionCoefficient{value(*summary, of.c_str()), error(*summary, of.c_str()),
                                value(*summary, (of + "_from").c_str()),
                                value(*summary, (of + "_to").c_str()), ""};
  };
  GlassRun run{};
  run.name = name;
  run.packing_fraction = value(*relaxation, "packing_fraction");
  run.seed = count(*relaxation, "seed");
  run.rotors = count(*summary, "rotors");
  run.duration = value(*relaxation, "duration");
  run.wave_number = value(*relaxation, "wave_number");
  run.nematic_order = {value(*relaxation, "nematic_order"), error(*relaxation, "nematic_order"), 0};
  run.nematic_by_chance = value(*relaxation, "nematic_by_chance");
  run.plateau = value(*relaxation, "plateau");
  run.orientation = static_cast<OrientationKind>(count(*relaxation, "orientation"));
  run.translation = time("tau_translation");
  run.rotation = time("tau_rotation");
  run.diffusion = diffusion("diffusion");
  run.rotational_diffusion = diffusion("rotational_diffusion");
  run.equilibration = verdict("verdict", "tests", reason_key);
  run.translation_equilibration =
      verdict("verdict_translation", "tests_translation", translation_reason_key);
  if (const auto relative = cage_time()) {
    run.relative_to_cage = true;
    run.translation = *relative;
    reconcile_verdicts(run);
  }
  return run;
}

std::vector<Table> glass_tables(const GlassStudy& study) {
  return {relaxation_table(study), fit_table(study), window_table(study)};
}

}  // namespace vitrel
