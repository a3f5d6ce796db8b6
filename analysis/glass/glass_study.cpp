#include "analysis/glass/glass_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "analysis/glass/glass_names.h"

namespace vitrel {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

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

/// Whether a run was in equilibrium as far as this kind of time needs it.
bool equilibrated(GlassKind kind, const GlassRun& run) {
  const bool places_suffice = kind == GlassKind::translation || kind == GlassKind::diffusion;
  return equilibrated(places_suffice ? run.translation_equilibration : run.equilibration);
}

bool enters_fit(GlassKind kind, const GlassRun& run) {
  const Time time = time_of(kind, run);
  return applies(kind, run) && equilibrated(kind, run) && time.value > 0 && time.error > 0;
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

}  // namespace vitrel
