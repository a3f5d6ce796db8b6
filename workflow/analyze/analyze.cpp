#include "workflow/analyze/analyze.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

#include "analysis/dynamics/four_point.h"
#include "analysis/dynamics/time_axis.h"
#include "analysis/dynamics/van_hove.h"
#include "analysis/glass/glass_data.h"
#include "analysis/observables/dynamics_tables.h"
#include "analysis/observables/energy_tables.h"
#include "analysis/observables/frame_observable.h"
#include "analysis/observables/motion_tables.h"
#include "analysis/observables/observable.h"
#include "analysis/structure/orientation_tensor.h"
#include "core/error.h"
#include "core/io/json.h"
#include "core/special_values.h"
#include "core/whole_number.h"
#include "workflow/analyze/glass_report.h"
#include "workflow/analyze/glass_tables.h"
#include "workflow/analyze/relaxation_tables.h"
#include "workflow/configuration/hard_contacts.h"
#include "workflow/configuration/parameters.h"
#include "workflow/configuration/species_names.h"
#include "workflow/configuration/start_state.h"
#include "workflow/run/correlations_file.h"
#include "workflow/storage/trajectory_file.h"

namespace vitrel {
namespace {

// By whom and how results were computed, in their provenance.
constexpr const char* analysis_key = "analysis_parameters";
constexpr const char* analyzer_key = "analysed_by";
const std::string import_prefix = "import: ";

std::string analyzer() {
  return program_version() + " " + program_commit();
}

/// All that is measured, before it is put into tables.
struct RunAnalysis {
  std::size_t particles, rotors, rotations, frames;
  double packing_fraction, duration, collisions;
  std::vector<Column> state;            ///< of the last frame, for the summary
  std::string obstacle;                 ///< to saying anything about motion, if there is one
  std::optional<RunDynamics> dynamics;  ///< otherwise
  std::optional<RunMotion> motion;      ///< likewise
  EnergySeries energy;
  CompressibilitySeries compressibility;
  DiffusionCoefficient diffusion, rotational_diffusion;  ///< of all particles
  FrameResults structure;
  std::optional<GlassRun> glass;
};

/// A run and the parameters of its analysis.
struct OpenRun {
  TrajectoryReader reader;
  Parameters parameters;
};

OpenRun open_run(const std::filesystem::path& file, const AnalysisChoice& choice) {
  TrajectoryReader reader(file, known_system(choice));
  if (choice.parameters)
    return {std::move(reader), load_parameters({*choice.parameters, choice.overrides})};
  const std::string recorded = reader.provenance().parameters;
  return {std::move(reader), parse_parameters(recorded, file.string(), choice.overrides)};
}

/// Tables of files with one species are not called after it.
void require_own_names(const TrajectoryReader& reader) {
  if (reader.species_names().size() < 2) return;
  if (const auto conflict = species_name_conflict(reader.species_names()))
    throw FileError(fmt::format("{}: the name of species {} {}", reader.path().string(),
                                conflict->species, conflict->complaint));
}

/// Correlations of odd order change their sign with the director, whose sign means nothing.
void require_orders_of_directors(const TrajectoryReader& reader,
                                 const DisplacementOptions& analysis) {
  if (!reader.angles_are_directors()) return;
  for (const double n : analysis.orders)
    if (n != 2 * std::floor(n / 2))
      throw UserError(
          fmt::format("{}: analysis.orders has {}, but should be even: its angles are "
                      "those of directors (import.angles)",
                      reader.path().string(), n));
}

/// The file becomes part of the message where it cannot be analysed as it was asked for.
template <class Work>
auto naming(const std::filesystem::path& file, Work&& work) {
  try {
    return work();
  } catch (const UserError& error) {
    throw UserError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

void begin(const AnalysisProgress& progress, const char* phase) {
  if (progress.begin) progress.begin(phase);
}

/// Whether tables are asked for that need more than single frames.
bool wants_motion(const TableChoice& wanted) {
  return wanted.has({"summary", "displacements", "self_scattering", "orientation", "cage_relative",
                     "collective_scattering", "wave_numbers", "susceptibility", "ageing",
                     "waiting_times", "relaxation", "relaxation_times", "viscosity"});
}

/// The short part first: it refuses wave numbers that do not fit into the box.
template <int Dim>
RunDynamics measure_dynamics(TrajectoryFile<Dim>& trajectory, DisplacementOptions options,
                             const TableChoice& wanted, const AnalysisProgress& progress) {
  options.wave_numbers = wave_numbers_or_main(std::move(options.wave_numbers), trajectory.read(0));
  options.parts = {
      .displacement = wanted.has({"displacements", "summary", "relaxation", "viscosity"}),
      .scattering = wanted.has({"self_scattering", "relaxation_times", "relaxation"}),
      .orientation = wanted.has({"orientation", "relaxation_times", "relaxation"}),
      .overlap = wanted.has({"susceptibility"})};
  RunDynamics dynamics;
  if (wanted.has({"collective_scattering", "wave_numbers"})) {
    begin(progress, "collective scattering");
    dynamics.collective = collective_scattering(trajectory, options.wave_numbers, options.axis,
                                                progress.report, options.threads);
  }
  if constexpr (Dim == 2)
    if (wanted.has({"cage_relative", "relaxation_times", "relaxation"})) {
      begin(progress, "cage-relative displacements");
      dynamics.cage_relative = cage_relative(trajectory, options, progress.report);
    }
  begin(progress, "displacements");
  dynamics.displacements = displacements(trajectory, options, progress.report);
  if (!options.waiting_times.empty() && wanted.has({"ageing", "waiting_times"})) {
    begin(progress, "ageing");
    dynamics.ageing = ageing(trajectory, options, progress.report);
  }
  return dynamics;
}

/// What else there is of the motion between frames.
template <int Dim>
RunMotion measure_motion(TrajectoryFile<Dim>& trajectory, const Parameters& parameters,
                         const TableChoice& wanted, const AnalysisProgress& progress) {
  RunMotion motion{.dimension = Dim};
  if (wanted.has({"velocity_autocorrelation", "velocity_spectrum"}) &&
      mechanics(trajectory.read(0)).translational_energy > 0) {
    begin(progress, "velocities");
    motion.velocities = velocity_correlations(trajectory, parameters.analysis, progress.report);
  }
  if (!wanted.has({"van_hove_self", "van_hove_distinct", "four_point_structure"})) return motion;
  begin(progress, "functions of two times");
  const Configuration<Dim> first = trajectory.read(0);
  const DisplacementOptions& options = parameters.analysis;
  const PairCorrelationOptions& pairs = parameters.structure.pairs;
  TimeAxisOptions axis = options.axis;
  axis.max_origins = std::min(axis.max_origins, origins_for(first.size(), few_origins));
  motion.lags = few_lags_of_motion(trajectory, axis);
  motion.two_times = average_two_times<Dim>(
      trajectory, motion.lags,
      {van_hove_self<Dim>(pairs), van_hove_distinct(first, motion.lags, pairs),
       four_point_structure(first.box, options.overlap_distance)},
      progress.report, options.threads);
  return motion;
}

/// Of a mean squared displacement or rotation in so many dimensions.
DiffusionCoefficient long_time_diffusion(const Displacements& found, const Correlation& square,
                                         int dimension, const std::vector<double>& times) {
  const double duration = evenly_spaced(times) ? times.back() - times.front() : 0;
  return diffusion_coefficient({found.lag, square.value, square.error, duration}, dimension);
}

DiffusionCoefficient no_diffusion(const char* reason) {
  return {unknown, unknown, unknown, unknown, reason};
}

/// NaN if the file does not say.
double collisions_between_frames(const TrajectoryReader& reader) {
  if (!reader.has_observable("collisions")) return unknown;
  const std::vector<double> collisions = reader.observable("collisions");
  return collisions.back() - collisions.front();
}

/// Judged, if the run can be.
template <int Dim>
std::optional<GlassRun> measure_glass(TrajectoryFile<Dim>& trajectory, const std::string& name,
                                      const RunAnalysis& run, const Parameters& parameters,
                                      const AnalysisProgress& progress) {
  const auto& cage = run.dynamics->cage_relative;
  const GlassSource source{.name = name,
                           .seed = trajectory.reader().provenance().seed,
                           .packing_fraction = run.packing_fraction,
                           .rotors = run.rotors,
                           .starts_in_equilibrium = end_in_equilibrium(parameters.stages),
                           .displacements = run.dynamics->displacements,
                           .cage_relative = cage ? &*cage : nullptr,
                           .compressibility = run.compressibility,
                           .order = run.structure.order,
                           .diffusion = run.diffusion,
                           .rotational_diffusion = run.rotational_diffusion};
  begin(progress, "relaxation and halves");
  const auto data = glass_run_data(trajectory, source, parameters.analysis, progress.report);
  if (!data) return std::nullopt;
  return judge_glass_run(*data);
}

/// A time in which the stress decays: particles have moved by a unit of length, which in a liquid is out of their
/// cages, and have collided ten times each.
double stress_relaxation_time(const RunAnalysis& run) {
  const Displacements& found = run.dynamics->displacements;
  const std::vector<double>& square = found.groups.front().translation.value;
  const auto moved = std::ranges::find_if(square, [](double value) { return value >= 1; });
  if (moved == square.end()) return unknown;
  const double ten_collisions =
      5 * static_cast<double>(run.particles) * run.duration / run.collisions;
  return std::max(found.lag[static_cast<std::size_t>(moved - square.begin())], ten_collisions);
}

template <int Dim>
std::optional<Viscosity> measure_viscosity(TrajectoryFile<Dim>& trajectory, const RunAnalysis& run,
                                           const TimeAxisOptions& axis) {
  const auto moments = helfand_moments(trajectory.reader());
  if (moments.empty()) return std::nullopt;
  const Configuration<Dim>& state = trajectory.read(0);
  const double temperature = mean_temperature(run.energy, run.particles, run.rotations, Dim);
  return shear_viscosity(trajectory.times(), moments,
                         {state.box.volume(), temperature, stress_relaxation_time(run)}, axis);
}

DiffusionCoefficient rotational_diffusion(const Displacements& found, std::size_t rotors,
                                          int dimension, const std::vector<double>& times) {
  if (rotors == 0) return no_diffusion("no particle can turn");
  if (!found.unknown_turns.empty()) return no_diffusion(found.unknown_turns.c_str());
  // Of bodies of revolution ⟨|Δφ|²⟩ = 4 D_r t: they do not spin about their axes.
  const int rotations = dimension == 2 ? 1 : found.axes == 3 ? 3 : 2;
  return long_time_diffusion(found, found.groups.front().rotation, rotations, times);
}

/// What of a single configuration stands in the summary, in space.
std::vector<Column> state_columns(const Configuration2&) {
  return {};
}

std::vector<Column> state_columns(const Configuration3& state) {
  const OrientationTensor tensor = orientation_tensor(state);
  const IsotropicRatio isotropic = isotropic_ratio(tensor.axes);
  const Vec3& box = state.box.lengths();
  return {{"box_x", "length", {box.x()}, {}},
          {"box_y", "length", {box.y()}, {}},
          {"box_z", "length", {box.z()}, {}},
          {"orientation_ratio", "1", {tensor.ratio()}, {}},
          {"isotropic_ratio", "1", {isotropic.mean}, {}},
          {"isotropic_ratio_deviation", "1", {isotropic.standard_deviation}, {}}};
}

/// Smooth, if the file does not say.
Contacts recorded_contacts(const TrajectoryReader& reader) {
  const std::string recorded = reader.provenance().parameters;
  if (recorded.empty()) return Contacts::smooth;
  return contacts_of(recorded_parameters(recorded, reader.path().string()).dynamics);
}

template <int Dim>
void describe_run(RunAnalysis& run, TrajectoryFile<Dim>& trajectory) {
  const std::vector<double>& times = trajectory.times();
  const Configuration<Dim>& state = trajectory.read(trajectory.frames() - 1);
  run.particles = state.size();
  run.rotors = rotor_count(state);
  run.rotations = rotation_count(state, recorded_contacts(trajectory.reader()));
  run.packing_fraction = packing_fraction(state);
  run.state = state_columns(state);
  run.frames = trajectory.frames();
  run.duration = times.back() - times.front();
  run.collisions = collisions_between_frames(trajectory.reader());
}

template <int Dim>
RunAnalysis measure(TrajectoryFile<Dim>& trajectory, const std::string& name,
                    const Parameters& parameters, const TableChoice& wanted,
                    const AnalysisProgress& progress) {
  const TrajectoryReader& reader = trajectory.reader();
  const std::vector<double>& times = trajectory.times();
  RunAnalysis run{};
  describe_run(run, trajectory);
  run.obstacle = reader.obstacle_to_motion();
  if (run.obstacle.empty() && !reader.doubtful_frames().empty() &&
      time_axis_of_motion(trajectory).empty())
    run.obstacle =
        "between any two frames some particle moved by more than a quarter of a box length, so "
        "that "
        "its box crossings are in doubt";
  if (run.obstacle.empty() && wants_motion(wanted))
    run.dynamics = measure_dynamics(trajectory, parameters.analysis, wanted, progress);
  if (run.obstacle.empty()) run.motion = measure_motion(trajectory, parameters, wanted, progress);
  begin(progress, "structure");
  std::vector<std::string> of_frames = wanted.tables();
  if (!of_frames.empty() && wanted.has({"relaxation"})) of_frames.emplace_back("order");
  run.structure =
      measure_frames(trajectory, parameters.structure, all_cores, progress.report, of_frames);
  if (wanted.has({"energies", "compressibility_factor", "summary", "relaxation", "viscosity"}))
    run.energy = stored_energies(trajectory);
  run.compressibility = stored_compressibility(reader, run.energy, run.rotations);
  run.diffusion = run.rotational_diffusion = no_diffusion(run.obstacle.c_str());
  if (!run.dynamics || !run.dynamics->displacements.parts.displacement) return run;
  const Displacements& found = run.dynamics->displacements;
  run.diffusion = long_time_diffusion(found, found.groups.front().translation, Dim, times);
  run.rotational_diffusion = rotational_diffusion(found, run.rotors, Dim, times);
  if (wanted.has({"viscosity", "summary"}))
    run.motion->viscosity = measure_viscosity(trajectory, run, parameters.analysis.axis);
  if (wanted.has({"relaxation"}))
    run.glass = measure_glass(trajectory, name, run, parameters, progress);
  return run;
}

Column single(const char* name, const std::string& unit, double value, double error) {
  return {name, unit, {value}, {error}};
}

std::vector<Column> summary_columns(const RunAnalysis& run) {
  const Estimate translational = time_average(run.energy.time, run.energy.translational);
  const Estimate rotational = time_average(run.energy.time, run.energy.rotational);
  const Estimate& z = run.compressibility.mean;
  std::vector<Column> columns{
      {"packing_fraction", "1", {run.packing_fraction}, {}},
      {"particles", "1", {static_cast<double>(run.particles)}, {}},
      {"rotors", "1", {static_cast<double>(run.rotors)}, {}},
      {"rotations", "1", {static_cast<double>(run.rotations)}, {}},
      {"frames", "1", {static_cast<double>(run.frames)}, {}},
      {"collisions", "1", {run.collisions}, {}},
      {"duration", "time", {run.duration}, {}},
      single("compressibility_factor", "1", z.mean, z.error),
      single("translational_energy", "kT", translational.mean, translational.error),
      single("rotational_energy", "kT", rotational.mean, rotational.error),
      single("diffusion", "length^2/time", run.diffusion.value, run.diffusion.error),
      {"diffusion_from", "time", {run.diffusion.from}, {}},
      {"diffusion_to", "time", {run.diffusion.to}, {}},
      single("rotational_diffusion", "rad^2/time", run.rotational_diffusion.value,
             run.rotational_diffusion.error),
      {"rotational_diffusion_from", "time", {run.rotational_diffusion.from}, {}},
      {"rotational_diffusion_to", "time", {run.rotational_diffusion.to}, {}}};
  if (run.motion && run.motion->viscosity) {
    const Viscosity::Slope& viscosity = run.motion->viscosity->shear;
    columns.push_back(single("viscosity", fmt::format("kT time/length^{}", run.motion->dimension),
                             viscosity.value, viscosity.error));
    columns.push_back({"viscosity_from", "time", {viscosity.from}, {}});
    columns.push_back({"viscosity_to", "time", {viscosity.to}, {}});
  }
  columns.insert(columns.end(), run.state.begin(), run.state.end());
  return columns;
}

void append(std::vector<Table>& all, std::vector<Table> more) {
  std::ranges::move(more, std::back_inserter(all));
}

Results results_of(const RunAnalysis& run) {
  Results results;
  results.tables.push_back({"summary", "Averages over the run.", summary_columns(run)});
  if (run.dynamics) append(results.tables, dynamics_tables(*run.dynamics));
  if (run.motion) append(results.tables, motion_tables(*run.motion));
  append(results.tables, energy_tables(run.energy, run.compressibility));
  append(results.tables, run.structure.tables);
  return results;
}

constexpr const char* no_energies =
    "the file has neither velocities nor the observables translational_energy and "
    "rotational_energy";

void leave_out(Results& results, const std::string& what, const std::string& why) {
  results.provenance.emplace_back("left_out_" + what, why);
}

/// Some tables are measured for the sake of others. The summary is always there, and so are the numbers that columns of
/// other tables are counted by, such as wave numbers.
void keep_wanted(Results& results, const TableChoice& wanted, int dimension) {
  const std::vector<Observable> all = observables(dimension);
  const auto is_counted_by = [](const Observable& other, const std::string& name) {
    return std::ranges::any_of(other.charts,
                               [&](const Chart& chart) { return chart.numbers.table == name; });
  };
  std::erase_if(results.tables, [&](const Table& table) {
    const Observable* observable = find(all, table.name);
    if (table.name == "summary" || !observable) return false;
    return std::ranges::none_of(all, [&](const Observable& other) {
      return wanted.has({other.table}) &&
             (&other == observable || is_counted_by(other, table.name));
    });
  });
}

/// What there is of more than one frame, besides tables.
void add_motion(const RunAnalysis& run, const TableChoice& wanted, const std::vector<double>& times,
                Results& results) {
  const Displacements& found = run.dynamics->displacements;
  results.provenance.emplace_back("time_axis", time_axis_text(times, found));
  const auto& cage = run.dynamics->cage_relative;
  if (wanted.has({"relaxation_times"}))
    store_relaxation_times(found, cage ? &*cage : nullptr, results);
  if (found.dimension == 2 && !cage && wanted.has({"cage_relative"}))
    leave_out(results, "cage_relative", "analysis.memory is too small for all positions at once");
  if (!found.unknown_turns.empty()) leave_out(results, "rotations", found.unknown_turns);
  if (run.glass)
    store_glass_run(*run.glass, results);
  else if (wanted.has({"relaxation"}))
    results.provenance.emplace_back(
        "not_judged", "equilibration and relaxation: the samples are not evenly spaced in time");
}

/// Beside the file, with its name.
std::filesystem::path csv_folder(const std::filesystem::path& results) {
  if (!results.has_extension()) return results.string() + "_tables";
  return std::filesystem::path(results).replace_extension();
}

std::filesystem::path csv_file(const std::filesystem::path& results, const std::string& table) {
  return csv_folder(results) / (table + ".csv");
}

/// Names the units of a file of another program in the columns of its tables.
void put_into_units(Results& results, const FileUnits& units) {
  const auto put = [](std::string& unit, const std::string& quantity, const std::string& name) {
    if (const std::size_t place = unit.find(quantity); place != std::string::npos)
      unit.replace(place, quantity.size(), name);
  };
  for (Table& table : results.tables)
    for (Column& column : table.columns) {
      put(column.unit, "length", units.length);
      put(column.unit, "time", units.time);
    }
}

/// Of a run of this dimension.
template <int Dim>
AnalysedRun analyze(OpenRun opened, const AnalysisProgress& progress) {
  const std::filesystem::path file = opened.reader.path();
  const Parameters& parameters = opened.parameters;
  AnalysedRun analysed{file, {}};
  TrajectoryFile<Dim> trajectory(std::move(opened.reader));
  const TrajectoryReader& reader = trajectory.reader();
  if (trajectory.frames() == 0)
    throw UserError(file.string() + ": has no frames yet; continue the run");
  require_own_names(reader);
  require_orders_of_directors(reader, parameters.analysis);
  const TableChoice wanted(parameters.only);
  const RunAnalysis run = naming(
      file, [&] { return measure(trajectory, analysed.name(), parameters, wanted, progress); });
  Results& results = analysed.results = results_of(run);
  append(results.tables, on_the_fly_tables(file));
  results.provenance = provenance_rows(reader.provenance());
  results.provenance.emplace_back("source", file.string());
  results.provenance.emplace_back(analysis_key, effective_parameters(parameters));
  results.provenance.emplace_back(analyzer_key, analyzer());
  for (const auto& [heading, text] : reader.import_report())
    results.provenance.emplace_back(import_prefix + heading, text);
  if (run.dynamics)
    add_motion(run, wanted, trajectory.times(), results);
  else if (run.frames > 1 && !run.obstacle.empty())
    leave_out(results, "motion", run.obstacle);
  if (run.motion && run.motion->viscosity && !run.motion->viscosity->shear.reason.empty())
    leave_out(results, "viscosity", run.motion->viscosity->shear.reason);
  if (run.energy.time.empty() && wanted.has({"energies"}))
    leave_out(results, "energies", no_energies);
  keep_wanted(results, wanted, Dim);
  if (const auto& units = reader.units()) put_into_units(results, *units);
  analysed.glass = run.glass;
  return analysed;
}

AnalysedRun analyze(OpenRun opened, const AnalysisProgress& progress) {
  const bool is_plane = opened.reader.dimension() == 2;
  return (is_plane ? analyze<2> : analyze<3>)(std::move(opened), progress);
}

}  // namespace

KnownSystem known_system(const AnalysisChoice& choice) {
  return known_system(choice.parameters ? load_parameters({*choice.parameters, choice.overrides})
                                        : parse_parameters("", "command line", choice.overrides));
}

Json import_json(const ImportReport& report) {
  Json json = Json::object();
  for (const auto& [heading, text] : report) json[heading] = text;
  return json;
}

ImportReport import_report(const Results& results) {
  ImportReport report;
  for (const auto& [key, text] : results.provenance)
    if (key.starts_with(import_prefix)) report.emplace_back(key.substr(import_prefix.size()), text);
  return report;
}

std::string AnalysedRun::name() const {
  const bool in_job_folder = file.filename() == "run.h5" && file.has_parent_path();
  if (!in_job_folder) return file.stem().string();
  return std::filesystem::absolute(file).lexically_normal().parent_path().filename().string();
}

double AnalysedRun::packing_fraction() const {
  return results.find("summary")->find("packing_fraction")->value.front();
}

std::uint64_t AnalysedRun::seed() const {
  const std::string seed = results.text("seed");
  return std::strtoull(seed.c_str(), nullptr, 10);  // 0 of a text that is no number
}

AnalysedRun analyze_run(const std::filesystem::path& file, const AnalysisChoice& choice,
                        const AnalysisProgress& progress) {
  return analyze(open_run(file, choice), progress);
}

std::filesystem::path results_path(const std::filesystem::path& run) {
  return run.parent_path() / (run.stem().string() + "_results.h5");
}

AnalysedRun stored_analysis(const std::filesystem::path& run,
                            const std::filesystem::path& results) {
  AnalysedRun stored{run, read_results(results)};
  stored.glass = stored_glass_run(stored.name(), stored.results);
  return stored;
}

AnalysedRun stored_or_analyzed(const std::filesystem::path& file, const AnalysisChoice& choice,
                               const AnalysisProgress& progress) {
  namespace fs = std::filesystem;
  const fs::path results = results_path(file);
  if (!fs::exists(results) || fs::last_write_time(results) < fs::last_write_time(file))
    return analyze_run(file, choice, progress);
  AnalysedRun stored;
  try {
    stored = stored_analysis(file, results);
  } catch (const FileError&) {
    return analyze_run(file, choice, progress);
  }
  OpenRun opened = open_run(file, choice);
  const std::string parameters = effective_parameters(opened.parameters);
  const bool is_up_to_date = stored.results.text(analyzer_key) == analyzer() &&
                             stored.results.text(analysis_key) == parameters;
  return is_up_to_date ? stored : analyze(std::move(opened), progress);
}

std::vector<std::string> former_tables(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return {};
  std::vector<std::string> tables;
  try {
    tables = stored_tables(file);
  } catch (const FileError&) {
    // no file of ours
  }
  // Correlations on the fly are tables in such a file, too, but nothing can make them again.
  const bool is_analysis = std::any_of(tables.begin(), tables.end(), [](const std::string& name) {
    return name == "summary" || name == "runs";
  });
  if (!is_analysis)
    throw UserError(file.string() +
                    ": exists and holds no results of vitrel analyze, which are all that it "
                    "overwrites; choose another output, or delete it");
  return tables;
}

void write_all(const std::filesystem::path& file, const Results& results) {
  for (const std::string& table : former_tables(file))
    if (!results.find(table)) std::filesystem::remove(csv_file(file, table));
  write_results(file, results);
  write_csv_folder(csv_folder(file), results);
}

Json analysis_summary(const AnalysedRun& run) {
  Json summary = {{"file", run.file.string()}};
  if (const ImportReport report = import_report(run.results); !report.empty())
    summary["import"] = import_json(report);
  for (const Column& column : run.results.find("summary")->columns) {
    const double value = column.value.front();
    const bool may_count = column.error.empty() && column.unit == "1";
    const auto count = may_count ? whole_number<std::uint64_t>(value) : std::nullopt;
    summary[column.name] = count ? Json(*count) : Json(value);
    if (!column.error.empty()) summary[column.name + "_error"] = column.error.front();
  }
  if (run.glass) summary.update(glass_summary(*run.glass));
  if (run.results.text("seed").empty()) summary.erase("seed");  // of another program
  return summary;
}

std::vector<std::pair<std::string, std::string>> provenance_rows(const Provenance& provenance) {
  if (provenance.version.empty()) return {};  // of another program
  return {{"version", provenance.version},
          {"commit", provenance.commit},
          {"command_line", provenance.command_line},
          {"host", provenance.host},
          {"seed", std::to_string(provenance.seed)},
          {"parent", provenance.parent},
          {"started", provenance.started},
          {"wall_seconds", fmt::format("{:.1f}", provenance.wall_seconds)}};
}

}  // namespace vitrel
