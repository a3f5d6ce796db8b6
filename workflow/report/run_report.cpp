#include "workflow/report/run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/io/foreign/foreign_file.h"
#include "workflow/configuration/hard_contacts.h"
#include "workflow/storage/trajectory_file.h"
#include "workflow/sweep/sweep_results.h"

namespace vitrel {
namespace {

/// None if the file does not say.
std::optional<Parameters> stored_parameters(const TrajectoryReader& reader) {
  const std::string parameters = reader.provenance().parameters;
  if (parameters.empty()) return std::nullopt;
  return parse_parameters(parameters, reader.path().string());
}

/// Whether runs with other seeds have other particles.
bool has_particles_of_its_own(const std::optional<Parameters>& parameters) {
  return parameters && parameters->system.draw == ShapeDraw::random &&
         !std::ranges::all_of(parameters->species, &Species::has_one_shape);
}

std::string dynamics_text(const DynamicsParameters& p) {
  std::string text = p.kind == DynamicsParameters::Kind::brownian
                         ? fmt::format("Brownian, step {:g}", p.brownian_step)
                         : "Newtonian";
  if (has_constant_restitution(p))
    text += fmt::format(", restitution {:g}", p.restitution.value);
  else if (is_dissipative(p))
    text += p.friction > 0 ? ", inelastic and rough contacts" : ", inelastic contacts";
  if (p.driving) text += ", driven";
  if (p.contact)
    text += p.contact->law == ContactParameters::Law::viscoelastic
                ? ", viscoelastic contacts"
                : ", contacts with linear dashpots";
  return text;
}

/// Which of Haff's laws holds; none for dynamics that conserve the energy or draw velocities again.
std::optional<Cooling> cooling_of(const DynamicsParameters& p) {
  if (p.kind == DynamicsParameters::Kind::brownian || p.driving) return std::nullopt;
  if (cools_by_haff(p))
    return Cooling{
        2, p.friction > 0
               ? "the coefficients of restitution are constant; it begins when rotation and "
                 "translation have reached their ratio"
               : "the coefficients of restitution are constant"};
  if (!p.contact) return std::nullopt;
  if (p.contact->law == ContactParameters::Law::linear_dashpot &&
      p.contact->linear_dashpot.damping > 0)
    return Cooling{2,
                   "the coefficient of restitution of a linear dashpot is the same at all speeds"};
  if (p.contact->law == ContactParameters::Law::viscoelastic &&
      p.contact->viscoelastic.dissipative_time > 0)
    return Cooling{5. / 3,
                   "viscoelastic spheres are the more elastic the slower they collide (1 − ε ∝ "
                   "v^(1/5))"};
  return std::nullopt;
}

constexpr std::size_t max_movies = 6;

/// How many characters the movie of every run may take.
std::vector<std::size_t> movie_room(std::size_t runs) {
  const std::size_t all = MovieLimits{}.characters;
  if (runs == 1) return {all};
  const std::size_t movies = std::min(runs, max_movies);
  std::vector<std::size_t> room(runs, 0);
  for (std::size_t k = 0; k < movies; ++k) room[k * (runs - 1) / (movies - 1)] = all / (2 * movies);
  return room;
}

/// The number of collisions per second of wall time; NaN if the file does not record the time, as in a run in progress.
double collisions_per_second(const TrajectoryReader& reader) {
  const double seconds = reader.provenance().wall_seconds;
  if (!(seconds > 0) || !reader.import_report().empty() || !reader.has_observable("collisions"))
    return std::numeric_limits<double>::quiet_NaN();
  return reader.observable("collisions").back() / seconds;
}

template <int Dim>
ReportRun report_run(const AnalysedRun& run, TrajectoryFile<Dim>& trajectory, std::size_t room) {
  const TrajectoryReader& reader = trajectory.reader();
  const auto parameters = stored_parameters(reader);
  const auto dynamics = parameters ? std::optional(parameters->dynamics) : std::nullopt;
  const MovieLimits limits{.characters = room, .images_known = reader.has("image")};
  return {run.name(),
          dynamics ? dynamics_text(*dynamics) : "",
          run.packing_fraction(),
          collisions_per_second(reader),
          run.results,
          film(trajectory, limits),
          provenance_rows(reader.provenance()),
          dynamics ? cooling_of(*dynamics) : std::nullopt};
}

/// The name of the run and what it is of; or the folder of the sweep, in which every job has a folder of its
/// own.
template <int Dim>
void add_titles(const std::vector<AnalysedRun>& runs, const Configuration<Dim>& state,
                ReportData& data) {
  const ReportRun& first = data.runs.front();
  const std::string particles = fmt::format("{} {}", state.size(), particles_text(state));
  if (runs.size() == 1) {
    data.title = fmt::format("{}: run of {}", first.name, particles);
    data.subtitle = fmt::format("{}{}φ = {:.6g}", first.dynamics,
                                first.dynamics.empty() ? "" : ", ", first.packing_fraction);
    return;
  }
  const std::filesystem::path file = std::filesystem::absolute(runs.front().file);
  data.title = file.lexically_normal().parent_path().parent_path().filename().string();
  data.subtitle = particles + (first.dynamics.empty() ? "" : ", " + first.dynamics);
  data.parameters = "# of " + first.name + "\n";
}

template <int Dim>
void add_runs(const std::vector<AnalysedRun>& runs, const KnownSystem& known, ReportData& data) {
  const std::vector<std::size_t> room = movie_room(runs.size());
  for (std::size_t k = 0; k < runs.size(); ++k) {
    TrajectoryFile<Dim> trajectory{TrajectoryReader(runs[k].file, known)};
    data.runs.push_back(report_run(runs[k], trajectory, room[k]));
    if (k > 0) continue;
    add_titles(runs, trajectory.read(0), data);
    data.parameters += trajectory.reader().provenance().parameters;
    data.units = trajectory.reader().units();
    if (has_particles_of_its_own(stored_parameters(trajectory.reader())))
      data.provenance.emplace_back(
          "errors",
          "of this realisation of sizes and shapes: every seed has its own "
          "(system.draw), and differs by more");
    if (runs.size() > 1) continue;
    for (const auto& row : trajectory.reader().import_report()) data.provenance.push_back(row);
  }
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
  const char* round = Dim == 2 ? "disks" : "spheres";
  return fmt::format("{} of species {}", rotor_count(state) == 0 ? round : "particles", names);
}

template std::string particles_text(const Configuration2&);
template std::string particles_text(const Configuration3&);

ReportData report_data(const std::vector<AnalysedRun>& runs, const KnownSystem& known) {
  ReportData data;
  const bool in_plane = dimension_of_file(runs.front().file, known) == 2;
  (in_plane ? add_runs<2> : add_runs<3>)(runs, known, data);
  if (runs.size() > 1) data.study = results_of_sweep(runs, glass_study(runs));
  return data;
}

}  // namespace vitrel
