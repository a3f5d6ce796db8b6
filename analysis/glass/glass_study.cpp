#include "analysis/glass/glass_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "analysis/glass/glass_words.h"
#include "analysis/structure/order.h"
#include "core/error.h"
#include "workflow/report/page_parts.h"

namespace vitrel {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double negligible = 0.05;  // rest of a correlation that has decayed

constexpr const char* reason_key = "verdict_reason";
constexpr const char* translation_reason_key = "verdict_translation_reason";

/// Whether nothing is left of a correlation at the longest time, but for what its error explains.
bool vanishes(const Decay& correlation) {
  const double error = std::isnan(correlation.error.back()) ? 0 : correlation.error.back();
  return correlation.value.back() <= std::max(negligible, 3 * error);
}

void judge_orientation(GlassRun& run, const GlassRunData& data) {
  run.nematic_order = {unknown, unknown, 0};
  run.plateau = 0;
  run.orientation = OrientationKind::round;
  run.rotation = {unknown, unknown, unknown, unknown, "no particle can turn"};
  if (data.rotors == 0) return;
  run.nematic_order = slow_average(data.nematic_order);
  const auto& [order, error, blocks] = run.nematic_order;
  if (!is_nematic(data)) {
    run.rotation = relaxation_time(data.orientation);
    const bool decays = !std::isnan(run.rotation.value) || !std::isnan(run.rotation.most);
    run.orientation = decays ? OrientationKind::relaxes : OrientationKind::lasting;
    return;
  }
  run.plateau = order * order;
  const Decay connected =
      connected_part(data.orientation, {run.plateau, 2 * order * error, blocks});
  run.rotation = relaxation_time(connected);
  const bool decays = !std::isnan(run.rotation.value) && vanishes(connected);
  run.orientation = decays ? OrientationKind::ordered : OrientationKind::lasting;
}

void judge(GlassRun& run, const GlassRunData& data) {
  RunEvidence evidence{data.duration, data.series, data.halves, {{"tau_alpha", run.translation}}};
  run.translation_equilibration = judge_equilibration(evidence);
  if (data.rotors > 0) {
    evidence.series.push_back({"the nematic order", data.nematic_order});
    evidence.curves.insert(evidence.curves.end(), data.rotation_halves.begin(),
                           data.rotation_halves.end());
    evidence.times.push_back({"tau_2", run.rotation});
  }
  run.equilibration = judge_equilibration(evidence);
}

/// A time of one kind and its error; NaN if the run has none.
struct Time {
  double value, error;
};

Time inverse(const DiffusionCoefficient& d) {
  return {1 / d.value, d.error / (d.value * d.value)};
}

bool nematic(const GlassRun& run) {
  return run.plateau > 0;
}

/// Whether a run can have a time of this kind at all.
bool applies(GlassKind kind, const GlassRun& run) {
  switch (kind) {
    case GlassKind::translation:
    case GlassKind::diffusion:
      return true;
    case GlassKind::nematic_rotation:
      return nematic(run);
    case GlassKind::rotation:
    case GlassKind::rotational_diffusion:
      return run.rotors > 0 && !nematic(run);
  }
  return false;
}

Time time_of(GlassKind kind, const GlassRun& run) {
  switch (kind) {
    case GlassKind::translation:
      return {run.translation.value, run.translation.error};
    case GlassKind::rotation:
    case GlassKind::nematic_rotation:
      return {run.rotation.value, run.rotation.error};
    case GlassKind::diffusion:
      return inverse(run.diffusion);
    case GlassKind::rotational_diffusion:
      return inverse(run.rotational_diffusion);
  }
  return {unknown, unknown};
}

bool equilibrated(const Equilibration& equilibration) {
  return equilibration.verdict == EquilibrationVerdict::equilibrated;
}

/// Whether a run was in equilibrium as far as this kind of time needs it.
bool equilibrated(GlassKind kind, const GlassRun& run) {
  const bool places_suffice = kind == GlassKind::translation || kind == GlassKind::diffusion;
  return equilibrated(places_suffice ? run.translation_equilibration : run.equilibration);
}

bool enters_fit(GlassKind kind, const GlassRun& run) {
  const Time time = time_of(kind, run);
  return applies(kind, run) && equilibrated(kind, run) && time.value > 0 && time.error > 0;
}

const char* name_of(GlassKind kind) {
  switch (kind) {
    case GlassKind::translation:
      return "translation, tau_alpha";
    case GlassKind::rotation:
      return "rotation, tau_2";
    case GlassKind::nematic_rotation:
      return "rotation in the nematic, tau_2";
    case GlassKind::diffusion:
      return "diffusion, 1/D";
    case GlassKind::rotational_diffusion:
      return "rotational diffusion, 1/D_r";
  }
  return "";
}

std::string_view name_of(GlassLaw law) {
  return law_words[static_cast<std::size_t>(law)];
}

std::string_view name_of(EquilibrationVerdict verdict) {
  return verdict_words[static_cast<std::size_t>(verdict)];
}

std::string_view name_of(OrientationKind orientation) {
  return orientation_words[static_cast<std::size_t>(orientation)];
}

template <class Code>
double number(Code code) {
  return static_cast<double>(static_cast<int>(code));
}

/// A table that grows by rows.
class Rows {
 public:
  Rows(const char* name, std::string description, std::vector<Column> columns)
      : table_{name, std::move(description), std::move(columns)} {}

