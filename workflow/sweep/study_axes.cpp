#include "workflow/sweep/study_axes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/io/quantity.h"
#include "workflow/configuration/parameters.h"

namespace vitrel {
namespace {

/// A value as numbers; no value if it is something else.
std::optional<std::vector<double>> numbers_of(const Json& value, const std::string& unit) {
  if (value.is_number()) return std::vector{value.get<double>()};
  if (value.is_string() && !unit.empty())
    if (const auto number = quantity(value.get<std::string>(), unit)) return std::vector{*number};
  if (!value.is_array() || value.empty()) return std::nullopt;
  std::vector<double> numbers;
  for (const Json& entry : value) {
    if (!entry.is_number()) return std::nullopt;
    numbers.push_back(entry.get<double>());
  }
  return numbers;
}

/// Whether entry k of the arrays is constant or proportional to the first entry.
bool follows_first(const std::vector<std::vector<double>>& arrays, std::size_t k) {
  const double of_first = arrays.front()[k], ratio = of_first / arrays.front()[0];
  const auto all = [&](auto&& holds) { return std::ranges::all_of(arrays, holds); };
  return all([&](const auto& array) { return array[k] == of_first; }) ||
         all([&](const auto& array) {
           return std::abs(array[k] - ratio * array[0]) <= 1e-12 * std::abs(array[k]);
         });
}

/// One number for every job, if the numbers determine the values.
std::optional<std::vector<double>> numbers_of(const std::vector<Json>& values,
                                              const std::string& unit) {
  std::vector<std::vector<double>> arrays;
  for (const Json& value : values) {
    auto numbers = numbers_of(value, unit);
    if (!numbers || (!arrays.empty() && numbers->size() != arrays.front().size()))
      return std::nullopt;
    arrays.push_back(std::move(*numbers));
  }
  for (std::size_t k = 1; k < arrays.front().size(); ++k)
    if (!follows_first(arrays, k)) return std::nullopt;
  std::vector<double> first;
  for (const std::vector<double>& array : arrays) first.push_back(array.front());
  return first;
}

std::string category_text(const Json& value) {
  return value.is_string() ? value.get<std::string>() : json_text(value);
}

void set_categories(const std::vector<Json>& values, StudyAxis& axis) {
  for (const Json& value : values) {
    const std::string text = category_text(value);
    const auto found = std::ranges::find(axis.labels, text);
    axis.value.push_back(static_cast<double>(found - axis.labels.begin()));
    if (found == axis.labels.end()) axis.labels.push_back(text);
  }
}

/// The values of the key in all jobs; null for a job that lacks the key.
std::vector<Json> values_of(const std::string& key, const std::vector<SweptValues>& jobs) {
  std::vector<Json> values;
  for (const SweptValues& job : jobs) {
    const auto found = std::ranges::find(job, key, &SweptValues::value_type::first);
    values.push_back(found == job.end() ? Json() : parse_json(found->second, key));
  }
  return values;
}

StudyAxis axis_of(const std::string& key, const std::vector<SweptValues>& jobs) {
  const std::optional<Field> field = parameter_field(key);
  const std::string unit = field ? field->unit : "";
  StudyAxis axis{key, field ? field->short_name() : key, "1", {}, {}};
  const std::vector<Json> values = values_of(key, jobs);
  if (auto numbers = numbers_of(values, unit)) {
    axis.value = std::move(*numbers);
    if (!unit.empty()) axis.unit = unit;
  } else {
    set_categories(values, axis);
  }
  return axis;
}

/// Parameters of two species have the same symbol, so their keys replace it.
void tell_symbols_apart(std::vector<StudyAxis>& axes) {
  std::map<std::string, int> uses;
  for (const StudyAxis& axis : axes) ++uses[axis.symbol];
  for (StudyAxis& axis : axes)
    if (uses[axis.symbol] > 1) axis.symbol = axis.key;
}

using Axes = std::vector<StudyAxis>;

/// The number of different combinations of values that these axes have.
std::size_t combinations_of(const std::vector<const StudyAxis*>& axes, std::size_t jobs) {
  std::set<std::vector<double>> all;
  for (std::size_t k = 0; k < jobs; ++k) {
    std::vector<double> values;
    for (const StudyAxis* axis : axes) values.push_back(axis->value[k]);
    all.insert(std::move(values));
  }
  return all.size();
}

/// Keeps only as many of the keys that advance together as are needed to distinguish their steps.
void reduce_together(const StudyLayout& layout, Axes& axes) {
  std::vector<const StudyAxis*> together;
  for (const StudyAxis& axis : axes)
    if (std::ranges::count(layout.together, axis.key) > 0) together.push_back(&axis);
  if (together.empty()) return;
  const std::size_t jobs = axes.front().value.size();
  const std::size_t steps = combinations_of(together, jobs);
  const auto is_wanted = [&](const StudyAxis* axis) { return axis->key == layout.axis; };
  const auto tells_all = [&](const StudyAxis* axis) {
    return !axis->is_category() && axis->distinct_values() == steps;
  };
  std::ranges::stable_partition(together, tells_all);
  std::ranges::stable_partition(together, is_wanted);
  std::vector<const StudyAxis*> kept;
  std::set<std::string> dropped;
  for (const StudyAxis* axis : together) {
    const std::size_t before = combinations_of(kept, jobs);
    kept.push_back(axis);
    if (kept.size() == 1 || combinations_of(kept, jobs) > before) continue;
    kept.pop_back();
    dropped.insert(axis->key);
  }
  std::erase_if(axes, [&](const StudyAxis& axis) { return dropped.contains(axis.key); });
}

/// Removes axes with a single value, which say nothing, unless there are no others.
void drop_constants(Axes& axes) {
  const auto is_constant = [](const StudyAxis& axis) { return axis.distinct_values() < 2; };
  if (std::ranges::all_of(axes, is_constant))
    axes.resize(1);
  else
    std::erase_if(axes, is_constant);
}

void put_abscissa_last(const StudyLayout& layout, Axes& axes) {
  auto abscissa =
      std::ranges::find_if(axes, [&](const StudyAxis& axis) { return axis.key == layout.axis; });
  if (abscissa == axes.end())
    abscissa = std::ranges::max_element(axes, {}, [](const StudyAxis& axis) {
      return axis.is_category() ? 0 : axis.distinct_values();
    });
  std::rotate(abscissa, abscissa + 1, axes.end());
}

}  // namespace

SweptValues swept_values(const Json& values) {
  SweptValues texts;
  for (const auto& [key, value] : values.items()) texts.emplace_back(key, json_text(value));
  return texts;
}

std::string last_part(const std::string& key) {
  return key.substr(key.rfind('.') + 1);
}

std::size_t StudyAxis::distinct_values() const {
  return std::set<double>(value.begin(), value.end()).size();
}

std::string StudyAxis::text(std::size_t job) const {
  if (is_category()) return symbol + ": " + labels[static_cast<std::size_t>(value[job])];
  return fmt::format("{} = {:.6g}{}", symbol, value[job], unit == "1" ? "" : " " + unit);
}

std::vector<StudyAxis> study_keys(const std::vector<SweptValues>& jobs) {
  Axes keys;
  if (jobs.empty()) return keys;
  for (const auto& [key, value] : jobs.front())
    if (key != seed_key) keys.push_back(axis_of(key, jobs));
  tell_symbols_apart(keys);
  return keys;
}

std::vector<StudyAxis> study_axes(std::vector<StudyAxis> axes, const StudyLayout& layout) {
  if (axes.empty()) return axes;
  reduce_together(layout, axes);
  drop_constants(axes);
  put_abscissa_last(layout, axes);
  return axes;
}

std::string axes_text(const std::vector<StudyAxis>& axes, std::size_t job) {
  std::vector<std::string> parts;
  for (const StudyAxis& axis : axes) parts.push_back(axis.text(job));
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace vitrel
