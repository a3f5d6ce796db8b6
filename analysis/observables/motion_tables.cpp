#include "analysis/observables/motion_tables.h"

#include <fmt/format.h>

namespace vitrel {
namespace {

constexpr auto in_relaxation = Chart::Section::relaxation;

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
       .needs = needs,
       .charts = {correlation}},
      {.table = "velocity_spectrum",
       .what = "Spectra (2/pi) int C(t) cos(wt) dt of these autocorrelations, for evenly sampled "
               "runs: the density of states of vibrations; the integral over w is 1.",
       .needs = needs,
       .charts = {spectrum}}};
}

std::vector<Table> velocity_tables(const VelocityCorrelations& found) {
  const std::vector<Observable> observables = velocity_observables();
  Table correlation{
      observables[0].table,
      observables[0].what + fmt::format(" <v^2> = {:.6g}, <omega^2> = {:.6g}.",
                                        found.translation.mean_square, found.rotation.mean_square),
      {{"time", "time", found.lag, {}}}};
  Table spectrum{
      observables[1].table, observables[1].what, {{"frequency", "rad/time", found.frequency, {}}}};
  const auto add = [&](const std::string& ending, const VelocityCorrelation& of) {
    if (of.correlation.value.empty()) return;
    correlation.columns.push_back({"c" + ending, "1", of.correlation.value, of.correlation.error});
    spectrum.columns.push_back({"g" + ending, "time/rad", of.spectrum.mean, of.spectrum.error});
  };
  add("", found.translation);
  add("_angular", found.rotation);
  correlation.columns.push_back({"origins", "1", {found.origins.begin(), found.origins.end()}, {}});
  if (found.frequency.empty()) return {correlation};
  return {correlation, spectrum};
}

}  // namespace

std::vector<Table> motion_tables(const RunMotion& motion) {
  return motion.velocities ? velocity_tables(*motion.velocities) : std::vector<Table>{};
}

std::vector<Observable> motion_observables() {
  return velocity_observables();
}

}  // namespace vitrel