  /// A pair (value, error) for every column; errors of columns that have none are not looked at.
  void add(const std::vector<Time>& row, const std::vector<bool>& has_error) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      table_.columns[k].value.push_back(row[k].value);
      if (has_error[k]) table_.columns[k].error.push_back(row[k].error);
    }
  }
  Table table() && { return std::move(table_); }

 private:
  Table table_;
};

Time plain(double value) {
  return {value, unknown};
}

constexpr const char* kinds_text =
    "kind: 0 translation (tau_alpha), 1 rotation (tau_2), 2 rotation in the nematic (tau_2 of the "
    "connected part), 3 diffusion (1/D), 4 rotational diffusion (1/D_r)";

Table relaxation_table(const GlassStudy& study) {
  Rows rows(
      "relaxation",
      "Relaxation times, one row per run. tau_translation: F_s = 1/e at wave_number; tau_rotation: "
      "L_2 = 1/e, in a nematic its connected part, seen from the director. verdict: 0 "
      "equilibrated, "
      "1 ageing, 2 not enough time, from so many tests; verdict_translation, whatever rotation "
      "does; "
      "only equilibrated runs enter the fits, of translation by the latter. nematic_order: S, "
      "beside that of as many "
      "rotors without order; plateau: of L_2 by order, 0 if not nematic. orientation: 0 round, "
      "1 relaxes, 2 nematic order, 3 does not relax.",
      {{"packing_fraction", "1", {}, {}},
       {"seed", "1", {}, {}},
       {"duration", "time", {}, {}},
       {"verdict", "1", {}, {}},
       {"tests", "1", {}, {}},
       {"verdict_translation", "1", {}, {}},
       {"tests_translation", "1", {}, {}},
       {"wave_number", "1/length", {}, {}},
       {"tau_translation", "time", {}, {}},
       {"tau_rotation", "time", {}, {}},
       {"nematic_order", "1", {}, {}},
       {"nematic_by_chance", "1", {}, {}},
       {"plateau", "1", {}, {}},
       {"orientation", "1", {}, {}}});
  std::vector<bool> has_error(14, false);
  has_error[8] = has_error[9] = has_error[10] = true;
  for (const GlassRun& run : study.runs)
    rows.add({plain(run.packing_fraction), plain(static_cast<double>(run.seed)),
              plain(run.duration), plain(number(run.equilibration.verdict)),
              plain(static_cast<double>(run.equilibration.tests)),
              plain(number(run.translation_equilibration.verdict)),
              plain(static_cast<double>(run.translation_equilibration.tests)),
              plain(run.wave_number), Time{run.translation.value, run.translation.error},
              Time{run.rotation.value, run.rotation.error},
              Time{run.nematic_order.mean, run.nematic_order.error},
              plain(run.rotors > 0 ? nematic_order_by_chance(run.rotors) : unknown),
              plain(run.plateau), plain(number(run.orientation))},
             has_error);
  return std::move(rows).table();
}

