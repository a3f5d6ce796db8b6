#include "workflow/report/run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "workflow/configuration/parameters.h"
#include "workflow/storage/trajectory_file.h"
#include "workflow/sweep/sweep_results.h"

namespace vitrel {
namespace {

std::string dynamics_text(const Provenance& provenance, const std::string& file) {
  if (provenance.parameters.empty()) return "";
  const DynamicsParameters p = parse_parameters(provenance.parameters, file).dynamics;
  return p.kind == DynamicsParameters::Kind::brownian
             ? fmt::format("Brownian, step {:g}", p.brownian_step)
             : "Newtonian";
}

constexpr std::size_t max_movies = 6;

/// How many poses the movie of every run may have.
std::vector<std::size_t> movie_poses(std::size_t runs) {
  if (runs == 1) return {MovieLimits{}.poses};
  const std::size_t movies = std::min(runs, max_movies);
  std::vector<std::size_t> poses(runs, 0);
  for (std::size_t k = 0; k < movies; ++k)
    poses[k * (runs - 1) / (movies - 1)] = MovieLimits{}.poses / (2 * movies);
  return poses;
}

/// Of wall time, over the whole run; NaN if not recorded.
double collisions_per_second(const TrajectoryReader& reader) {
  const double seconds = reader.provenance().wall_seconds;
  if (!(seconds > 0) || !reader.has_observable("collisions"))
    return std::numeric_limits<double>::quiet_NaN();
  return reader.observable("collisions").back() / seconds;
}

ReportRun report_run(const AnalysedRun& run, TrajectoryFile<2>& trajectory, std::size_t movie_poses) {
  const TrajectoryReader& reader = trajectory.reader();
  MovieLimits limits;
  limits.poses = movie_poses;
  limits.images_known = reader.has("image");
  return {run.name(),
          dynamics_text(reader.provenance(), run.file.string()),
          run.packing_fraction(),
          collisions_per_second(reader),
          run.results,
          film(trajectory, limits),
          provenance_rows(reader.provenance())};
}

/// The name of the run, or of the folder of the sweep, in which every job has a folder of its own.
std::string title_of(const std::vector<AnalysedRun>& runs) {
  if (runs.size() == 1) return runs.front().name();
  const std::filesystem::path file = std::filesystem::absolute(runs.front().file);
  return file.lexically_normal().parent_path().parent_path().filename().string();
}

std::string shapes_text(const std::vector<Ellipse>& shapes) {
  const double ratio = shapes.front().aspect_ratio();
  for (const Ellipse& shape : shapes)
    if (std::abs(shape.aspect_ratio() - ratio) > 1e-9 * ratio) return "ellipses of several shapes";
  return ratio == 1 ? "disks" : fmt::format("ellipses, κ = {:.4g}", ratio);
}

std::string shapes_text(const std::vector<Ellipsoid>& shapes) {
  const Vec3 ratios = shapes.front().semi_axes / shapes.front().inradius();
  for (const Ellipsoid& shape : shapes)
    if (!ratios.isApprox(shape.semi_axes / shape.inradius(), 1e-9))
      return "ellipsoids of several shapes";
  return shapes.front().is_round()
             ? "spheres"
             : fmt::format("ellipsoids, {:.4g} : {:.4g} : {:.4g}", ratios[0], ratios[1], ratios[2]);
}

}  // namespace

template <int Dim>
std::string particles_text(const Configuration<Dim>& state) {
  if (state.species_names.size() < 2) return shapes_text(state.shape);
  std::string names;
  for (const std::string& name : state.species_names) names += (names.empty() ? "" : ", ") + name;
  return "particles of species " + names;
}

template std::string particles_text(const Configuration2&);
template std::string particles_text(const Configuration3&);

ReportData report_data(const std::vector<AnalysedRun>& runs) {
  ReportData data;
  data.title = title_of(runs);
  const std::vector<std::size_t> poses = movie_poses(runs.size());
  for (std::size_t k = 0; k < runs.size(); ++k) {
    TrajectoryFile<2> trajectory(runs[k].file);
    data.runs.push_back(report_run(runs[k], trajectory, poses[k]));
    if (k > 0) continue;
    const Configuration2& state = trajectory.read(0);
    const std::string& dynamics = data.runs.front().dynamics;
    data.subtitle = fmt::format("{} {}{}{}", state.size(), particles_text(state),
                                dynamics.empty() ? "" : ", ", dynamics);
    if (runs.size() == 1)
      data.subtitle += fmt::format(", φ = {:.6g}", data.runs.front().packing_fraction);
    data.parameters = trajectory.reader().provenance().parameters;
  }
  if (runs.size() > 1) data.study = results_of_sweep(runs, glass_study(runs));
  return data;
}

}  // namespace vitrel
