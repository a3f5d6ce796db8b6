#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "core/io/parameters.h"
#include "core/io/quantity.h"
#include "core/io/suggestion.h"

namespace vitrel {
namespace {

std::string join(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::ranges::find(words, word) != words.end();
}

std::string called(const TomlNode& node) {
  if (node.get<TomlNode::Table>()) return "a table";
  if (node.get<TomlNode::Array>()) return "an array";
  if (node.get<std::string>()) return "the string " + to_toml(node);
  if (node.get<bool>()) return to_toml(node);
  return "the number " + to_toml(node);
}

// Reads the fields of one table.
class Reader final : public FieldVisitor {
 public:
  Reader(const TomlNode& table, std::string path) : table_(table), path_(std::move(path)) {
    if (!table.get<TomlNode::Table>())
      throw UserError(
          fmt::format("{}: key '{}' must be a table, not {}", table.where, path_, called(table)));
  }

  void field(const Field& field, bool& value) override {
    const TomlNode* node = find(field);
    if (!node) return;
    const bool* read = node->get<bool>();
    if (!read) wrong_type(*node, field, "true or false", value ? "true" : "false");
    value = *read;
  }

  void field(const Field& field, double& value) override {
    if (const TomlNode* node = find(field)) value = number(*node, field, to_toml(value));
  }

  void field(const Field& field, std::string& value) override {
    const TomlNode* node = find(field);
    if (!node) return;
    const std::string* read = node->get<std::string>();
    if (!read) wrong_type(*node, field, "a string", to_toml(std::string_view(value)));
    value = *read;
  }

  void quantity(const Field& field, double& value) override {
    const TomlNode* node = find(field);
    if (!node) return;
    const std::string* text = node->get<std::string>();
    const std::optional<double> read = text ? vitrel::quantity(*text, field.unit) : std::nullopt;
    if (!read)
      wrong_type(*node, field,
                 fmt::format("a string with a number and a unit that converts to {}", field.unit),
                 to_toml(std::string_view(quantity_text(value, field.unit))));
    value = *read;
  }

  void numbers(const Field& field, std::span<double> values) override {
    const TomlNode* node = find(field);
    if (!node) return;
    const auto* items = node->get<TomlNode::Array>();
    const std::string wanted = fmt::format("an array of {} numbers", values.size());
    const std::string example = to_toml(values);
    if (!items) wrong_type(*node, field, wanted, example);
    if (items->size() != values.size())
      throw UserError(fmt::format("{}: key '{}' must be {}, not of {}; for example {} = {}",
                                  node->where, join(path_, field.key), wanted, items->size(),
                                  field.key, example));
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] = number((*items)[k], field, to_toml(values[k]));
  }

  void field(const Field& field, std::vector<double>& values) override {
    const TomlNode* node = find(field);
    if (!node) return;
    const auto* items = node->get<TomlNode::Array>();
    if (!items) wrong_type(*node, field, "an array of numbers", "[1.0, 2.0]");
    values.clear();
    for (const TomlNode& item : *items) values.push_back(number(item, field, "[1.0, 2.0]"));
  }

  void number_or_numbers(const Field& field, std::vector<double>& values) override {
    const TomlNode* node = find(field);
    if (!node) return;
    if (node->get<TomlNode::Array>())
      this->field(field, values);
    else
      values = {number(*node, field, to_toml(values[0]), "a number or an array of numbers")};
  }

  void integer(const Field& field, std::int64_t& value, std::int64_t low,
               std::int64_t high) override {
    const TomlNode* node = find(field);
    if (!node) return;
    const std::int64_t* read = node->get<std::int64_t>();
    if (!read) wrong_type(*node, field, "an integer", fmt::format("{}", value));
    if (*read < low || *read > high)
      throw UserError(fmt::format("{}: key '{}' is {}, but must lie between {} and {}", node->where,
                                  join(path_, field.key), *read, low, high));
    value = *read;
  }

  void choice(const Field& field, std::size_t& index, std::span<const char* const> names) override {
    const TomlNode* node = find(field);
    if (!node) return;
    const std::string* read = node->get<std::string>();
    const std::vector<std::string> known(names.begin(), names.end());
    if (!read)
      wrong_type(*node, field, fmt::format("one of the strings \"{}\"", fmt::join(known, "\", \"")),
                 to_toml(std::string_view(known.at(std::min(index, known.size() - 1)))));
    const auto found = std::ranges::find(known, *read);
    if (found == known.end())
      throw UserError(fmt::format("{}: key '{}' is \"{}\", but must be one of \"{}\"{}",
                                  node->where, join(path_, field.key), *read,
                                  fmt::join(known, "\", \""), suggestion(*read, known)));
    index = static_cast<std::size_t>(found - known.begin());
  }

  void table(const Field& field, TableStyle, const Inside& inside) override {
    const TomlNode* node = find(field);
    if (!node) return;
    Reader reader(*node, join(path_, field.key));
    inside(reader);
    reader.refuse_unknown_keys();
  }

