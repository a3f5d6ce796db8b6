#include "workflow/sweep/sweep_jobs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/dynamics/displacement.h"
#include "core/error.h"
#include "core/io/json.h"
#include "core/state/species.h"

namespace vitrel {
namespace {

/// Dotted keys and one value of each.
using Assignments = std::vector<std::pair<std::string, std::string>>;
/// Assignments of which each job makes one.
using Axis = std::vector<Assignments>;

std::vector<Axis> axes_of(const SweepParameters& sweep) {
  std::vector<Axis> axes;
  if (!sweep.together.empty()) {
    Axis axis(sweep.together.front().second.size());
    for (const auto& [key, values] : sweep.together)
      for (std::size_t k = 0; k < values.size(); ++k) axis[k].emplace_back(key, values[k]);
    axes.push_back(std::move(axis));
  }
  for (const auto& [key, values] : sweep.grid) {
    Axis axis;
    for (const std::string& value : values) axis.push_back({{key, value}});
    axes.push_back(std::move(axis));
  }
  return axes;
}

// One choice from every axis, the last axis fastest.
std::vector<std::vector<Assignments>> combinations_of(const std::vector<Axis>& axes) {
  std::vector<std::vector<Assignments>> combinations(1);
  for (const Axis& axis : axes) {
    std::vector<std::vector<Assignments>> longer;
    for (const auto& combination : combinations)
      for (const Assignments& choice : axis) {
        longer.push_back(combination);
        longer.back().push_back(choice);
      }
    combinations = std::move(longer);
  }
  return combinations;
}

std::string last_part(const std::string& key) {
  return key.substr(key.rfind('.') + 1);
}

// Letters, digits and a few marks; anything else becomes "_", so that every shell takes the name.
std::string file_name_part(std::string text) {
  std::erase(text, '"');
  for (char& c : text)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-' && c != '+') c = '_';
  return text;
}

std::string job_id(const std::vector<Assignments>& combination) {
  std::map<std::string, int> uses;
  for (const Assignments& choice : combination) ++uses[last_part(choice.front().first)];
  std::string id;
  for (const Assignments& choice : combination) {
    const auto& [key, value] = choice.front();
    const std::string name = uses[last_part(key)] == 1 ? last_part(key) : key;
    id += fmt::format("{}{}-{}", id.empty() ? "" : "_", name, file_name_part(value));
  }
  return id.empty() ? "job" : id;
}

// What the sweep sets would silently win.
void refuse_overridden_keys(const std::vector<Axis>& axes, const ParameterSource& source) {
  for (const Axis& axis : axes)
    for (const auto& [key, value] : axis.front()) {
      const bool is_seed = key == "system.seed" && source.seed;
      const auto set = std::find_if(
          source.overrides.begin(), source.overrides.end(),
          [start = key + "="](const std::string& text) { return text.starts_with(start); });
      if (is_seed || set != source.overrides.end())
        throw UserError(
            fmt::format("{}: '{}' runs through the values of the sweep, so that {} has no effect; "
                        "leave out one of "
                        "the two",
                        source.file.string(), key, is_seed ? "--seed" : "--set " + *set));
    }
}

/// The combination with the value of the ladder before; none for the first.
std::optional<std::vector<Assignments>> combination_before(std::vector<Assignments> combination,
                                                           const std::vector<Axis>& axes,
                                                           const std::string& ladder) {
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const Assignments& keys = axes[a].front();
    if (std::ranges::find(keys, ladder, &Assignments::value_type::first) == keys.end()) continue;
    const auto here = std::ranges::find(axes[a], combination[a]);
    if (here == axes[a].begin()) return std::nullopt;
    combination[a] = *std::prev(here);
    return combination;
  }
  return std::nullopt;
}

/// The parameters lie in the folder of the job then.
void name_state_absolutely(Parameters& parameters) {
  if (StateStage* start = start_state(parameters.stages); start && start->file)
    start->file = std::filesystem::absolute(*start->file).lexically_normal().string();
}

/// From the end of another job of the same kind. The path is relative to the folder of the job.
void start_from(SweepJob& job, const std::string& predecessor, ParameterSource source) {
  job.predecessor = predecessor;
  source.start =
      StartFile{.file = "../" + predecessor + "/" + product_of(job), .keeps_moves = true};
  job.parameters = load_parameters(source);
}

double wave_number_of(const Parameters& p) {
  const auto& system = p.system;
  const auto particles = static_cast<std::size_t>(system.particles);
  const auto drawn = [&]<int Dim>() {
    return draw_particles<Dim>(p.species, particles, system.packing_fraction,
                               box_proportions<Dim>(system), system.seed, system.draw);
  };
  return system.dimension == 2 ? main_wave_number(drawn.template operator()<2>())
                               : main_wave_number(drawn.template operator()<3>());
}

bool takes_wave_number(const SweepJob& job) {
  return !job.prepares_only && job.parameters.analysis.wave_numbers.empty();
}

void share_wave_number(std::vector<SweepJob>& jobs) {
  std::set<double> densities;
  for (const SweepJob& job : jobs) densities.insert(job.parameters.system.packing_fraction);
  if (densities.size() < 2 || !std::all_of(jobs.begin(), jobs.end(), takes_wave_number)) return;
  double wave_number = 0;
  for (const SweepJob& job : jobs)
    wave_number = std::max(wave_number, wave_number_of(job.parameters));
  for (SweepJob& job : jobs) job.parameters.analysis.wave_numbers = {wave_number};
}

}  // namespace

