#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace vitrel {

struct TomlEntry;

/// A value of a TOML document together with the place where it was written: "file:line:column" for text, the option
/// itself for a value given on the command line. A table keeps the order of the document.
struct TomlNode {
  using Table = std::vector<TomlEntry>;
  using Array = std::vector<TomlNode>;

  std::variant<Table, Array, bool, std::int64_t, double, std::string> value;
  std::string where;

  template <class T>
  const T* get() const {
    return std::get_if<T>(&value);
  }
  template <class T>
  T* get() {
    return std::get_if<T>(&value);
  }
  /// Returns the entry of a table; null if this is not a table or has no such key.
  const TomlEntry* find(std::string_view key) const;
};

struct TomlEntry {
  std::string key;
  std::string where;  ///< place of the key; the value's place is node.where
  TomlNode node;
};

/// Parses a document. `name` stands for the file in the places and messages. Throws UserError with
/// name:line:column on a syntax error.
TomlNode parse_toml(std::string_view text, const std::string& name);

/// Reads and parses a file. Throws FileError if it cannot be read.
TomlNode read_toml_file(const std::filesystem::path& path);

/// Applies "key=value" to a document. The key is dotted and counts entries of arrays from 0 (species.0.aspect_ratio).
/// The value is TOML, or a bare word or number with a unit, which is taken as a string. Missing tables and the next
/// entry of an array are made. Throws UserError with `option`, the text that contained the assignment ("--set
/// dynamics.duration=10").
void apply_override(TomlNode& root, std::string_view assignment, const std::string& option);

/// Returns the place of a dotted key, or of the nearest table around it that exists.
std::string locate(const TomlNode& root, std::string_view path);

/// Returns the TOML text of a value on one line; parse_toml reads back the identical value.
std::string to_toml(const TomlNode& node);
std::string to_toml(double value);
std::string to_toml(std::span<const double> values);
std::string to_toml(std::string_view text);
/// Returns the key as it may stand in a document: quoted unless it is a bare key.
std::string toml_key(std::string_view key);

}  // namespace vitrel
