#include "core/io/toml.h"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

#include "core/error.h"
#include "core/io/text_file.h"

// This is the only file that includes toml++.
namespace vitrel {
namespace {

std::string place(const toml::source_position& at, const std::string& name) {
  return fmt::format("{}:{}:{}", name, at.line, at.column);
}

TomlNode convert(const toml::node& node, const std::string& name);

TomlNode::Table convert_table(const toml::table& table, const std::string& name) {
  std::vector<std::pair<toml::source_position, TomlEntry>> entries;
  for (const auto& [key, child] : table) {
    const toml::source_position at = key.source().begin;
    entries.push_back({at, {std::string(key.str()), place(at, name), convert(child, name)}});
  }
  // toml++ sorts by name, but people expect the order of the file.
  std::stable_sort(entries.begin(), entries.end(),
                   [](const auto& x, const auto& y) { return x.first < y.first; });
  TomlNode::Table result;
  for (auto& entry : entries) result.push_back(std::move(entry.second));
  return result;
}

TomlNode convert(const toml::node& node, const std::string& name) {
  TomlNode result;
  result.where = place(node.source().begin, name);
  if (const auto* table = node.as_table()) {
    result.value = convert_table(*table, name);
  } else if (const auto* array = node.as_array()) {
    TomlNode::Array items;
    for (const auto& item : *array) items.push_back(convert(item, name));
    result.value = std::move(items);
  } else if (const auto* flag = node.as_boolean()) {
    result.value = flag->get();
  } else if (const auto* integer = node.as_integer()) {
    result.value = integer->get();
  } else if (const auto* real = node.as_floating_point()) {
    result.value = real->get();
  } else if (const auto* text = node.as_string()) {
    result.value = text->get();
  } else {
    throw UserError(result.where +
                    ": dates and times have no meaning here; use a number or a string");
  }
  return result;
}

std::optional<std::size_t> as_index(std::string_view part) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
  if (part.empty() || error != std::errc() || end != part.data() + part.size()) return std::nullopt;
  return index;
}

/// Returns whether a text is a word, or a number with a unit; bytes beyond ASCII may be any letter.
bool is_bare_text(std::string_view text) {
  constexpr std::string_view marks = "_-+./^ ";
  return !text.empty() && std::ranges::all_of(text, [&](char c) {
    const auto code = static_cast<unsigned char>(c);
    return std::isalnum(code) || code >= 0x80 || marks.find(c) < marks.size();
  });
}

void mark(TomlNode& node, const std::string& where) {
  node.where = where;
  if (auto* table = node.get<TomlNode::Table>())
    for (TomlEntry& entry : *table) entry.where = where, mark(entry.node, where);
  if (auto* array = node.get<TomlNode::Array>())
    for (TomlNode& item : *array) mark(item, where);
}

TomlNode override_value(const std::string& text, const std::string& option) {
  TomlNode value;
  try {
    TomlNode document = parse_toml("x = " + text, option);
    if (document.get<TomlNode::Table>()->size() != 1) throw UserError("more than one key");
    value = std::move(document.get<TomlNode::Table>()->front().node);
  } catch (const UserError&) {
    if (!is_bare_text(text))
      throw UserError(
          fmt::format("{}: '{}' is not a TOML value; write a number, true, false, a word, "
                      "\"text\", [1, 2] or {{ key = 1 }}",
                      option, text));
    value.value = text;
  }
  mark(value, option);
  return value;
}

bool begins_with_key(std::string_view path, std::string_view key) {
  return path.starts_with(key) && (path.size() == key.size() || path[key.size()] == '.');
}

// Returns the node that the first part of a dotted key leads to, null if there is none, and the length of that part. A
// key of a table may have dots itself: "system.seed" = 1.
std::pair<const TomlNode*, std::size_t> enter(const TomlNode& node, std::string_view path) {
  if (const auto* array = node.get<TomlNode::Array>()) {
    const std::string_view part = path.substr(0, path.find('.'));
    const std::optional<std::size_t> index = as_index(part);
    if (index && *index < array->size()) return {&(*array)[*index], part.size()};
  }
  if (const auto* table = node.get<TomlNode::Table>())
    for (const TomlEntry& entry : *table)
      if (begins_with_key(path, entry.key)) return {&entry.node, entry.key.size()};
  return {nullptr, 0};
}

// Returns the entry `part` of `parent`, which starts as `made` if it is missing.
TomlNode& descend(TomlNode& parent, const std::string& part, const std::string& walked,
                  const TomlNode& made, const std::string& option) {
  if (auto* array = parent.get<TomlNode::Array>()) {
    const std::optional<std::size_t> index = as_index(part);
    if (!index || *index > array->size())
      throw UserError(
          fmt::format("{}: '{}' is an array with {} entries in the file; the next part of "
                      "the key must be a number from 0 to {}, not '{}'",
                      option, walked, array->size(), array->size(), part));
    if (*index == array->size()) array->push_back(made);
    return (*array)[*index];
  }
  auto* table = parent.get<TomlNode::Table>();
  if (!table)
    throw UserError(fmt::format("{}: '{}' is the value {}, so it has no key '{}'", option, walked,
                                to_toml(parent), part));
  for (TomlEntry& entry : *table)
    if (entry.key == part) return entry.node;
  table->push_back({part, option, made});
  return table->back().node;
}

/// Returns the first part of a dotted key, or the whole key of an entry that is there, which may have dots itself
/// ("system.seed" = 1).
std::string first_key(const TomlNode& parent, std::string_view path) {
  if (const auto [child, length] = enter(parent, path); child)
    return std::string(path.substr(0, length));
  return std::string(path.substr(0, path.find('.')));
}

}  // namespace

