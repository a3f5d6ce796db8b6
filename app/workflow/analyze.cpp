#include "app/workflow/analyze.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <thread>

#include "app/workflow/correlations_file.h"
#include "app/workflow/glass_data.h"
#include "app/workflow/stored_run.h"
#include "app/workflow/structure_tables.h"
#include "core/error.h"

namespace vitrel {
namespace {

using Json = nlohmann::ordered_json;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

Parameters analysis_parameters(const RunAnalysis& run, const AnalysisChoice& choice) {
  if (choice.parameters)
    return load_parameters({*choice.parameters, choice.overrides, std::nullopt});
  return parse_parameters(run.provenance.parameters, run.file.string(), choice.overrides);
}

/// As many threads as the machine has: the results do not depend on it.
int all_threads() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// What displacements need of a file; those of round particles need no angles.
void require_tracks(const TrajectoryReader& reader, std::size_t rotors) {
  reader.require("image",
                 "displacements: positions in the box do not tell how often it was crossed");
  if (rotors > 0)
    reader.require("angle", "rotations: orientations do not tell the number of turns");
}

/// The short part first: it refuses wave numbers that do not fit into the box.
RunDynamics measure_dynamics(StoredTrajectory& trajectory, DisplacementOptions options,
                             ProgressDisplay::Mode progress) {
  ProgressDisplay display(progress);
  const auto report = [&](const Progress& state) { display.show(state); };
  if (options.wave_numbers.empty()) options.wave_numbers = {main_wave_number(trajectory.read(0))};
  RunDynamics dynamics;
  display.begin("collective scattering");
  dynamics.collective = collective_scattering(trajectory, options.wave_numbers, options.axis,
                                              report, options.threads);
  display.begin("displacements");
  dynamics.displacements = displacements(trajectory, options, report);
  return dynamics;
}

std::string run_name(const RunAnalysis& run) {
  const bool in_job_folder = run.file.filename() == "run.h5" && run.file.has_parent_path();
  return in_job_folder ? run.file.parent_path().filename().string() : run.file.stem().string();
}

const Table& order_table(const std::vector<Table>& tables) {
  return *std::find_if(tables.begin(), tables.end(),
                       [](const Table& table) { return table.name == "order"; });
}

DiffusionCoefficient no_diffusion(const char* reason) {
  return {unknown, unknown, unknown, unknown, reason};
}

void measure(RunAnalysis& run, StoredTrajectory& trajectory, const Parameters& parameters,
             ProgressDisplay::Mode progress) {
  const TrajectoryReader& reader = trajectory.reader();
  run.final_state = trajectory.read(trajectory.frames() - 1);
  run.particles = run.final_state.size();
  run.rotors = rotor_count(run.final_state);
  run.packing_fraction = packing_fraction(run.final_state);
  run.frames = trajectory.frames();
  run.duration = trajectory.times().back() - trajectory.times().front();
  require_tracks(reader, run.rotors);
  run.dynamics = measure_dynamics(trajectory, parameters.analysis, progress);
  run.structure = structure_tables(trajectory, parameters.structure, all_threads());
  run.energy = stored_energies(trajectory);
  run.compressibility = stored_compressibility(reader, run.energy, run.rotors);
  const Displacements& found = run.dynamics.displacements;
  const DisplacementGroup& all = found.groups.front();
  const std::vector<double>& times = trajectory.times();
  run.diffusion = diffusion_coefficient(found, all.translation, 2, times);
  run.rotational_diffusion = run.rotors > 0 ? diffusion_coefficient(found, all.rotation, 1, times)
                                            : no_diffusion("no particle can turn");
  if (const auto data =
          glass_run_data(trajectory,
                         {run_name(run), run.provenance.seed, run.packing_fraction, run.rotors,
                          found, run.compressibility, order_table(run.structure)},
                         parameters.analysis))
    run.glass = judge_glass_run(*data);
}

Table energy_table(const EnergySeries& energy) {
  return {"energies",
          "Energies per particle at the sample times, in kT; translational + rotational = total.",
          {{"time", "time", energy.time, {}},
           {"translational", "kT", energy.translational, {}},
           {"rotational", "kT", energy.rotational, {}},
           {"total", "kT", energy.total, {}}}};
}

Table compressibility_table(const CompressibilitySeries& series) {
  return {"compressibility",
          "Compressibility factor Z = P/(rho kT) from the virial of the collisions between two "
          "samples.",
          {{"time", "time", series.time, {}}, {"z", "1", series.value, {}}}};
}

Column single(const char* name, const char* unit, double value, double error) {
  return {name, unit, {value}, {error}};
}

std::vector<Column> summary_columns(const RunAnalysis& run) {
  const Estimate translational = time_average(run.energy.time, run.energy.translational);
  const Estimate rotational = time_average(run.energy.time, run.energy.rotational);
  const Estimate& z = run.compressibility.mean;
  return {{"packing_fraction", "1", {run.packing_fraction}, {}},
          {"particles", "1", {static_cast<double>(run.particles)}, {}},
          {"rotors", "1", {static_cast<double>(run.rotors)}, {}},
          {"collisions", "1", {static_cast<double>(run.collisions)}, {}},
          {"duration", "time", {run.duration}, {}},
          single("compressibility", "1", z.mean, z.error),
          single("translational_energy", "kT", translational.mean, translational.error),
          single("rotational_energy", "kT", rotational.mean, rotational.error),
          single("diffusion", "length^2/time", run.diffusion.value, run.diffusion.error),
          {"diffusion_from", "time", {run.diffusion.from}, {}},
          {"diffusion_to", "time", {run.diffusion.to}, {}},
          single("rotational_diffusion", "rad^2/time", run.rotational_diffusion.value,
                 run.rotational_diffusion.error),
          {"rotational_diffusion_from", "time", {run.rotational_diffusion.from}, {}},
          {"rotational_diffusion_to", "time", {run.rotational_diffusion.to}, {}}};
}

std::string dynamics_text(const std::optional<Parameters>& parameters) {
  if (!parameters) return "";
  const DynamicsParameters& p = parameters->dynamics;
  return p.kind == DynamicsParameters::Kind::brownian
             ? fmt::format("Brownian, step {:g}", p.brownian_step)
             : "Newtonian";
}

constexpr std::size_t most_movies = 6;

/// How many poses the movie of every run may have.
std::vector<std::size_t> movie_poses(const std::vector<RunAnalysis>& runs) {
  if (runs.size() == 1) return {MovieLimits{}.poses};
  std::vector<std::size_t> order(runs.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t left, std::size_t right) {
    return runs[left].packing_fraction < runs[right].packing_fraction;
  });
  const std::size_t movies = std::min(runs.size(), most_movies);
  std::vector<std::size_t> poses(runs.size(), 0);
  for (std::size_t k = 0; k < movies; ++k)
    poses[order[k * (runs.size() - 1) / (movies - 1)]] = MovieLimits{}.poses / (2 * movies);
  return poses;
}

/// Appends what the study found, and its notes to the provenance.
void add_study(Results& results, const GlassStudy& study) {
  if (study.runs.empty()) return;
  for (Table& table : glass_tables(study))
    if (table.rows() > 0) results.tables.push_back(std::move(table));
  for (auto& note : glass_notes(study)) results.provenance.push_back(std::move(note));
}

ReportRun report_run(const RunAnalysis& run, std::size_t movie_poses) {
  StoredTrajectory trajectory(run.file);
  MovieLimits limits;
  limits.poses = movie_poses;
  limits.images_known = trajectory.reader().has("image");
  return {run_name(run),        dynamics_text(run.parameters),
          run.packing_fraction, run.collisions_per_second,
          results_of(run),      film(trajectory, limits)};
}

}  // namespace

