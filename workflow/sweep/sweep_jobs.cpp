#include "workflow/sweep/sweep_jobs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/dynamics/displacement.h"
#include "core/error.h"
#include "core/io/json.h"
#include "core/state/species.h"

namespace vitrel {
namespace {

/// Dotted keys, each with one value.
using Assignments = std::vector<std::pair<std::string, std::string>>;
/// Alternatives, of which each job makes one.
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

// All choices of one alternative from every axis; the last axis varies fastest.
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

/// Keeps letters, digits and a few marks, and replaces anything between them by one "_", so that every shell accepts
/// the name.
std::string file_name_part(const std::string& text) {
  std::string part;
  for (const char c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '+')
      part += c;
    else if (!part.empty() && part.back() != '_')
      part += '_';
  return part.substr(0, part.find_last_not_of('_') + 1);
}

/// The number of keys of an axis that are needed to distinguish its values.
std::size_t naming_keys(const Axis& axis) {
  const std::size_t keys = axis.front().size();
  for (std::size_t count = 1; count < keys; ++count) {
    std::set<Assignments> names;
    for (const Assignments& choice : axis)
      names.emplace(choice.begin(), choice.begin() + static_cast<std::ptrdiff_t>(count));
    if (names.size() == axis.size()) return count;
  }
  return keys;
}

std::string job_id(const std::vector<Assignments>& combination, const std::vector<Axis>& axes) {
  Assignments named;
  for (std::size_t a = 0; a < axes.size(); ++a)
    named.insert(named.end(), combination[a].begin(),
                 combination[a].begin() + static_cast<std::ptrdiff_t>(naming_keys(axes[a])));
  std::map<std::string, int> uses;
  for (const auto& [key, value] : named) ++uses[last_part(key)];
  std::string id;
  for (const auto& [key, value] : named) {
    const std::string name = uses[last_part(key)] == 1 ? last_part(key) : key;
    id += fmt::format("{}{}-{}", id.empty() ? "" : "_", name, file_name_part(value));
  }
  return id.empty() ? "job" : id;
}

StudyLayout layout_of(const SweepParameters& sweep) {
  StudyLayout layout{{}, sweep.axis};
  for (const auto& [key, values] : sweep.together) layout.together.push_back(key);
  return layout;
}

std::vector<Published> published_of(const std::vector<PublishedResult>& results, std::size_t step) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::vector<Published> published;
  for (const PublishedResult& result : results)
    published.push_back({result.source, result.quantity,
                         result.exponent ? *result.exponent : result.values[step],
                         result.exponent.has_value(), result.from.value_or(-infinite),
                         result.to.value_or(infinite)});
  return published;
}

// Refuses values of the command line for keys of the sweep, since the sweep would silently override them.
void refuse_overridden_keys(const std::vector<Axis>& axes, const StudyLayout& layout,
                            const ParameterSource& source) {
  for (const Axis& axis : axes)
    for (const auto& [key, value] : axis.front()) {
      const bool is_seed = key == "system.seed" && source.seed;
      const auto set = std::ranges::find_if(
          source.overrides,
          [start = key + "="](const std::string& text) { return text.starts_with(start); });
      if (is_seed || set != source.overrides.end())
        throw UserError(fmt::format(
            "{}: '{}' runs through the values of the sweep, so that {} has no effect; leave out "
            "one of the two, or set the values: --set 'sweep.{}.{}=[{}]'",
            source.file.string(), key, is_seed ? "--seed" : "--set " + *set,
            std::ranges::count(layout.together, key) > 0 ? "together" : "grid", key, value));
    }
}

/// The combination with the previous value of the ladder; no value if this one has the first.
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

/// The path must be absolute, because the parameters are written into the folder of the job.
void name_state_absolutely(Parameters& parameters) {
  if (StateStage* start = start_state(parameters.stages); start && start->file)
    start->file = std::filesystem::absolute(*start->file).lexically_normal().string();
}

/// Lets the job start from the end of another one. The path is relative to the folder of the job.
void start_from(SweepJob& job, const std::string& predecessor, ParameterSource source) {
  job.predecessor = predecessor;
  source.start =
      StartFile{.file = "../" + predecessor + "/" + product_of(job), .keeps_moves = true};
  job.parameters = load_parameters(source);
}

/// Converts a value to JSON. Tables, and numbers that are not finite, become their TOML text.
Json json_of(const TomlNode& node) {
  if (const auto* array = node.get<TomlNode::Array>()) {
    Json entries = Json::array();
    for (const TomlNode& entry : *array) entries.push_back(json_of(entry));
    return entries;
  }
  if (const auto* real = node.get<double>(); real && std::isfinite(*real)) return *real;
  if (const auto* integer = node.get<std::int64_t>()) return *integer;
  if (const auto* flag = node.get<bool>()) return *flag;
  if (const auto* text = node.get<std::string>()) return *text;
  return to_toml(node);
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
  if (densities.size() < 2 || !std::ranges::all_of(jobs, takes_wave_number)) return;
  double wave_number = 0;
  for (const SweepJob& job : jobs)
    wave_number = std::max(wave_number, wave_number_of(job.parameters));
  for (SweepJob& job : jobs) job.parameters.analysis.wave_numbers = {wave_number};
}

}  // namespace

std::vector<SweepJob> sweep_jobs(const ParameterSource& source) {
  const Parameters common = load_parameters(source);
  const std::vector<Axis> axes = axes_of(common.sweep);
  const StudyLayout layout = layout_of(common.sweep);
  refuse_overridden_keys(axes, layout, source);
  std::vector<SweepJob> jobs;
  std::set<std::string> ids;
  const auto combinations = combinations_of(axes);
  const std::size_t jobs_in_step = combinations.size() / common.sweep.first_axis_steps();
  for (const std::vector<Assignments>& combination : combinations) {
    SweepJob job;
    job.id = job_id(combination, axes);
    job.layout = layout;
    job.published = published_of(common.sweep.published, jobs.size() / jobs_in_step);
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
        start_from(job, job_id(*before, axes), job_source);
    if (!ids.insert(job.id).second)
      throw UserError(
          fmt::format("{}: two jobs of the sweep have the name {}; every value of a key of "
                      "[sweep.grid], and every combination of those of [sweep.together], may "
                      "appear once",
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
  for (const auto& [key, value] : job.values)
    values[key] = json_of(parse_toml("x = " + value, key).find("x")->node);
  return values;
}

}  // namespace vitrel