  void list(const Field& field, const List& list) override {
    const TomlNode* node = find(field);
    if (!node) return;
    const auto* items = node->get<TomlNode::Array>();
    if (!items)
      throw UserError(fmt::format("{}: key '{}' must be an array of tables, not {}; write [[{}]]",
                                  node->where, join(path_, field.key), called(*node),
                                  join(path_, field.key)));
    list.resize(items->size());
    for (std::size_t i = 0; i < items->size(); ++i) {
      Reader reader((*items)[i], join(path_, fmt::format("{}.{}", field.key, i)));
      list.describe(i, reader);
      reader.refuse_unknown_keys();
    }
  }

  void value_or_table(const Field& field, bool& is_table, const Inside& value,
                      const Inside& inside) override {
    const TomlNode* node = find(field);
    if (!node) return;
    is_table = node->get<TomlNode::Table>() != nullptr;
    if (is_table)
      table(field, TableStyle::inline_table, inside);
    else
      value(*this);
  }

  void array(const Field& field, const List& entries) override {
    const TomlNode* node = find(field);
    if (!node) return;
    const auto* items = node->get<TomlNode::Array>();
    if (items && entries.resize) entries.resize(items->size());
    if (!items || items->size() != entries.size())
      throw UserError(fmt::format("{}: key '{}' must be an array of {} entries, not {}",
                                  node->where, join(path_, field.key), entries.size(),
                                  items ? fmt::format("of {}", items->size()) : called(*node)));
    TomlNode::Table numbered;
    for (std::size_t k = 0; k < items->size(); ++k)
      numbered.push_back({fmt::format("{}", k), (*items)[k].where, (*items)[k]});
    const TomlNode table{numbered, node->where};
    Reader reader(table, join(path_, field.key));
    for (std::size_t k = 0; k < items->size(); ++k) entries.describe(k, reader);
  }

  void optional(const Field& field, bool& present, const Inside& inside) override {
    if (!find(field)) return;
    present = true;
    inside(*this);
  }

  void when(bool condition, const std::string& label, const Inside& inside) override {
    const std::string outer = elsewhere_;
    if (!condition) elsewhere_ = label;
    inside(*this);
    elsewhere_ = outer;
  }

  void grid(const Field& field, ParameterGrid& grid) override {
    const TomlNode* node = find(field);
    if (!node) return;
    grid.clear();
    flatten(*node, "", join(path_, field.key), grid);
  }

  void refuse_unknown_keys() const {
    for (const TomlEntry& entry : *table_.get<TomlNode::Table>())
      if (!contains(known_, entry.key) && !contains(former_, entry.key)) refuse(entry);
  }

 private:
  const TomlNode* find(const Field& field) {
    if (!elsewhere_.empty()) {
      known_elsewhere_.emplace(field.key, elsewhere_);
      return nullptr;
    }
    if (!contains(known_, field.key)) known_.push_back(field.key);
    const TomlEntry* entry = table_.find(field.key);
    if (!entry && !field.former_key.empty()) {
      entry = table_.find(field.former_key);
      former_.push_back(field.former_key);
    }
    return entry ? &entry->node : nullptr;
  }

  [[noreturn]] void wrong_type(const TomlNode& node, const Field& field, const std::string& wanted,
                               const std::string& example) const {
    throw UserError(fmt::format("{}: key '{}' must be {}, not {}; for example {} = {}", node.where,
                                join(path_, field.key), wanted, called(node), field.key, example));
  }

  double number(const TomlNode& node, const Field& field, const std::string& example,
                const std::string& wanted = "a number") const {
    if (const double* real = node.get<double>()) return *real;
    if (const std::int64_t* integer = node.get<std::int64_t>())
      return static_cast<double>(*integer);
    wrong_type(node, field, wanted, example);
  }

  [[noreturn]] void refuse(const TomlEntry& entry) const {
    const std::string path = join(path_, entry.key);
    if (const auto other = known_elsewhere_.find(entry.key); other != known_elsewhere_.end())
      throw UserError(fmt::format("{}: key '{}' has a meaning only with {}; known keys here: {}",
                                  entry.where, path, other->second, fmt::join(known_, ", ")));
    throw UserError(fmt::format("{}: key '{}' is unknown{} known keys: {}", entry.where, path,
                                punctuated(suggestion(entry.key, known_)),
                                fmt::join(known_, ", ")));
  }

  static std::string punctuated(const std::string& hint) { return hint.empty() ? ";" : hint; }

