#include "core/io/foreign/particle_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "core/error.h"
#include "core/io/box_crossings.h"
#include "core/io/foreign/text_lines.h"
#include "core/whole_number.h"

namespace vitrel {
namespace {

constexpr const char* species_column = "species";
constexpr std::array<const char*, 3> directions = {"x", "y", "z"};

/// Groups of columns of which all or none must be there.
const std::vector<std::vector<std::string>> groups = {{"frame"},
                                                      {"step"},
                                                      {"time"},
                                                      {"id"},
                                                      {"angle"},
                                                      {"radius"},
                                                      {"diameter"},
                                                      {"diameter_x", "diameter_y"},
                                                      {"mass"},
                                                      {"omega"},
                                                      {"box_x", "box_y"},
                                                      {"x", "y"},
                                                      {"unwrapped_x", "unwrapped_y"},
                                                      {"image_x", "image_y"},
                                                      {"vx", "vy"},
                                                      {"a", "b"},
                                                      {"qw", "qx", "qy", "qz"},
                                                      {"omega_x", "omega_y", "omega_z"}};
/// Third components, with the first component that each belongs to.
const std::map<std::string, std::string> third_of = {
    {"box_z", "box_x"}, {"z", "x"}, {"unwrapped_z", "unwrapped_x"}, {"image_z", "image_x"},
    {"vz", "vx"},       {"c", "a"}, {"diameter_z", "diameter_x"}};

bool counts(const std::string& column) {
  return third_of.contains(column) || std::ranges::any_of(groups, [&](const auto& group) {
           return std::ranges::find(group, column) != group.end();
         });
}

double number(std::string_view cell, const std::string& column, const std::string& place) {
  const std::optional<double> value = number_in(cell);
  if (!value || !std::isfinite(*value))
    throw FileError(
        fmt::format("{}: {} is \"{}\", but should be a finite number", place, column, cell));
  return *value;
}

/// Renames columns to which the user gives another name.
void rename(std::vector<std::string>& columns, const std::vector<ImportOptions::Column>& renamed,
            const std::string& place) {
  for (const auto& [file, meaning] : renamed) {
    if (!counts(meaning) && meaning != species_column)
      throw UserError(fmt::format(
          "import.columns: \"{}\" is no column that vitrel knows; docs/imports.md lists them",
          meaning));
    const auto found = std::ranges::find(columns, file);
    if (found == columns.end())
      throw FileError(fmt::format("{}: import.columns names \"{}\", but there are \"{}\"", place,
                                  file, fmt::join(columns, "\", \"")));
    *found = meaning;
  }
}

}  // namespace

ParticleTable::ParticleTable(std::vector<std::string> columns, const std::string& place,
                             const std::vector<ImportOptions::Column>& renamed) {
  rename(columns, renamed, place);
  const std::set<std::string> names(columns.begin(), columns.end());
  for (const std::string& name : columns) {
    const bool is_number = counts(name);
    if ((is_number || name == species_column) && std::ranges::count(columns, name) > 1)
      throw FileError(fmt::format("{}: the column {} comes twice", place, name));
    columns_.push_back(is_number || name == species_column ? name : "");
    if (is_number) numbers_[name];
    if (columns_.back().empty() && !name.empty()) skipped_.insert(name);
  }
  const auto require = [&](const std::string& wanted, const std::string& because) {
    if (!names.contains(wanted))
      throw FileError(
          fmt::format("{}: there is a column {}, but none named {}", place, because, wanted));
  };
  for (const auto& group : groups)
    for (const std::string& name : group)
      if (names.contains(name))
        for (const std::string& other : group) require(other, name);
  for (const auto& [third, first] : third_of)
    if (names.contains(third)) require(first, third);
  if (!names.contains("x") && !names.contains("unwrapped_x"))
    throw FileError(
        fmt::format("{}: none of the columns \"{}\" is named x; [[import.columns]] can say which "
                    "means what, for "
                    "example file = \"{}\", meaning = \"x\"",
                    place, fmt::join(columns, "\", \""), columns.empty() ? "X" : columns.front()));
}

void ParticleTable::add(const std::vector<std::string_view>& cells, const std::string& place) {
  if (cells.size() != columns_.size())
    throw FileError(fmt::format("{}: has {} cells, but there are {} columns", place, cells.size(),
                                columns_.size()));
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (columns_[k].empty()) continue;
    const std::string_view cell = trimmed(cells[k]);
    if (columns_[k] == species_column)
      species_.emplace_back(cell);
    else
      numbers_[columns_[k]].push_back(number(cell, columns_[k], place));
  }
  ++rows_;
}

