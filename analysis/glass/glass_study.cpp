#include "analysis/glass/glass_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/special_values.h"

namespace vitrel {
namespace {

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

/// Returns whether a run can have a time of this kind at all.
bool applies(GlassKind kind, const GlassRun& run) {
  switch (kind) {
    case GlassKind::translation:
      return true;
    case GlassKind::rotation:
      return run.rotors > 0 && !nematic(run);
    case GlassKind::nematic_rotation:
      return nematic(run);
  }
  return false;
}

Time time_of(GlassKind kind, const GlassRun& run) {
  const RelaxationTime& time = kind == GlassKind::translation ? run.translation : run.rotation;
  return {time.value, time.error};
}

/// Returns 1/D of the same motion.
Time diffusion_time_of(GlassKind kind, const GlassRun& run) {
  switch (kind) {
    case GlassKind::translation:
      return inverse(run.diffusion);
    case GlassKind::rotation:
      return inverse(run.rotational_diffusion);
    case GlassKind::nematic_rotation:
      break;
  }
  return {unknown, unknown};
}

/// Returns whether a run was in equilibrium as far as this kind of time needs it.
bool equilibrated(GlassKind kind, const GlassRun& run) {
  return equilibrated(kind == GlassKind::translation ? run.translation_equilibration
                                                     : run.equilibration);
}

/// Returns the times of one kind that enter a fit.
std::vector<GlassPoint> points_of(GlassKind kind, const std::vector<GlassRun>& runs,
                                  Time (*time_of_kind)(GlassKind, const GlassRun&)) {
  std::vector<GlassPoint> points;
  for (const GlassRun& run : runs) {
    const Time time = time_of_kind(kind, run);
    if (applies(kind, run) && equilibrated(kind, run) && time.value > 0 && time.error > 0)
      points.push_back({run.packing_fraction, time.value, time.error});
  }
  return points;
}

DiffusionVerdict compare(const GlassFit& relaxation, const GlassFit& diffusion) {
  constexpr double max_errors = 3;
  if (relaxation.verdict != GlassVerdict::found || diffusion.verdict == GlassVerdict::refused)
    return DiffusionVerdict::untested;
  const GlassWindow &of = relaxation.window, &by = diffusion.window;
  const bool agrees =
      diffusion.verdict == GlassVerdict::lower_bound
          ? of.density + max_errors * of.error() >= by.least
          : std::abs(of.density - by.density) <= max_errors * std::hypot(of.error(), by.error());
  return agrees ? DiffusionVerdict::agrees : DiffusionVerdict::disagrees;
}

StudiedLaw studied_law(GlassKind kind, GlassLaw law, const std::vector<GlassRun>& runs) {
  const GlassFit fit = fit_glass_law(points_of(kind, runs, time_of), law);
  const GlassFit diffusion = fit_glass_law(points_of(kind, runs, diffusion_time_of), law);
  return {kind, law, fit, compare(fit, diffusion)};
}

}  // namespace

GlassStudy study_glass(std::vector<GlassRun> runs, std::string mixed) {
  GlassStudy study{std::move(runs), {}};
  const auto relative =
      static_cast<std::size_t>(std::ranges::count_if(study.runs, &GlassRun::relative_to_cage));
  if (relative > 0) study.remarks.push_back("tau_alpha is of the motion relative to the cage");
  if (mixed.empty() && relative > 0 && relative < study.runs.size())
    mixed = "whether the motion relative to the cage is known";
  if (!mixed.empty()) {
    study.remarks.push_back(fmt::format(
        "no laws are fitted: the runs differ in {} as well; make a sweep of its own for each",
        mixed));
    return study;
  }
  for (const GlassKind kind : glass_kinds) {
    const bool applied =
        std::ranges::any_of(study.runs, [kind](const GlassRun& run) { return applies(kind, run); });
    if (!applied) continue;
    for (const GlassLaw law : {GlassLaw::mode_coupling, GlassLaw::vogel_fulcher})
      study.laws.push_back(studied_law(kind, law, study.runs));
  }
  return study;
}

}  // namespace vitrel