Table fit_table(const GlassStudy& study) {
  Rows rows(
      "glass_fit",
      fmt::format("Laws of the glass transition. {}. law: 0 tau = A (phi_c - phi)^-s, 1 tau = "
                  "A exp(s phi/(phi_c - phi)). verdict: 0 found, 1 lower bound only, 2 "
                  "refused. phi_c is above phi_c_least with a probability of 95 %; window: "
                  "that of the greatest weight, and its fit.",
                  kinds_text),
      {{"kind", "1", {}, {}},
       {"law", "1", {}, {}},
       {"verdict", "1", {}, {}},
       {"phi_c", "1", {}, {}},
       {"phi_c_statistical", "1", {}, {}},
       {"phi_c_spread", "1", {}, {}},
       {"phi_c_least", "1", {}, {}},
       {"exponent", "1", {}, {}},
       {"window_low", "1", {}, {}},
       {"window_high", "1", {}, {}},
       {"densities", "1", {}, {}},
       {"window_phi_c", "1", {}, {}},
       {"window_exponent", "1", {}, {}},
       {"window_log_prefactor", "ln(time)", {}, {}},
       {"chi2", "1", {}, {}},
       {"dof", "1", {}, {}},
       {"scatter", "1", {}, {}}});
  std::vector<bool> has_error(17, false);
  has_error[3] = has_error[7] = true;
  for (const StudiedLaw& studied : study.laws) {
    const GlassFit& fit = studied.fit;
    const GlassWindow& w = fit.window;
    const bool found = fit.verdict == GlassVerdict::found;
    const bool any = !fit.windows.empty();
    const auto if_any = [&](double value) { return plain(any ? value : unknown); };
    rows.add({plain(number(studied.kind)), plain(number(studied.law)), plain(number(fit.verdict)),
              found ? Time{fit.density, fit.error} : plain(unknown),
              plain(found ? fit.statistical : unknown), plain(found ? fit.spread : unknown),
              plain(fit.verdict == GlassVerdict::refused ? unknown : fit.least),
              found ? Time{fit.strength, fit.strength_error} : plain(unknown), if_any(w.lowest),
              if_any(w.highest), if_any(static_cast<double>(w.densities)), if_any(w.density),
              if_any(w.strength), if_any(w.log_prefactor), if_any(w.chi_square),
              if_any(static_cast<double>(w.degrees)), plain(fit.scatter)},
             has_error);
  }
  return std::move(rows).table();
}

Table window_table(const GlassStudy& study) {
  Rows rows("glass_fit_windows",
            fmt::format("The laws fitted to every window of densities. {}. law as in glass_fit; "
                        "phi_c_low and phi_c_high: where chi^2 is 1 above its minimum.",
                        kinds_text),
            {{"kind", "1", {}, {}},
             {"law", "1", {}, {}},
             {"window_low", "1", {}, {}},
             {"window_high", "1", {}, {}},
             {"phi_c", "1", {}, {}},
             {"phi_c_low", "1", {}, {}},
             {"phi_c_high", "1", {}, {}},
             {"exponent", "1", {}, {}},
             {"chi2", "1", {}, {}},
             {"dof", "1", {}, {}},
             {"goodness", "1", {}, {}},
             {"weight", "1", {}, {}}});
  const std::vector<bool> has_error(12, false);
  for (const StudiedLaw& studied : study.laws)
    for (const GlassWindow& w : studied.fit.windows)
      rows.add({plain(number(studied.kind)), plain(number(studied.law)), plain(w.lowest),
                plain(w.highest), plain(w.density), plain(w.low), plain(w.high), plain(w.strength),
                plain(w.chi_square), plain(static_cast<double>(w.degrees)), plain(w.goodness),
                plain(w.weight)},
               has_error);
  return std::move(rows).table();
}

