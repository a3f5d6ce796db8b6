#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/io/toml.h"
#include "core/state/bounds.h"

/// @file
/// Parameters are plain structs. One function per struct, describe(struct, visitor), names its fields. It serves to
/// read TOML and to write the effective parameters as TOML text, the commented template and the reference page:
///
///     void describe(Dynamics& p, FieldVisitor& visit) {
///       visit.field({"duration", "time", "Length of the sampled part of the run."}, p.duration);
///     }
namespace vitrel {

struct Field {
  std::string key;
  std::string unit;             ///< "" for pure numbers, words and flags
  std::string sentence;         ///< what the field means
  Bounds bounds = {};           ///< bounds of every number of the field
  std::string former_key = {};  ///< key of earlier versions, still read; "" for none
  std::string symbol = {};      ///< "φ", for axes of charts; "" for none

  /// Returns the symbol or, without one, the key with blanks for underscores.
  std::string short_name() const;
};

/// Dotted keys and the values that each key takes, as TOML text ("0.5", "\"brownian\"").
using ParameterGrid = std::vector<std::pair<std::string, std::vector<std::string>>>;

class FieldVisitor {
 public:
  using Inside = std::function<void(FieldVisitor&)>;
  /// A section is written as [key], an inline table as key = { … }.
  enum class TableStyle { section, inline_table };
  struct List {
    std::function<std::size_t()> size;
    std::function<void(std::size_t)> resize;  ///< none for an array of fixed size
    std::function<void(std::size_t, FieldVisitor&)> describe;
    Inside describe_blank;  ///< describes a default entry
  };

  virtual ~FieldVisitor() = default;

  virtual void field(const Field&, bool&) = 0;
  virtual void field(const Field&, double&) = 0;
  virtual void field(const Field&, std::string&) = 0;
  /// A number with a unit, given as a string in any unit that converts to the field's own.
  virtual void quantity(const Field&, double&) = 0;
  /// As many numbers as `values` has elements.
  virtual void numbers(const Field&, std::span<double> values) = 0;
  /// Any number of numbers.
  virtual void field(const Field&, std::vector<double>&) = 0;
  /// A number, or an array of several.
  virtual void number_or_numbers(const Field& field, std::vector<double>& values) {
    values.size() == 1 ? this->field(field, values[0]) : this->field(field, values);
  }
  /// An integer from `low` to `high`.
  virtual void integer(const Field&, std::int64_t& value, std::int64_t low, std::int64_t high) = 0;
  /// One of `names`, given by its index.
  virtual void choice(const Field&, std::size_t& index, std::span<const char* const> names) = 0;
  virtual void table(const Field&, TableStyle, const Inside& inside) = 0;
  virtual void list(const Field&, const List& list) = 0;
  /// A value, or a table of fields instead; `is_table` tells which. `value` names the one field of the value.
  virtual void value_or_table(const Field& field, bool& is_table, const Inside& value,
                              const Inside& inside) {
    if (is_table)
      table(field, TableStyle::inline_table, inside);
    else
      value(*this);
  }
  /// An array; `describe` names the one field of each entry, whose key is its number.
  virtual void array(const Field&, const List& entries) = 0;
  /// A field that may be left out; `present` tells whether it is there. `inside` names the one field.
  virtual void optional(const Field&, bool& present, const Inside& inside) {
    if (present) inside(*this);
  }
  /// Fields that exist only under `condition`; `label` states the condition in words ("method = \"insert\"").
  virtual void when(bool condition, const std::string& /*label*/, const Inside& inside) {
    if (condition) inside(*this);
  }
  virtual void grid(const Field&, ParameterGrid&) = 0;

  template <class Int>
  requires(std::is_integral_v<Int> && !std::is_same_v<Int, bool>) void field(const Field& field,
                                                                             Int& value) {
    constexpr auto largest = std::numeric_limits<std::int64_t>::max();
    std::int64_t wide = static_cast<std::int64_t>(value);
    integer(field, wide, std::is_signed_v<Int> ? std::numeric_limits<Int>::min() : 0,
            std::in_range<std::int64_t>(std::numeric_limits<Int>::max())
                ? static_cast<std::int64_t>(std::numeric_limits<Int>::max())
                : largest);
    value = static_cast<Int>(wide);
  }

  template <std::size_t N>
  void field(const Field& field, std::array<double, N>& values) {
    numbers(field, values);
  }

