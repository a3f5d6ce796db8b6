#include "workflow/report/run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "core/io/foreign/foreign_file.h"
#include "workflow/configuration/hard_contacts.h"
#include "workflow/storage/trajectory_file.h"

namespace vitrel {
namespace {

/// The parameters that the file stores; no value if it stores none.
std::optional<Parameters> stored_parameters(const TrajectoryReader& reader) {
  const std::string parameters = reader.provenance().parameters;
  if (parameters.empty()) return std::nullopt;
  return parse_parameters(parameters, reader.path().string());
}

/// Whether runs with other seeds draw other particles.
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

/// The law of Haff that holds for the dynamics; no value if they conserve the energy or redraw velocities.
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

/// The number of characters available for the movie of each run.
std::vector<std::size_t> movie_room(std::size_t runs) {
  const std::size_t all = MovieLimits{}.characters;
  if (runs == 1) return {all};
  const std::size_t movies = std::min(runs, max_movies);
  std::vector<std::size_t> room(runs, 0);
  for (std::size_t k = 0; k < movies; ++k) room[k * (runs - 1) / (movies - 1)] = all / (2 * movies);
  return room;
}

/// Adds the cost of the run to its summary. Runs in progress and other programs do not record the time.
void add_cost(const TrajectoryReader& reader, Results& results) {
  const double seconds = reader.provenance().wall_seconds;
  if (!(seconds > 0) || !reader.import_report().empty() || !reader.has_observable("collisions"))
    return;
  const auto summary = std::ranges::find(results.tables, "summary", &Table::name);
  if (summary == results.tables.end() || summary->find("wall_seconds")) return;
  summary->columns.push_back({"wall_seconds", "s", {seconds}});
  summary->columns.push_back({"collisions_per_second_with_output",
                              "1/s",
                              {reader.observable("collisions").back() / seconds},
                              {}});
}

template <int Dim>
ReportRun report_run(const AnalysedRun& run, const std::string& label,
                     TrajectoryFile<Dim>& trajectory, std::size_t room) {
  const TrajectoryReader& reader = trajectory.reader();
  const bool is_state = reader.frames() == 1;
  const auto parameters = is_state ? std::nullopt : stored_parameters(reader);
  const auto dynamics = parameters ? std::optional(parameters->dynamics) : std::nullopt;
  const MovieLimits limits{.characters = room, .images_known = reader.has("image")};
  ReportRun shown{run.name(),
                  label,
                  dynamics ? dynamics_text(*dynamics) : "",
                  run.packing_fraction(),
                  run.results,
                  film(trajectory, limits),
                  provenance_rows(reader.provenance()),
                  dynamics ? cooling_of(*dynamics) : std::nullopt};
  if (!is_state) add_cost(reader, shown.results);
  return shown;
}

/// The text that all of these share; empty if they differ.
std::string shared_text(const std::set<std::string>& texts) {
  return texts.size() == 1 ? *texts.begin() : "";
}

/// The texts about the runs that appear on the page besides their tables.
struct Titles {
  std::set<std::string> particles, dynamics;

  /// "100 ellipses, κ = 2, Newtonian", without the parts in which runs differ.
  std::string shared() const {
    const std::string of_particles = shared_text(particles), of_dynamics = shared_text(dynamics);
    return of_particles + (of_particles.empty() || of_dynamics.empty() ? "" : ", ") + of_dynamics;
  }
};

template <int Dim>
void add_run(const AnalysedRun& run, const std::string& label, const KnownSystem& known,
             std::size_t room, ReportData& data, Titles& titles) {
  TrajectoryFile<Dim> trajectory{TrajectoryReader(run.file, known)};
  data.runs.push_back(report_run(run, label, trajectory, room));
  const Configuration<Dim>& state = trajectory.read(0);
  titles.particles.insert(fmt::format("{} {}", state.size(), particles_text(state)));
  titles.dynamics.insert(data.runs.back().dynamics);
  if (data.runs.size() > 1) return;
  const TrajectoryReader& reader = trajectory.reader();
  data.parameters = reader.provenance().parameters;
  data.units = reader.units();
  if (has_particles_of_its_own(stored_parameters(reader)))
    data.provenance.emplace_back("errors",
                                 "of this realisation of sizes and shapes: every seed has its own "
                                 "(system.draw), and differs by more");
  for (const auto& row : reader.import_report()) data.provenance.push_back(row);
}

void add_run(const AnalysedRun& run, const std::string& label, const KnownSystem& known,
             std::size_t room, ReportData& data, Titles& titles) {
  const bool in_plane = dimension_of_file(run.file, known) == 2;
  (in_plane ? add_run<2> : add_run<3>)(run, label, known, room, data, titles);
}

/// The last part of a dotted key, with blanks instead of underscores.
std::string words(const std::string& key) {
  std::string last = last_part(key);
  std::ranges::replace(last, '_', ' ');
  return last;
}

std::string shapes_text(const std::vector<ParticleShape<2>>& shapes) {
  const double ratio = shapes.front().aspect_ratio();
  for (const ParticleShape<2>& shape : shapes)
    if (std::abs(shape.aspect_ratio() - ratio) > 1e-9 * ratio) return "ellipses of several shapes";
  return ratio == 1 ? "disks" : fmt::format("ellipses, κ = {:.4g}", ratio);
}

std::string shapes_text(const std::vector<ParticleShape<3>>& shapes) {
  const Vec3 ratios = shapes.front().half_lengths() / shapes.front().inradius();
  for (const ParticleShape<3>& shape : shapes)
    if (!ratios.isApprox(shape.half_lengths() / shape.inradius(), 1e-9))
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

ReportData report_data(const AnalysedRun& run, const KnownSystem& known) {
  ReportData data;
  Titles titles;
  add_run(run, fmt::format("φ = {:.6g}", run.packing_fraction()), known, movie_room(1).front(),
          data, titles);
  const ReportRun& shown = data.runs.front();
  data.title = fmt::format("{}: run of {}", shown.name, *titles.particles.begin());
  data.subtitle = fmt::format("{}{}φ = {:.6g}", shown.dynamics, shown.dynamics.empty() ? "" : ", ",
                              shown.packing_fraction);
  return data;
}

ReportData report_data(const AnalysedSweep& sweep) {
  if (sweep.runs.size() == 1) return report_data(sweep.runs.front());
  ReportData data;
  Titles titles;
  const std::vector<std::size_t> room = movie_room(sweep.runs.size());
  for (std::size_t k = 0; k < sweep.runs.size(); ++k)
    add_run(sweep.runs[k], sweep.label(k), {}, room[k], data, titles);
  // The title is the name of the folder of the sweep, in which every job has a folder of its own.
  const std::filesystem::path file = std::filesystem::absolute(sweep.runs.front().file);
  data.title = file.lexically_normal().parent_path().parent_path().filename().string();
  data.subtitle = fmt::format("{} jobs", sweep.runs.size());
  if (const std::string shared = titles.shared(); !shared.empty()) data.subtitle += ": " + shared;
  data.parameters = "# of " + data.runs.front().name + "\n" + data.parameters;
  for (const StudyAxis& axis : sweep.axes)
    data.axes.push_back({axis.column(), axis.symbol, words(axis.key)});
  data.study = results_of_sweep(sweep, glass_study(sweep));
  return data;
}

}  // namespace vitrel