  // "a.b" = [1, 2], a.b = [1, 2] and [a] b = [1, 2] all mean the same key.
  static void flatten(const TomlNode& node, const std::string& key, const std::string& path,
                      ParameterGrid& grid) {
    if (const auto* table = node.get<TomlNode::Table>()) {
      for (const TomlEntry& entry : *table)
        flatten(entry.node, join(key, entry.key), join(path, entry.key), grid);
      return;
    }
    const auto* items = node.get<TomlNode::Array>();
    if (key.empty() || !items || items->empty())
      throw UserError(
          fmt::format("{}: key '{}' must hold arrays of values to run through, not {}; for "
                      "example \"system.packing_fraction\" = [0.4, 0.5]",
                      node.where, path, items && items->empty() ? "an empty array" : called(node)));
    std::vector<std::string> values;
    for (const TomlNode& item : *items) values.push_back(to_toml(item));
    grid.emplace_back(key, std::move(values));
  }

  const TomlNode& table_;
  std::string path_;
  std::vector<std::string> known_;
  std::vector<std::string> former_;                     ///< keys of earlier versions, read instead
  std::map<std::string, std::string> known_elsewhere_;  ///< key → when it has a meaning
  std::string elsewhere_;                               ///< set while fields do not apply
};

void flatten_values(const TomlNode& node, const std::string& path,
                    std::map<std::string, std::string>& values) {
  if (const auto* table = node.get<TomlNode::Table>()) {
    for (const TomlEntry& entry : *table) flatten_values(entry.node, join(path, entry.key), values);
  } else if (const auto* array = node.get<TomlNode::Array>()) {
    for (std::size_t i = 0; i < array->size(); ++i)
      flatten_values((*array)[i], join(path, fmt::format("{}", i)), values);
  } else {
    values[path] = to_toml(node);
  }
}

/// Compares the values of one table, and of those below it, with the bounds of their fields.
class BoundsCheck final : public FieldVisitor {
 public:
  explicit BoundsCheck(std::string path) : path_(std::move(path)) {}

  using FieldVisitor::field;
  void field(const Field&, bool&) override {}
  void field(const Field& field, double& value) override { require(field, value, field.key); }
  void field(const Field&, std::string&) override {}
  void quantity(const Field& field, double& value) override { require(field, value, field.key); }
  void numbers(const Field& field, std::span<double> values) override {
    for (std::size_t k = 0; k < values.size(); ++k)
      require(field, values[k], fmt::format("{}.{}", field.key, k));
  }
  void field(const Field& field, std::vector<double>& values) override { numbers(field, values); }
  void integer(const Field& field, std::int64_t& value, std::int64_t, std::int64_t) override {
    if (!field.bounds.contains(static_cast<double>(value)))
      refuse(field, static_cast<double>(value), field.key, fmt::format("{}", value));
  }
  void choice(const Field&, std::size_t&, std::span<const char* const>) override {}
  void table(const Field& field, TableStyle, const Inside& inside) override {
    BoundsCheck check(join(path_, field.key));
    inside(check);
  }
  void list(const Field& field, const List& list) override {
    for (std::size_t k = 0; k < list.size(); ++k) {
      BoundsCheck check(join(path_, fmt::format("{}.{}", field.key, k)));
      list.describe(k, check);
    }
  }
  void array(const Field& field, const List& entries) override {
    BoundsCheck check(join(path_, field.key));
    for (std::size_t k = 0; k < entries.size(); ++k) entries.describe(k, check);
  }
  void grid(const Field&, ParameterGrid&) override {}

 private:
  void require(const Field& field, double value, const std::string& key) const {
    if (!field.bounds.contains(value)) refuse(field, value, key, to_toml(value));
  }

  [[noreturn]] void refuse(const Field& field, double value, const std::string& key,
                           const std::string& shown) const {
    throw BadValue(join(path_, key),
                   fmt::format("is {}, but {}", shown, requirement(field.bounds, value)));
  }

  std::string path_;
};

}  // namespace

void read_parameters(const TomlNode& root, const FieldVisitor::Inside& describe,
                     const std::function<void()>& validate) {
  Reader reader(root, "");
  describe(reader);
  reader.refuse_unknown_keys();
  try {
    validate();
  } catch (const BadValue& bad) {
    throw UserError(locate(root, bad.key) + ": " + bad.what());
  }
}

std::optional<ParameterDifference> first_difference(
    const std::string& first, const std::string& second,
    const std::function<bool(const std::string& key)>& harmless) {
  std::map<std::string, std::string> left, right;
  flatten_values(parse_toml(first, "first"), "", left);
  flatten_values(parse_toml(second, "second"), "", right);
  std::map<std::string, ParameterDifference> rows;
  for (const auto& [key, value] : left) rows[key] = {key, value, "nothing"};
  for (const auto& [key, value] : right)
    rows.try_emplace(key, ParameterDifference{key, "nothing", ""}).first->second.second = value;
  for (const auto& [key, row] : rows)
    if (row.first != row.second && !harmless(key)) return row;
  return std::nullopt;
}

void check_bounds(const FieldVisitor::Inside& describe) {
  BoundsCheck check("");
  describe(check);
}

}  // namespace vitrel