  template <class Enum>
  requires std::is_enum_v<Enum>
  void field(const Field& field, Enum& value, std::span<const char* const> names) {
    std::size_t index = static_cast<std::size_t>(value);
    choice(field, index, names);
    value = static_cast<Enum>(index);
  }

  /// A value that may be left out; the template shows `example`.
  template <class T, class Describe>
  void optional(const Field& field, std::optional<T>& value, T example, Describe&& describe) {
    bool present = value.has_value();
    T inner = value.value_or(std::move(example));
    optional(field, present, [&](FieldVisitor& visit) { describe(visit, inner); });
    value = present ? std::optional<T>(std::move(inner)) : std::nullopt;
  }
  template <class T>
  void optional(const Field& field, std::optional<T>& value, T example) {
    optional(field, value, std::move(example),
             [&](FieldVisitor& visit, T& inner) { visit.field(field, inner); });
  }

  template <class T>
  void list(const Field& field, std::vector<T>& values, void (*describe)(T&, FieldVisitor&)) {
    List entries;
    entries.size = [&] { return values.size(); };
    entries.resize = [&](std::size_t n) { values.assign(n, T()); };
    entries.describe = [&](std::size_t i, FieldVisitor& visit) { describe(values[i], visit); };
    entries.describe_blank = [&](FieldVisitor& visit) {
      T blank;
      describe(blank, visit);
    };
    list(field, entries);
  }

  /// An array of entries. If they are in a vector, their number may change, and new ones are equal to `blank`.
  /// describe(field, entry, visitor) names the one field of each entry.
  template <class Entries, class Describe>
  void array(const Field& field, Entries& entries, const typename Entries::value_type& blank,
             Describe&& describe) {
    List list;
    list.size = [&] { return entries.size(); };
    if constexpr (requires { entries.clear(); })
      list.resize = [&](std::size_t count) { entries.assign(count, blank); };
    list.describe = [&](std::size_t k, FieldVisitor& visit) {
      describe(Field{std::to_string(k), "", ""}, entries[k], visit);
    };
    array(field, list);
  }
};

/// An impossible value that `validate` finds: the dotted key, and "is …, but must be …".
struct BadValue : UserError {
  BadValue(std::string dotted_key, const std::string& complaint)
      : UserError("key '" + dotted_key + "' " + complaint), key(std::move(dotted_key)) {}
  std::string key;
};

/// Reads the fields of `describe` from a document; fields that it does not mention keep their value. An unknown key or
/// a value of the wrong type throws UserError with file:line:column, what is wrong and what would be right. A BadValue
/// thrown by `validate`, which runs last, becomes such a UserError.
void read_parameters(const TomlNode& root, const FieldVisitor::Inside& describe,
                     const std::function<void()>& validate);

/// Returns the field with this dotted key, which counts the entries of lists ("species.0.mass"), whether or not a value
/// is given; nothing if there is none. An entry of an array is part of the array's field.
std::optional<Field> find_field(const FieldVisitor::Inside& describe,
                                const std::string& dotted_key);

/// Throws BadValue for the first number outside the bounds of its field.
void check_bounds(const FieldVisitor::Inside& describe);

/// Returns the fields as TOML text. Equal values give equal text, and doubles are exact to the last bit.
std::string write_parameters(const FieldVisitor::Inside& describe);

/// Returns the TOML text with every field explained; fields that may be left out are commented out.
std::string parameter_template(const FieldVisitor::Inside& describe);

/// Returns the tables of the reference page as Markdown.
std::string parameter_tables(const FieldVisitor::Inside& describe);

/// Returns Python classes: a TypedDict for every section, and for every table in a section a dataclass, or several if
/// the table has several forms, named after the table or the form. No class has a `reserved` name. All rely on names
/// that the text does not define: Setting, Keys (a table as a mapping), Numbers and Array.
std::string python_parameters(const FieldVisitor::Inside& describe,
                              const std::vector<std::string>& reserved);

/// The first dotted key in which two parameter texts (as written by write_parameters) differ, with both values. Keys
/// for which `harmless` holds are skipped.
struct ParameterDifference {
  std::string key, first, second;  ///< a missing value is "nothing"
};
std::optional<ParameterDifference> first_difference(
    const std::string& first, const std::string& second,
    const std::function<bool(const std::string& key)>& harmless);

}  // namespace vitrel
