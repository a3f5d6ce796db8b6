#include "workflow/analyze/glass_report.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "analysis/glass/glass_names.h"
#include "core/io/json.h"
#include "core/io/number_text.h"
#include "core/special_values.h"

namespace vitrel {
namespace {

std::string run_line(const GlassRun& run) {
  return fmt::format("{:8.4g} {:5} {:>7} {:>18} {:>18}  {:<14}  {:<15}  {}\n", run.packing_fraction,
                     run.seed, run.rotors > 0 ? fmt::format("{:.3f}", run.nematic_order.mean) : "-",
                     with_error(run.translation.value, run.translation.error),
                     with_error(run.rotation.value, run.rotation.error), name_of(run.orientation),
                     name_of(run.translation_equilibration.verdict),
                     name_of(run.equilibration.verdict));
}

constexpr std::array diffusion_names = {"untested", "agrees", "disagrees"};

const char* name_of(DiffusionVerdict verdict) {
  return diffusion_names[static_cast<std::size_t>(verdict)];
}

/// Says whether the diffusion coefficient agrees with φ_c; the text is appended to that of φ_c.
std::string diffusion_text(const StudiedLaw& studied) {
  if (studied.diffusion == DiffusionVerdict::untested) return "";
  return fmt::format("; {} {}", studied.kind == GlassKind::translation ? "1/D" : "1/D_r",
                     name_of(studied.diffusion));
}

std::string law_text(const StudiedLaw& studied) {
  const GlassFit& fit = studied.fit;
  if (fit.verdict != GlassVerdict::found) return "no phi_c: " + fit.reason;
  const GlassWindow& w = fit.window;
  return fmt::format("phi_c = {}, s = {}; best window {:.4g} ... {:.4g}, chi^2/dof {:.2f}{}",
                     with_error(w.density, w.error()), with_error(w.strength, w.strength_error()),
                     w.lowest, w.highest, w.chi_square / static_cast<double>(w.degrees),
                     diffusion_text(studied));
}

/// One line for each kind of motion and law, or one for both laws where they say the same.
std::vector<std::string> law_lines(const GlassStudy& study) {
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < study.laws.size(); ++k) {
    const StudiedLaw& studied = study.laws[k];
    const std::string text = law_text(studied);
    const bool has_next = k + 1 < study.laws.size() && study.laws[k + 1].kind == studied.kind;
    const bool same = has_next && text == law_text(study.laws[k + 1]);
    lines.push_back(
        same ? fmt::format("{}: {}", name_of(studied.kind), text)
             : fmt::format("{}, {}: {}", name_of(studied.kind), name_of(studied.law), text));
    k += same;
  }
  return lines;
}

/// The packing fractions of the runs for which the predicate holds, each listed once.
std::string densities_where(const GlassStudy& study, auto&& predicate) {
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

/// Sentences that say at which packing fractions order or glass keeps the orientations.
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
      "the plateau that order gives it.",
      ordered(true));
  say("So it seems at {}, where a run was not in equilibrium or too short to tell.",
      ordered(false));
  say("Orientations do not relax within the times measured (beyond what order explains) at {}.",
      densities_where(
          study, [](const GlassRun& run) { return run.orientation == OrientationKind::lasting; }));
  return sentences;
}

}  // namespace

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
    if (line.find("no phi_c") != std::string::npos ||
        line.ends_with(name_of(DiffusionVerdict::disagrees)))
      add(line);
  for (const std::string& remark : study.remarks) add(remark);
  return notes;
}

Json glass_summary(const GlassRun& run) {
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

Json glass_summary(const GlassStudy& study) {
  Json fits = Json::array();
  for (const auto& [kind, law, fit, diffusion] : study.laws) {
    const bool found = fit.verdict == GlassVerdict::found;
    const GlassWindow& w = fit.window;
    const bool bounded = fit.verdict != GlassVerdict::refused;
    fits.push_back({{"kind", name_of(kind)},
                    {"law", name_of(law)},
                    {"phi_c", found ? w.density : unknown},
                    {"phi_c_error", found ? w.error() : unknown},
                    {"phi_c_least", bounded ? w.least : unknown},
                    {"diffusion", name_of(diffusion)},
                    {"exponent", found ? w.strength : unknown},
                    {"exponent_error", found ? w.strength_error() : unknown},
                    {"window", {w.lowest, w.highest}},
                    {"chi2", w.chi_square},
                    {"dof", w.degrees},
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