const TomlEntry* TomlNode::find(std::string_view key) const {
  if (const Table* table = get<Table>())
    for (const TomlEntry& entry : *table)
      if (entry.key == key) return &entry;
  return nullptr;
}

TomlNode parse_toml(std::string_view text, const std::string& name) {
  try {
    TomlNode root;
    root.value = convert_table(toml::parse(text), name);
    root.where = name;
    return root;
  } catch (const toml::parse_error& error) {
    throw UserError(fmt::format("{}: not valid TOML: {}", place(error.source().begin, name),
                                error.description()));
  }
}

TomlNode read_toml_file(const std::filesystem::path& path) {
  require_regular_file(path);
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  // A folder opens like a file and fails on the first read.
  if (!file || !(text << file.rdbuf()))
    throw FileError(path.string() +
                    ": cannot be read, or is empty; a parameter file is expected "
                    "(vitrel params <command> prints one)");
  return parse_toml(text.str(), path.string());
}

void apply_override(TomlNode& root, std::string_view assignment, const std::string& option) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos || equals == 0)
    throw UserError(option + ": key=value is expected, for example --set dynamics.duration=10");
  const std::string_view key = assignment.substr(0, equals);
  TomlNode* node = &root;
  std::string walked;
  for (std::size_t begin = 0; begin <= key.size();) {
    const std::string part = first_key(*node, key.substr(begin));
    if (part.empty())
      throw UserError(fmt::format("{}: the key '{}' has an empty part", option, key));
    begin += part.size() + 1;
    const std::string_view rest = key.substr(std::min(begin, key.size()));
    TomlNode made;
    made.where = option;
    if (as_index(rest.substr(0, rest.find('.')))) made.value = TomlNode::Array();
    node = &descend(*node, part, walked, made, option);
    walked += (walked.empty() ? "" : ".") + part;
  }
  *node = override_value(std::string(assignment.substr(equals + 1)), option);
}

std::string locate(const TomlNode& root, std::string_view path) {
  const TomlNode* node = &root;
  while (!path.empty()) {
    const auto [child, length] = enter(*node, path);
    if (!child) break;
    node = child;
    path.remove_prefix(std::min(length + 1, path.size()));
  }
  return node->where;
}

std::string to_toml(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  // fmt writes the shortest text that reads back as the same double; TOML wants a point or
  // exponent.
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string to_toml(std::span<const double> values) {
  std::string joined;
  for (const double value : values) joined += (joined.empty() ? "" : ", ") + to_toml(value);
  return "[" + joined + "]";
}

std::string to_toml(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      quoted += fmt::format("\\{}", c);
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      quoted += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    else
      quoted += c;
  }
  return quoted + '"';
}

std::string toml_key(std::string_view key) {
  const bool bare = !key.empty() && std::ranges::all_of(key, [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-';
  });
  return bare ? std::string(key) : to_toml(key);
}

std::string to_toml(const TomlNode& node) {
  if (const auto* flag = node.get<bool>()) return *flag ? "true" : "false";
  if (const auto* integer = node.get<std::int64_t>()) return fmt::format("{}", *integer);
  if (const auto* real = node.get<double>()) return to_toml(*real);
  if (const auto* text = node.get<std::string>()) return to_toml(std::string_view(*text));
  std::string joined;
  const auto append = [&](const std::string& item) {
    joined += (joined.empty() ? "" : ", ") + item;
  };
  if (const auto* array = node.get<TomlNode::Array>()) {
    for (const TomlNode& item : *array) append(to_toml(item));
    return "[" + joined + "]";
  }
  for (const TomlEntry& entry : *node.get<TomlNode::Table>())
    append(toml_key(entry.key) + " = " + to_toml(entry.node));
  return joined.empty() ? "{}" : "{ " + joined + " }";
}

}  // namespace vitrel
