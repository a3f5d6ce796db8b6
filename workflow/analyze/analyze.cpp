#include "workflow/analyze/analyze.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

#include "analysis/observables/energy_tables.h"
#include "analysis/observables/observable.h"
#include "core/error.h"
#include "core/io/json.h"
#include "core/whole_number.h"
#include "workflow/analyze/glass_report.h"
#include "workflow/analyze/glass_tables.h"
#include "workflow/analyze/relaxation_tables.h"
#include "workflow/analyze/run_analysis.h"
#include "workflow/configuration/sections.h"
#include "workflow/configuration/start_state.h"
#include "workflow/run/correlations_file.h"

namespace vitrel {
namespace {

// Provenance keys of the results that say by what program and with which parameters they were computed.
constexpr const char* analysis_key = "analysis_parameters";
constexpr const char* analyzer_key = "analysed_by";
const std::string import_prefix = "import: ";

std::string analyzer() {
  return program_version() + " " + program_commit();
}

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

/// The names of species become names of tables if there are two or more species.
void require_own_names(const TrajectoryReader& reader) {
  if (reader.species_names().size() < 2) return;
  if (const auto conflict = species_name_conflict(reader.species_names()))
    throw FileError(fmt::format("{}: the name of species {} {}", reader.path().string(),
                                conflict->species, conflict->complaint));
}

/// Correlations of odd order change sign with the director, whose sign has no meaning.
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

/// Names the file in the message of a UserError that `work` throws.
auto naming(const std::filesystem::path& file, auto&& work) {
  try {
    return work();
  } catch (const UserError& error) {
    throw UserError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

Column single(const std::string& name, const std::string& unit, double value, double error) {
  return {name, unit, {value}, {error}};
}

/// Adds a coefficient and the window of times over which it was fitted.
void add_slope(std::vector<Column>& columns, const std::string& name, const std::string& unit,
               const DiffusionCoefficient& slope) {
  columns.push_back(single(name, unit, slope.value, slope.error));
  columns.push_back({name + "_from", "time", {slope.from}});
  columns.push_back({name + "_to", "time", {slope.to}});
}

std::vector<Column> summary_columns(const RunAnalysis& run) {
  const Estimate translational = time_average(run.energy.time, run.energy.translational);
  const Estimate rotational = time_average(run.energy.time, run.energy.rotational);
  const Estimate& z = run.compressibility.mean;
  std::vector<Column> columns{
      {"packing_fraction", "1", {run.packing_fraction}},
      {"particles", "1", {static_cast<double>(run.particles)}},
      {"rotors", "1", {static_cast<double>(run.rotors)}},
      {"rotations", "1", {static_cast<double>(run.rotations)}},
      {"frames", "1", {static_cast<double>(run.frames)}},
      {"collisions", "1", {run.collisions}},
      {"duration", "time", {run.duration}},
      single("compressibility_factor", "1", z.mean, z.error),
      single("translational_energy", "kT", translational.mean, translational.error),
      single("rotational_energy", "kT", rotational.mean, rotational.error)};
  add_slope(columns, "diffusion", "length^2/time", run.diffusion);
  add_slope(columns, "rotational_diffusion", "rad^2/time", run.rotational_diffusion);
  if (run.motion && run.motion->viscosity)
    add_slope(columns, "viscosity", fmt::format("kT time/length^{}", run.motion->dimension),
              run.motion->viscosity->shear);
  for (const Table& table : run.structure.tables)
    if (const Column* hexatic = table.name == "order" ? table.find("hexatic") : nullptr) {
      const Estimate mean = time_average(table.find("time")->value, hexatic->value);
      columns.push_back(single("hexatic_order", "1", mean.mean, mean.error));
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

/// Removes tables that were computed only because others need them. The summary always stays, and so do tables of the
/// numbers that index the columns of a chosen table, such as wave numbers.
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

/// Adds what follows from the motion between frames, apart from the tables that results_of has already filled.
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

/// The folder stands beside the file and has its name without the extension.
std::filesystem::path csv_folder(const std::filesystem::path& results) {
  if (!results.has_extension()) return results.string() + "_tables";
  return std::filesystem::path(results).replace_extension();
}

std::filesystem::path csv_file(const std::filesystem::path& results, const std::string& table) {
  return csv_folder(results) / (table + ".csv");
}

/// Puts the names of units that a file of another program states into the columns of its tables.
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

/// The analysis of a run of this dimension.
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
  const RunAnalysis run = naming(file, [&] {
    return run_analysis(trajectory, analysed.name(), parameters, wanted, progress);
  });
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
  const bool in_job_folder =
      file.has_parent_path() &&
      (file.filename() == "run.h5" || std::filesystem::exists(file.parent_path() / "params.json"));
  if (!in_job_folder) return file.stem().string();
  return std::filesystem::absolute(file).lexically_normal().parent_path().filename().string();
}

double AnalysedRun::packing_fraction() const {
  return results.find("summary")->find("packing_fraction")->value.front();
}

std::uint64_t AnalysedRun::seed() const {
  const std::string seed = results.text("seed");
  return std::strtoull(seed.c_str(), nullptr, 10);  // 0 if the text is no number
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
    // The file is not one that vitrel wrote, which is refused below.
  }
  // A file of correlations on the fly has such tables too, but no analysis could restore it, so it is not
  // overwritten.
  const bool is_analysis = std::ranges::any_of(
      tables, [](const std::string& name) { return name == "summary" || name == "runs"; });
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
  // Files of other programs have no seed.
  if (run.results.text("seed").empty()) summary.erase("seed");
  return summary;
}

std::vector<std::pair<std::string, std::string>> provenance_rows(const Provenance& provenance) {
  if (provenance.version.empty()) return {};  // the file comes from another program
  std::vector<std::pair<std::string, std::string>> rows = {
      {"version", provenance.version},
      {"commit", provenance.commit},
      {"command_line", provenance.command_line},
      {"host", provenance.host},
      {"seed", std::to_string(provenance.seed)},
      {"parent", provenance.parent},
      {"started", provenance.started},
      {"wall_seconds", fmt::format("{:.1f}", provenance.wall_seconds)}};
  if (!provenance.model.empty()) rows.emplace_back("model", provenance.model);
  return rows;
}

}  // namespace vitrel