void ParticleTable::clear() {
  for (auto& [name, values] : numbers_) values.clear();
  species_.clear();
  rows_ = 0;
}

ParticleTable::Order ParticleTable::by_id(const std::string& place) const {
  Order order(rows_);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto found = numbers_.find("id");
  if (found == numbers_.end()) return order;
  const std::vector<double>& id = found->second;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return id[i]; });
  const auto twice = std::ranges::adjacent_find(order, {}, [&](std::size_t i) { return id[i]; });
  if (twice != order.end())
    throw FileError(fmt::format("{}: the id {} comes twice", place, id[*twice]));
  return order;
}

std::vector<double> ParticleTable::numbers(const std::string& column, const Order& order) const {
  std::vector<double> values;
  const auto found = numbers_.find(column);
  if (found == numbers_.end()) return values;
  for (const std::size_t i : order) values.push_back(found->second[i]);
  return values;
}

std::vector<Vec3> ParticleTable::vectors(const std::string& prefix,
                                         const std::array<const char*, 3>& columns,
                                         const Order& order) const {
  std::vector<Vec3> result;
  if (!has(prefix + columns[0])) return result;
  result.assign(order.size(), Vec3::Zero());
  for (int k = 0; k < 3; ++k) {
    const std::vector<double> component = numbers(prefix + columns[k], order);
    for (std::size_t i = 0; i < component.size(); ++i) result[i][k] = component[i];
  }
  return result;
}

std::vector<Vec3> ParticleTable::half_lengths(const Order& order) const {
  std::vector<Vec3> axes = vectors("", {"a", "b", "c"}, order);
  for (const Vec3& whole : vectors("diameter_", directions, axes.empty() ? order : Order()))
    axes.push_back(0.5 * whole);
  for (const double radius : numbers("radius", axes.empty() ? order : Order()))
    axes.push_back(Vec3::Constant(radius));
  for (const double diameter : numbers("diameter", axes.empty() ? order : Order()))
    axes.push_back(Vec3::Constant(0.5 * diameter));
  return axes;
}

std::optional<double> ParticleTable::single(const std::string& column) const {
  if (!has(column) || rows_ == 0) return std::nullopt;
  return numbers_.at(column).front();
}

ForeignFrame ParticleTable::frame(const std::string& place) const {
  const Order order = by_id(place);
  ForeignFrame frame;
  if (has("angle") || !(has("z") || has("unwrapped_z"))) frame.dimension = 2;
  frame.time = single("time");
  if (const auto step = single("step")) {
    frame.step = whole_number<std::int64_t>(std::round(*step));
    if (!frame.step)
      throw FileError(fmt::format("{}: step is {}, but should be a whole number", place, *step));
  }
  if (has("box_x")) frame.box = vectors("box_", directions, {0}).front();
  frame.id = numbers("id", order);
  frame.position = vectors("", directions, order);
  frame.unwrapped = vectors("unwrapped_", directions, order);
  for (const Vec3& image : vectors("image_", directions, order)) {
    const auto crossings = box_crossings<3>(image);
    if (!crossings)
      throw FileError(fmt::format("{}: an image is {}, but should be whole, and a few boxes away",
                                  place, fmt::join(image, ", ")));
    frame.image.push_back(*crossings);
  }
  frame.angle = numbers("angle", order);
  const std::vector<double> w = numbers("qw", order);
  const std::vector<Vec3> vector_part = vectors("q", directions, order);
  for (std::size_t i = 0; i < w.size(); ++i)
    frame.orientation.emplace_back(w[i], vector_part[i][0], vector_part[i][1], vector_part[i][2]);
  frame.half_lengths = half_lengths(order);
  frame.mass = numbers("mass", order);
  frame.velocity = vectors("v", directions, order);
  frame.angular_velocity = vectors("omega_", directions, order);
  for (const double omega : numbers("omega", order))
    frame.angular_velocity.emplace_back(0, 0, omega);
  if (!species_.empty())
    for (const std::size_t i : order) frame.species.push_back(species_[i]);
  frame.skipped = skipped_;
  return frame;
}

}  // namespace vitrel
