#include "workflow/configuration/parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "edmd/sampling.h"
#include "workflow/configuration/hard_contacts.h"
#include "workflow/configuration/sections.h"

namespace vitrel {
namespace {

using Style = FieldVisitor::TableStyle;

using CommandSections = std::pair<std::string, Sections>;
const CommandSections command_sections[] = {{"prepare", {true, true, false, false, false}},
                                            {"run", {true, true, true, false, false}},
                                            {"analyze", {false, false, false, true, false}},
                                            {"sweep", {true, true, true, true, true}}};

void collect_places(const TomlNode& node, const std::string& key,
                    std::map<std::string, std::string>& places) {
  const auto below = [&](const std::string& part) { return key.empty() ? part : key + "." + part; };
  if (const auto* table = node.get<TomlNode::Table>()) {
    for (const TomlEntry& entry : *table) collect_places(entry.node, below(entry.key), places);
  } else if (const auto* array = node.get<TomlNode::Array>()) {
    for (std::size_t k = 0; k < array->size(); ++k)
      collect_places((*array)[k], below(std::to_string(k)), places);
  } else {
    places[key] = node.where;
  }
}

Parameters read(const TomlNode& root) {
  Parameters parameters;
  collect_places(root, "", parameters.given);
  read_parameters(root, fields(parameters), [&] {
    // Correlations on the fly measure the relaxation times that end the run.
    if (parameters.dynamics.relaxation_times && !parameters.output.correlations)
      parameters.output.correlations.emplace();
    validate(parameters);
  });
  return parameters;
}

/// Finds the value of a key in a table. Returns null if the table has no such key, or if the node is no table.
TomlNode* find(TomlNode* node, const std::string& key) {
  auto* entries = node ? node->get<TomlNode::Table>() : nullptr;
  if (!entries) return nullptr;
  const auto found = std::ranges::find(*entries, key, &TomlEntry::key);
  return found == entries->end() ? nullptr : &found->node;
}

/// Finds the value of a key as above, and adds the key with this value to the table if it is missing.
TomlNode* find_or_make(TomlNode* node, const std::string& key, const TomlNode& value) {
  auto* entries = node ? node->get<TomlNode::Table>() : nullptr;
  if (entries && !find(node, key)) entries->push_back({key, value.where, value});
  return find(node, key);
}

/// A stage without a method has the default method, which places particles.
bool places_particles(const TomlNode& stage) {
  const TomlEntry* method = stage.find("method");
  const std::string* name = method ? method->node.get<std::string>() : nullptr;
  return !name || vitrel::places_particles(*name);
}

/// Whether the last of the stages that change the packing fraction ends at a pressure.
bool end_at_a_pressure(const TomlNode::Array& stages) {
  for (auto found = stages.rbegin(); found != stages.rend(); ++found) {
    const TomlNode& stage = *found;
    const auto has = [&](const char* key) { return stage.find(key) != nullptr; };
    if (has("reduced_pressure")) return true;
    if (has("packing_fraction")) return false;
    const TomlEntry* method = stage.find("method");
    const std::string* name = method ? method->node.get<std::string>() : nullptr;
    if (!name || *name != SampleStage::method) return name && *name == CompressStage::method;
  }
  return false;
}

/// A state that was prepared up to a pressure has a packing fraction of its own, so that of the parameters is
/// dropped.
void forget_packing_fraction(TomlNode& root) {
  TomlNode* system = find(&root, "system");
  if (auto* entries = system ? system->get<TomlNode::Table>() : nullptr)
    std::erase_if(*entries, [](const TomlEntry& entry) { return entry.key == "packing_fraction"; });
}

void apply_start(TomlNode& root, const StartFile& start) {
  const std::string where = "--from " + start.file.string();
  TomlNode* prepare = find_or_make(&root, "prepare", {TomlNode::Table(), where});
  TomlNode* list = find_or_make(prepare, "stage", {TomlNode::Array(), where});
  auto* stages = list ? list->get<TomlNode::Array>() : nullptr;
  if (!stages) return;  // reading the parameters refuses it
  if (end_at_a_pressure(*stages) && !start.keeps_moves) forget_packing_fraction(root);
  if (!stages->empty() && places_particles(stages->front()))
    stages->erase(stages->begin(), start.keeps_moves ? stages->begin() + 1 : stages->end());
  const auto text = [&](const char* key, const std::string& value) {
    return TomlEntry{key, where, {value, where}};
  };
  TomlNode::Table table = {text("method", StateStage::method), text("file", start.file.string())};
  if (start.shrink) table.push_back(text("on_overlap", "shrink"));
  stages->insert(stages->begin(), {std::move(table), where});
}

/// The document names files relative to its own folder.
void resolve_state_files(TomlNode& root, const std::filesystem::path& folder) {
  TomlNode* list = find(find(&root, "prepare"), "stage");
  auto* stages = list ? list->get<TomlNode::Array>() : nullptr;
  if (!stages) return;
  for (TomlNode& stage : *stages) {
    TomlNode* file = find(&stage, "file");
    std::string* name = file ? file->get<std::string>() : nullptr;
    if (name) *name = (folder / *name).lexically_normal().string();
  }
}

void apply(TomlNode& root, const std::vector<std::string>& overrides) {
  for (const std::string& assignment : overrides)
    apply_override(root, assignment, "--set " + assignment);
}

}  // namespace

Parameters::Parameters() : species{default_species()}, stages{InsertStage(), GrowStage()} {}

FieldVisitor::Inside fields(Parameters& p, const Sections& sections) {
  return [&p, sections](FieldVisitor& visit) {
    if (sections.system) {
      visit.table({"system", "",
                   "The system. Units: kT = 1; a b = 1 and mass 1 for particles of size 1; time in "
                   "√(m a b/kT)."},
                  Style::section, section_of(p.system, describe_system));
      visit.list(
          {"species", "", "A species of particles. A file may contain any number of species."},
          p.species, describe_species);
    }
    if (sections.prepare)
      visit.table(
          {"prepare", "", "Preparation of the initial state by consecutive stages."},
          Style::section, [&](FieldVisitor& in) {
            in.field({"quality_sweeps", "",
                      "Monte Carlo sweeps on a copy of the prepared state, in which `vitrel "
                      "prepare` measures the pressure and time correlations of its quality report. "
                      "With 0 the report omits both. The prepared state does not change."},
                     p.quality_sweeps);
            in.list({"stage", "", "The first stage places the particles; later stages move them."},
                    p.stages, describe_stage);
          });
    if (sections.run) {
      visit.table({"dynamics", "", "Event-driven dynamics."}, Style::section,
                  section_of(p.dynamics, describe_dynamics));
      visit.table({"output", "", "Output of a run."}, Style::section,
                  section_of(p.output, describe_output));
    }
    if (sections.analysis) {
      visit.table({"import", "", "What runs of other programs leave open."}, Style::section,
                  section_of(p.import, describe_import));
      visit.table(
          {"analysis", "", "Analysis of saved runs."}, Style::section, [&](FieldVisitor& in) {
            in.field({"only", "",
                      "The tables that are computed, by their names in `vitrel analyze --list`, "
                      "separated by commas, such as \"msd, fs\". All if empty."},
                     p.only);
            describe_analysis(p.analysis, in);
            in.table(
                {"structure", "",
                 "Structure factors, pair correlations and order parameters of single frames."},
                Style::inline_table, section_of(p.structure, describe_structure));
          });
    }
    if (sections.sweep)
      visit.table(
          {"sweep", "", "Several runs from one file; or states, if no key of [dynamics] is given."},
          Style::section, [&](FieldVisitor& in) {
            in.optional({"ladder", "",
                         "A key of the grid or of those that advance together. The job with its "
                         "first value prepares a state; every other one starts from the end of the "
                         "job with the value before, and goes on with the stages that move "
                         "particles."},
                        p.sweep.ladder, std::string("system.packing_fraction"));
            in.optional(
                {"axis", "",
                 "The key that charts and tables of the sweep run along. The default is the "
                 "one with the most values that are numbers, seeds apart."},
                p.sweep.axis, std::string("system.packing_fraction"));
            in.grid({"grid", "",
                     "Keys of this file in quotes, each with a list of values. Every combination "
                     "of values is a job."},
                    p.sweep.grid);
            in.grid({"together", "",
                     "Keys that advance together, each with the same number of values. The first "
                     "values of all keys make a job, the second values the next, and so on. "
                     "Together with a grid, each of these jobs is combined with every job of the "
                     "grid. Jobs are named after the keys of the grid and the first of these keys, "
                     "or as many as it takes to tell the jobs apart."},
                    p.sweep.together);
            in.list({"published", "",
                     "Results of a publication, which tables and charts of the sweep show beside "
                     "its own. A file may contain any number of them."},
                    p.sweep.published, describe_published);
          });
  };
}

void validate(const Parameters& parameters) {
  Parameters copy = parameters;
  check_bounds(fields(copy));
  validate_system(parameters.system);
  validate_species(parameters.species, parameters.system.dimension);
  const PackingBound bound = packing_bound(parameters.species, parameters.system.dimension);
  Rules("system").packing_fraction(parameters.system.packing_fraction, "packing_fraction", bound);
  validate_stages(parameters.stages, parameters.system, bound);
  validate_times(parameters);
  validate_collisions(parameters);
  if (parameters.dynamics.contact) validate_contact(parameters);
  validate_output(parameters);
  validate_import(parameters.import);
  validate_choice(parameters.only);
  validate_analysis(parameters.analysis);
  validate_structure(parameters.structure);
  validate_sweep(parameters.sweep);
}

std::optional<Field> parameter_field(const std::string& dotted_key) {
  Parameters blank;
  return find_field(fields(blank), dotted_key);
}

Parameters load_parameters(const ParameterSource& source) {
  TomlNode root = source.file.empty() ? parse_toml("", "parameters") : read_toml_file(source.file);
  resolve_state_files(root, source.file.parent_path());
  apply(root, source.overrides);
  if (source.seed)
    apply_override(root, fmt::format("system.seed={}", *source.seed),
                   fmt::format("--seed {}", *source.seed));
  if (source.start) apply_start(root, *source.start);
  return read(root);
}

Parameters parse_parameters(const std::string& text, const std::string& name,
                            const std::vector<std::string>& overrides) {
  TomlNode root = parse_toml(text, name);
  apply(root, overrides);
  return read(root);
}

std::optional<std::size_t> species_index(const Parameters& parameters, const std::string& name) {
  const auto found = std::ranges::find(parameters.species, name, &Species::name);
  if (found == parameters.species.end()) return std::nullopt;
  return static_cast<std::size_t>(found - parameters.species.begin());
}

std::optional<std::string> place_of(const Parameters& parameters, const std::string& key) {
  const auto found = parameters.given.lower_bound(key);
  if (found == parameters.given.end()) return std::nullopt;
  const std::string& first = found->first;
  // A key is followed directly by the keys below it, since all other characters of keys (letters, digits, '_') sort
  // after '.'.
  const bool fits = first == key || first.starts_with(key + ".");
  return fits ? std::optional(found->second) : std::nullopt;
}

std::string effective_parameters(const Parameters& parameters) {
  Parameters copy = parameters;
  copy.output.interval = sample_interval(parameters);
  if (copy.output.correlations) copy.output.correlations->longest_lag = longest_lag(parameters);
  Sections all_but_sweep;
  all_but_sweep.sweep = false;
  return write_parameters(fields(copy, all_but_sweep));
}

std::vector<std::string> commands_with_parameters() {
  std::vector<std::string> names;
  for (const auto& [name, sections] : command_sections) names.push_back(name);
  return names;
}

std::string command_template(const std::string& command) {
  const auto found = std::ranges::find(command_sections, command, &CommandSections::first);
  if (found == std::end(command_sections))
    throw UserError(fmt::format("'{}' has no parameter file; commands that have one: {}", command,
                                fmt::join(commands_with_parameters(), ", ")));
  Parameters parameters;
  if (found->second.sweep)
    parameters.sweep = {.grid = {{"system.seed", {"1", "2"}}},
                        .together = {{"system.packing_fraction", {"0.4", "0.6"}},
                                     {"dynamics.duration", {"100.0", "400.0"}}}};
  return fmt::format("# Parameters of `vitrel {}`, all at their defaults.\n\n", command) +
         parameter_template(fields(parameters, found->second));
}

std::string parameter_page() {
  Parameters parameters;
  return "# Parameters\n\n"
         "<!-- Written by `vitrel params --reference`; a test compares the two. -->\n\n"
         "Parameter files are TOML. All keys are optional. The command line can also set any key: "
         "`--set dynamics.duration=10`, `--set species.0.aspect_ratio=3`. An unknown key, a wrong "
         "type or an invalid value is an error, reported with file, line and column.\n\n" +
         parameter_tables(fields(parameters));
}

std::string parameter_module() {
  Parameters parameters;
  return "\"\"\"Settings as Python objects: the sections of the parameter file, and the tables in "
         "them.\n\n"
         "Written by `vitrel params --python`; a test compares the two.\n\"\"\"\n\n"
         "from __future__ import annotations\n\n"
         "from dataclasses import dataclass\n"
         "from typing import Any, ClassVar, Literal, Mapping, Sequence, TypedDict\n\n"
         "from .toml import Array, Keys, Numbers, Setting\n\n" +
         python_parameters(fields(parameters), {"State", "Table"});
}

Parameters recorded_parameters(const std::string& text, const std::string& name) {
  Parameters parameters = parse_parameters(text, name);
  if (parameters.system.dimension == 3 && !place_of(parameters, "dynamics.rotation"))
    parameters.dynamics.rotation = FreeRotation::constant;
  if (!place_of(parameters, "system.draw")) parameters.system.draw = ShapeDraw::random;
  return parameters;
}

Parameters continued(Parameters parameters, const Parameters& recorded) {
  OutputParameters& output = parameters.output;
  if (!output.interval) output.interval = sample_interval(recorded);
  if (output.correlations && !output.correlations->longest_lag && recorded.output.correlations)
    output.correlations->longest_lag = longest_lag(recorded);
  FreeRotation& rotation = parameters.dynamics.rotation;
  if (rotation == FreeRotation::euler && !place_of(parameters, "dynamics.rotation"))
    rotation = recorded.dynamics.rotation;
  if (!place_of(parameters, "system.draw")) parameters.system.draw = recorded.system.draw;
  return parameters;
}

std::optional<ParameterDifference> forbidden_change(const std::string& before,
                                                    const std::string& after, Work work) {
  // The recorded parameters as this version would have recorded them: with its keys, and with defaults for new ones.
  const Parameters recorded = recorded_parameters(before, "recorded parameters");
  const bool is_longer =
      parse_parameters(after, "parameters").dynamics.duration > recorded.dynamics.duration;
  return first_difference(
      effective_parameters(recorded), after, [work, is_longer](const std::string& key) {
        if (key == "output.checkpoint_interval" || key == "prepare.quality_sweeps") return true;
        // The file of the state is read at the start only; later it may be elsewhere or gone.
        if (key == "prepare.stage.0.file") return true;
        if (key.starts_with("dynamics.duration") && is_longer) return true;
        return key.starts_with("analysis.") ||
               (work == Work::preparation &&
                (key.starts_with("dynamics.") || key.starts_with("output.")));
      });
}

DynamicsOptions dynamics_options(const Parameters& parameters) {
  const DynamicsParameters& p = parameters.dynamics;
  DynamicsOptions options;
  options.engine.laws = contact_laws(parameters);
  options.engine.contact_duration = p.contact_duration;
  options.driving = p.driving;
  options.engine.on_overlap = p.on_overlap;
  options.engine.rotation = p.rotation;
  options.brownian = p.kind == DynamicsParameters::Kind::brownian;
  options.brownian_step = p.brownian_step;
  options.temperature = p.temperature;
  options.seed = parameters.system.seed;
  return options;
}

InitialEnergies initial_energies(const Parameters& parameters) {
  InitialEnergies energies{.translation = parameters.dynamics.translation_share};
  for (const Species& species : parameters.species)
    energies.temperatures.push_back(species.initial_temperature.value_or(1));
  const bool are_default =
      std::ranges::all_of(energies.temperatures, [](double t) { return t == 1; });
  if (are_default) energies.temperatures.clear();
  return energies;
}

double sample_interval(const Parameters& parameters) {
  const double duration = parameters.dynamics.duration;
  return parameters.output.interval.value_or(std::min(std::max(0.1, duration / 200), duration));
}

double longest_lag(const Parameters& parameters) {
  return parameters.output.correlations->longest_lag.value_or(0.5 * parameters.dynamics.duration);
}

SampleTimes sample_times(const Parameters& parameters) {
  const OutputParameters& p = parameters.output;
  const double duration = parameters.dynamics.duration;
  return p.spacing == OutputParameters::Spacing::linear
             ? linear_times(sample_interval(parameters), duration)
             : logarithmic_times(p.first, p.per_decade, duration);
}

}  // namespace vitrel