std::string run_line(const GlassRun& run) {
  return fmt::format("{:8.4g} {:5} {:>7} {:>18} {:>18}  {:<14}  {:<15}  {}\n", run.packing_fraction,
                     run.seed, run.rotors > 0 ? fmt::format("{:.3f}", run.nematic_order.mean) : "-",
                     with_error(run.translation.value, run.translation.error),
                     with_error(run.rotation.value, run.rotation.error), name_of(run.orientation),
                     name_of(run.translation_equilibration.verdict),
                     name_of(run.equilibration.verdict));
}

std::string law_text(const GlassFit& fit) {
  if (fit.verdict != GlassVerdict::found) return "no phi_c: " + fit.reason;
  return fmt::format(
      "phi_c = {} (statistical {:.2g}, window {:.2g}), s = {}; best window {:.4g} ... {:.4g}, "
      "chi^2/dof {:.2f}",
      with_error(fit.density, fit.error), fit.statistical, fit.spread,
      with_error(fit.strength, fit.strength_error), fit.window.lowest, fit.window.highest,
      fit.window.chi_square / static_cast<double>(fit.window.degrees));
}

/// Kinds with what each law says of them; one line where both say the same.
std::vector<std::string> law_lines(const GlassStudy& study) {
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < study.laws.size(); ++k) {
    const auto& [kind, law, fit] = study.laws[k];
    const bool has_next = k + 1 < study.laws.size() && study.laws[k + 1].kind == kind;
    const bool same = has_next && law_text(fit) == law_text(study.laws[k + 1].fit);
    lines.push_back(same ? fmt::format("{}: {}", name_of(kind), law_text(fit))
                         : fmt::format("{}, {}: {}", name_of(kind), name_of(law), law_text(fit)));
    k += same;
  }
  return lines;
}

/// The densities of the runs of which something is true, each once.
template <class Predicate>
std::string densities_where(const GlassStudy& study, Predicate&& predicate) {
  std::string text;
  std::string last;
  for (const GlassRun& run : study.runs) {
    const std::string density = fmt::format("{:.4g}", run.packing_fraction);
    if (!predicate(run) || density == last) continue;
    text += (text.empty() ? "" : ", ") + density;
    last = density;
  }
  return text;
}

/// What keeps orientations, a sentence each.
std::vector<std::string> order_or_glass(const GlassStudy& study) {
  std::vector<std::string> sentences;
  const auto say = [&](const char* sentence, const std::string& densities) {
    if (!densities.empty()) sentences.push_back(fmt::format(fmt::runtime(sentence), densities));
  };
  const auto ordered = [&](bool surely) {
    return densities_where(study, [surely](const GlassRun& run) {
      return run.orientation == OrientationKind::ordered &&
             equilibrated(run.equilibration) == surely;
    });
  };
  say("Nematic order, not glass, keeps orientations at {}: seen from the director, L_2 decays to "
      "the "
      "plateau that order gives it.",
      ordered(true));
  say("So it seems at {}, where a run was not in equilibrium or too short to tell.",
      ordered(false));
  say("Orientations do not relax within the times measured (beyond what order explains) at {}.",
      densities_where(
          study, [](const GlassRun& run) { return run.orientation == OrientationKind::lasting; }));
  return sentences;
}

/// The power law is an extrapolation that real systems cross: what still relaxes beyond.
std::string crossed(const StudiedLaw& studied, const std::vector<GlassPoint>& points) {
  double highest = 0;
  for (const GlassPoint& point : points) highest = std::max(highest, point.packing_fraction);
  if (studied.fit.verdict != GlassVerdict::found || studied.fit.density > highest) return "";
  return fmt::format(
      "{}, {}: phi_c = {:.4f} lies below {:.4g}, where the system is still in "
      "equilibrium: it marks a crossover",
      name_of(studied.kind), name_of(studied.law), studied.fit.density, highest);
}

}  // namespace