RunAnalysis analyze_run(const std::filesystem::path& file, const AnalysisChoice& choice) {
  RunAnalysis run;
  run.file = file;
  StoredTrajectory trajectory(file);
  const TrajectoryReader& reader = trajectory.reader();
  if (trajectory.frames() < 2)
    throw UserError(
        fmt::format("{}: has {} frame(s), but an analysis needs two or more; continue the "
                    "run, or sample more often ([output] samples)",
                    file.string(), trajectory.frames()));
  run.provenance = reader.provenance();
  if (!run.provenance.parameters.empty())
    run.parameters = parse_parameters(run.provenance.parameters, file.string());
  measure(run, trajectory, analysis_parameters(run, choice), choice.progress);
  const std::vector<std::string> names = reader.observable_names();
  if (std::find(names.begin(), names.end(), "collisions") != names.end()) {
    const std::vector<double> collisions = reader.observable("collisions");
    run.collisions = static_cast<std::uint64_t>(collisions.back() - collisions.front());
    if (run.provenance.wall_seconds > 0)
      run.collisions_per_second = collisions.back() / run.provenance.wall_seconds;
  }
  run.on_the_fly = on_the_fly_tables(file);
  return run;
}

GlassStudy glass_study(const std::vector<RunAnalysis>& runs) {
  std::vector<GlassRun> judged;
  for (const RunAnalysis& run : runs)
    if (run.glass) judged.push_back(*run.glass);
  return study_glass(std::move(judged));
}