std::vector<SweepJob> sweep_jobs(const ParameterSource& source) {
  const Parameters common = load_parameters(source);
  const std::vector<Axis> axes = axes_of(common.sweep);
  refuse_overridden_keys(axes, source);
  std::vector<SweepJob> jobs;
  std::set<std::string> ids;
  for (const std::vector<Assignments>& combination : combinations_of(axes)) {
    SweepJob job;
    job.id = job_id(combination);
    ParameterSource job_source = source;
    for (const Assignments& choice : combination)
      for (const auto& [key, value] : choice) {
        job.values.emplace_back(key, value);
        job_source.overrides.push_back(key + "=" + value);
      }
    job.parameters = load_parameters(job_source);
    job.prepares_only = !place_of(job.parameters, "dynamics");
    name_state_absolutely(job.parameters);
    if (common.sweep.ladder)
      if (const auto before = combination_before(combination, axes, *common.sweep.ladder))
        start_from(job, job_id(*before), job_source);
    if (!ids.insert(job.id).second)
      throw UserError(
          fmt::format("{}: two jobs of the sweep have the name {}; every value of a key of "
                      "[sweep.grid] and of the "
                      "first key of [sweep.together] may appear once",
                      source.file.string(), job.id));
    jobs.push_back(std::move(job));
  }
  share_wave_number(jobs);
  return jobs;
}

const char* product_of(const SweepJob& job) {
  return job.prepares_only ? "state.h5" : "run.h5";
}

const SweepJob& job_named(const std::vector<SweepJob>& jobs, const std::string& id) {
  std::vector<std::string> names;
  for (const SweepJob& job : jobs) {
    if (job.id == id) return job;
    names.push_back(job.id);
  }
  throw UserError(fmt::format("no job of the sweep has the name '{}'; its jobs: {}", id,
                              fmt::join(names, ", ")));
}

Json values_json(const SweepJob& job) {
  Json values = Json::object();
  for (const auto& [key, value] : job.values) {
    const TomlNode node = parse_toml("x = " + value, key);
    const TomlNode& parsed = node.find("x")->node;
    if (const auto* real = parsed.get<double>())
      values[key] = *real;
    else if (const auto* integer = parsed.get<std::int64_t>())
      values[key] = *integer;
    else if (const auto* flag = parsed.get<bool>())
      values[key] = *flag;
    else if (const auto* text = parsed.get<std::string>())
      values[key] = *text;
    else
      values[key] = value;
  }
  return values;
}

}  // namespace vitrel