bool is_nematic(const GlassRunData& data) {
  return data.rotors > 0 && is_nematic(mean_of(data.nematic_order), data.rotors);
}

GlassRun judge_glass_run(const GlassRunData& data) {
  GlassRun run{};
  run.name = data.name;
  run.packing_fraction = data.packing_fraction;
  run.seed = data.seed;
  run.rotors = data.rotors;
  run.duration = data.duration;
  run.wave_number = data.wave_number;
  run.diffusion = data.diffusion;
  run.rotational_diffusion = data.rotational_diffusion;
  run.translation = relaxation_time(data.scattering);
  judge_orientation(run, data);
  judge(run, data);
  return run;
}

void store_glass_run(const GlassRun& run, Results& results) {
  results.tables.push_back(relaxation_table({{run}, {}}));
  results.provenance.emplace_back(reason_key, run.equilibration.reason);
  results.provenance.emplace_back(translation_reason_key, run.translation_equilibration.reason);
}

std::optional<GlassRun> stored_glass_run(const std::string& name, const Results& results) {
  const Table* relaxation = results.find("relaxation");
  const Table* summary = results.find("summary");
  if (!relaxation || !summary || relaxation->rows() != 1) return std::nullopt;
  const auto column = [&](const Table& table, const char* wanted) -> const Column& {
    const Column* found = table.find(wanted);
    if (!found)
      throw FileError(
          fmt::format("{}: the results have no column '{}' in the table '{}': they are of "
                      "another version; analyse the run again",
                      name, wanted, table.name));
    return *found;
  };
  const auto value = [&](const Table& table, const char* wanted) {
    return column(table, wanted).value.front();
  };
  const auto error = [&](const Table& table, const char* wanted) {
    const Column& found = column(table, wanted);
    return found.error.empty() ? unknown : found.error.front();
  };
  const auto verdict = [&](const char* code, const char* tests, const char* reason) {
    return Equilibration{
        static_cast<EquilibrationVerdict>(static_cast<int>(value(*relaxation, code))),
        results.text(reason), static_cast<std::size_t>(value(*relaxation, tests))};
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
  run.seed = static_cast<std::uint64_t>(value(*relaxation, "seed"));
  run.rotors = static_cast<std::size_t>(value(*summary, "rotors"));
  run.duration = value(*relaxation, "duration");
  run.wave_number = value(*relaxation, "wave_number");
  run.nematic_order = {value(*relaxation, "nematic_order"), error(*relaxation, "nematic_order"), 0};
  run.plateau = value(*relaxation, "plateau");
  run.orientation =
      static_cast<OrientationKind>(static_cast<int>(value(*relaxation, "orientation")));
  run.translation = time("tau_translation");
  run.rotation = time("tau_rotation");
  run.diffusion = diffusion("diffusion");
  run.rotational_diffusion = diffusion("rotational_diffusion");
  run.equilibration = verdict("verdict", "tests", reason_key);
  run.translation_equilibration =
      verdict("verdict_translation", "tests_translation", translation_reason_key);
  return run;
}

GlassStudy study_glass(std::vector<GlassRun> runs, const std::string& mixed) {
  GlassStudy study{std::move(runs), {}};
  if (!mixed.empty()) {
    study.remarks.push_back(fmt::format(
        "no laws are fitted: the runs differ in {} as well; make a sweep of its own for each",
        mixed));
    return study;
  }
  for (const GlassKind kind : glass_kinds) {
    std::vector<GlassPoint> points;
    bool applied = false;
    for (const GlassRun& run : study.runs) {
      applied = applied || applies(kind, run);
      const Time time = time_of(kind, run);
      if (enters_fit(kind, run)) points.push_back({run.packing_fraction, time.value, time.error});
    }
    if (!applied) continue;
    for (const GlassLaw law : {GlassLaw::mode_coupling, GlassLaw::vogel_fulcher}) {
      study.laws.push_back({kind, law, fit_glass_law(points, law)});
      const std::string remark = crossed(study.laws.back(), points);
      if (!remark.empty()) study.remarks.push_back(remark);
    }
  }
  return study;
}

std::vector<Table> glass_tables(const GlassStudy& study) {
  return {relaxation_table(study), fit_table(study), window_table(study)};
}

std::vector<std::pair<std::string, std::string>> glass_notes(const GlassStudy& study) {
  std::vector<std::pair<std::string, std::string>> notes;
  const auto add = [&](const std::string& text) {
    notes.emplace_back(fmt::format("note_{}", notes.size() + 1), text);
  };
  const auto add_run = [&](const GlassRun& run, const char* what, const Equilibration& why) {
    add(fmt::format("{} (density {:.4g}, seed {}): {} stays out of the fits, {}: {}", run.name,
                    run.packing_fraction, run.seed, what, name_of(why.verdict), why.reason));
  };
  for (const std::string& sentence : order_or_glass(study)) add(sentence);
  for (const GlassRun& run : study.runs)
    if (!equilibrated(run.translation_equilibration))
      add_run(run, "all", run.translation_equilibration);
    else if (!equilibrated(run.equilibration))
      add_run(run, "rotation", run.equilibration);
  for (const std::string& line : law_lines(study))
    if (line.find("no phi_c") != std::string::npos) add(line);
  for (const std::string& remark : study.remarks) add(remark);
  return notes;
}

nlohmann::ordered_json glass_summary(const GlassRun& run) {
  return {{"seed", run.seed},
          {"verdict", name_of(run.equilibration.verdict)},
          {"reason", run.equilibration.reason},
          {"verdict_translation", name_of(run.translation_equilibration.verdict)},
          {"reason_translation", run.translation_equilibration.reason},
          {"orientation", name_of(run.orientation)},
          {"nematic_order", run.nematic_order.mean},
          {"nematic_order_error", run.nematic_order.error},
          {"wave_number", run.wave_number},
          {"tau_translation", run.translation.value},
          {"tau_translation_error", run.translation.error},
          {"tau_rotation", run.rotation.value},
          {"tau_rotation_error", run.rotation.error}};
}

nlohmann::ordered_json glass_summary(const GlassStudy& study) {
  nlohmann::ordered_json fits = nlohmann::ordered_json::array();
  for (const auto& [kind, law, fit] : study.laws) {
    const bool found = fit.verdict == GlassVerdict::found;
    const bool bounded = fit.verdict != GlassVerdict::refused;
    fits.push_back({{"kind", name_of(kind)},
                    {"law", name_of(law)},
                    {"phi_c", found ? fit.density : unknown},
                    {"phi_c_error", found ? fit.error : unknown},
                    {"phi_c_least", bounded ? fit.least : unknown},
                    {"exponent", found ? fit.strength : unknown},
                    {"exponent_error", found ? fit.strength_error : unknown},
                    {"window", {fit.window.lowest, fit.window.highest}},
                    {"chi2", fit.window.chi_square},
                    {"dof", fit.window.degrees},
                    {"reason", fit.reason}});
  }
  std::vector<std::string> remarks = order_or_glass(study);
  remarks.insert(remarks.end(), study.remarks.begin(), study.remarks.end());
  return {{"fits", std::move(fits)}, {"remarks", std::move(remarks)}};
}

std::string glass_text(const GlassStudy& study) {
  std::string text;
  if (!study.runs.empty())
    text += fmt::format("{:>8} {:>5} {:>7} {:>18} {:>18}  {:<14}  {:<15}  {}\n", "phi", "seed", "S",
                        "tau_alpha", "tau_2", "orientation", "translation", "all");
  for (const GlassRun& run : study.runs) text += run_line(run);
  for (const auto& lines : {order_or_glass(study), law_lines(study), study.remarks})
    for (const std::string& line : lines) text += line + "\n";
  return text;
}

}  // namespace vitrel