Results results_of(const RunAnalysis& run) {
  Results results;
  results.tables.push_back({"summary", "Averages over the run.", summary_columns(run)});
  for (Table& table : dynamics_tables(run.dynamics)) results.tables.push_back(std::move(table));
  results.tables.push_back(energy_table(run.energy));
  if (!run.compressibility.value.empty())
    results.tables.push_back(compressibility_table(run.compressibility));
  results.tables.insert(results.tables.end(), run.structure.begin(), run.structure.end());
  results.tables.insert(results.tables.end(), run.on_the_fly.begin(), run.on_the_fly.end());
  results.provenance = provenance_rows(run.provenance);
  if (run.glass) add_study(results, {{*run.glass}, {}});
  results.provenance.emplace_back("source", run.file.string());
  return results;
}

Results results_of_sweep(const std::vector<RunAnalysis>& runs) {
  Results results;
  Table table{"runs", "Averages over every run of the sweep, one run per row.", {}};
  for (const RunAnalysis& run : runs) {
    std::vector<Column> row = summary_columns(run);
    if (table.columns.empty()) {
      table.columns = std::move(row);
    } else {
      for (std::size_t k = 0; k < row.size(); ++k) {
        table.columns[k].value.push_back(row[k].value.front());
        if (!row[k].error.empty()) table.columns[k].error.push_back(row[k].error.front());
      }
    }
    results.provenance.emplace_back(fmt::format("row_{}", results.provenance.size()),
                                    run.file.string());
  }
  results.tables.push_back(std::move(table));
  add_study(results, glass_study(runs));
  return results;
}

void write_all(const std::filesystem::path& file, const Results& results) {
  write_results(file, results);
  for (const Table& table : results.tables)
    write_csv(file.parent_path() / fmt::format("{}_{}.csv", file.stem().string(), table.name),
              table);
}

Json analysis_summary(const RunAnalysis& run) {
  const Estimate& z = run.compressibility.mean;
  Json summary = {{"file", run.file.string()},
                  {"particles", run.particles},
                  {"packing_fraction", run.packing_fraction},
                  {"frames", run.frames},
                  {"duration", run.duration},
                  {"collisions", run.collisions},
                  {"compressibility", z.mean},
                  {"compressibility_error", z.error},
                  {"diffusion", run.diffusion.value},
                  {"diffusion_error", run.diffusion.error},
                  {"rotational_diffusion", run.rotational_diffusion.value},
                  {"rotational_diffusion_error", run.rotational_diffusion.error}};
  if (run.glass) summary.update(glass_summary(*run.glass));
  return summary;
}

PageProvenance provenance_rows(const Provenance& provenance) {
  return {{"version", provenance.version},
          {"commit", provenance.commit},
          {"command_line", provenance.command_line},
          {"host", provenance.host},
          {"seed", std::to_string(provenance.seed)},
          {"parent", provenance.parent},
          {"started", provenance.started},
          {"wall_seconds", fmt::format("{:.1f}", provenance.wall_seconds)}};
}

std::string particles_text(const Configuration2& state) {
  if (state.species_names.size() > 1) {
    std::string names;
    for (const std::string& name : state.species_names) names += (names.empty() ? "" : ", ") + name;
    return "particles of species " + names;
  }
  const double ratio = state.shape.front().aspect_ratio();
  for (const Ellipse& shape : state.shape)
    if (std::abs(shape.aspect_ratio() - ratio) > 1e-9 * ratio) return "ellipses of several shapes";
  return ratio == 1 ? "disks" : fmt::format("ellipses, κ = {:.4g}", ratio);
}

ReportData report_data(const std::vector<RunAnalysis>& runs, const std::string& title) {
  ReportData data;
  data.title = title;
  const RunAnalysis& first = runs.front();
  data.subtitle = fmt::format("{} {}{}{}", first.particles, particles_text(first.final_state),
                              first.parameters ? ", " : "", dynamics_text(first.parameters));
  data.parameters = first.provenance.parameters;
  data.provenance = provenance_rows(first.provenance);
  const std::vector<std::size_t> poses = movie_poses(runs);
  for (std::size_t k = 0; k < runs.size(); ++k) data.runs.push_back(report_run(runs[k], poses[k]));
  if (runs.size() > 1) data.study = results_of_sweep(runs);
  return data;
}

}  // namespace vitrel
