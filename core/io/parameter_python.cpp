#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "core/io/parameter_words.h"
#include "core/io/parameters.h"
#include "core/io/quantity.h"

namespace vitrel {
namespace {

struct PythonField {
  std::string name, type, value, meaning;
};

struct PythonClass {
  std::string name, meaning;
  bool is_section = false;
  std::string discriminator,
      choice;  ///< of a table with several forms: the key and the word that select this one
  std::vector<PythonField> fields;

  bool has_form_of(const PythonClass& other) const {
    return discriminator == other.discriminator && choice == other.choice &&
           std::ranges::equal(fields, other.fields, {}, &PythonField::name, &PythonField::name);
  }
};

/// Returns the name of a class for a key: PowerLaw for "power_law".
std::string class_name(const std::string& key) {
  std::string name;
  bool begins = true;
  for (const char c : key) {
    if (c != '_') name += begins ? static_cast<char>(std::toupper(c)) : c;
    begins = c == '_';
  }
  return name;
}

/// Returns what a sentence like "Method. insert: random positions; lattice: regular positions." says of one word, or
/// the whole sentence if it says nothing.
std::string about(const std::string& word, const std::string& sentence) {
  const std::size_t begin = sentence.find(word + ": ");
  if (begin == std::string::npos) return sentence;
  std::string text = sentence.substr(begin + word.size() + 2);
  text = text.substr(0, text.find_first_of(";.")) + ".";
  text[0] = static_cast<char>(std::toupper(text[0]));
  return text;
}

/// The classes of all tables. Equal tables, such as those of all distributions, share a class.
class PythonClasses {
 public:
  explicit PythonClasses(std::vector<std::string> reserved) : reserved_(std::move(reserved)) {}

  /// Adds a class and returns the name that it gets, which is `longer_name` if another class has its own name.
  std::string add(PythonClass added, const std::string& longer_name) {
    const auto same = std::ranges::find(classes_, added.name, &PythonClass::name);
    const bool is_reserved = std::ranges::find(reserved_, added.name) != reserved_.end();
    if (is_reserved || (same != classes_.end() && !same->has_form_of(added))) {
      added.name = longer_name;
      return add(std::move(added), longer_name);
    }
    if (same == classes_.end())
      classes_.push_back(added);
    else
      merge(added.fields, same->fields);
    return added.name;
  }
  const std::vector<PythonClass>& all() const { return classes_; }

 private:
  /// A default that differs between two places of the class becomes None.
  static void merge(const std::vector<PythonField>& from, std::vector<PythonField>& fields) {
    for (std::size_t k = 0; k < fields.size(); ++k) {
      if (fields[k].value == from[k].value || fields[k].value == "None") continue;
      fields[k].value = "None";
      fields[k].type += " | None";
    }
  }

  std::vector<std::string> reserved_;
  std::vector<PythonClass> classes_;
};

/// The fields of one table; the tables in it become classes.
class PythonTable final : public FieldVisitor {
 public:
  /// `form` is the choice by the discriminator, for a table that has several forms.
  PythonTable(PythonClasses& classes, std::string path, std::string discriminator = "",
              std::size_t form = 0)
      : classes_(classes),
        path_(std::move(path)),
        discriminator_(std::move(discriminator)),
        form_(form) {}

  using FieldVisitor::field;
  void field(const Field& field, bool& value) override {
    put(field, "bool", value ? "True" : "False");
  }
  void field(const Field& field, double& value) override { put(field, "float", to_toml(value)); }
  void field(const Field& field, std::string& value) override {
    put(field, "str", to_toml(std::string_view(value)));
  }
  void quantity(const Field& field, double& value) override {
    put(field, "str", to_toml(std::string_view(quantity_text(value, field.unit))));
  }
  void numbers(const Field& field, std::span<double> values) override {
    put(field, "Numbers", values.empty() ? "()" : fmt::format("({},)", fmt::join(values, ", ")));
  }
  void field(const Field& field, std::vector<double>& values) override { numbers(field, values); }
  void number_or_numbers(const Field& field, std::vector<double>& values) override {
    put(field, "float | Numbers", to_toml(values[0]));
  }
  void integer(const Field& field, std::int64_t& value, std::int64_t, std::int64_t) override {
    put(field, "int", fmt::format("{}", value));
  }
  void choice(const Field& field, std::size_t& index, std::span<const char* const> names) override {
    choices_.try_emplace(
        field.key, Choice{field.sentence, std::vector<std::string>(names.begin(), names.end())});
    if (field.key == discriminator_)
      index = form_;
    else
      put(field, fmt::format("Literal[\"{}\"]", fmt::join(names, "\", \"")),
          fmt::format("\"{}\"", names[index]));
  }
  void table(const Field& field, TableStyle, const Inside& inside) override {
    if (path_.empty())
      add_section(field, inside);
    else
      put(field, classes_of(field, inside) + " | Keys", "None");
  }
  void list(const Field& field, const List& list) override {
    put(field, fmt::format("Sequence[{} | Keys]", classes_of(field, list.describe_blank)), "()");
  }
  void value_or_table(const Field& field, bool&, const Inside& value,
                      const Inside& inside) override {
    const PythonField single = single_field(value);
    put(field, fmt::format("{} | {} | Keys", single.type, classes_of(field, inside)), single.value);
  }
  void array(const Field& field, const List& entries) override {
    const PythonField entry =
        single_field([&](FieldVisitor& visit) { entries.describe(0, visit); });
    put(field, fmt::format("Sequence[{}] | Array", entry.type), "()");
  }
  void optional(const Field&, bool&, const Inside& inside) override {
    const std::size_t before = fields_.size();
    inside(*this);
    for (std::size_t k = before; k < fields_.size(); ++k) {
      fields_[k].value = "None";
      fields_[k].type += " | None";
    }
  }
  void when(bool condition, const std::string& label, const Inside& inside) override {
    const std::string key = label.substr(0, label.find(" = "));
    if (depth_ == 0 && found_.empty() && choices_.contains(key)) found_ = key;
    if (key == discriminator_ && !condition) return;
    ++depth_;
    inside(*this);
    --depth_;
  }
  void grid(const Field& field, ParameterGrid&) override {
    put(field, "Mapping[str, Sequence[Any]]", "None");
  }

  const std::vector<PythonField>& fields() const { return fields_; }

 private:
  struct Choice {
    std::string sentence;
    std::vector<std::string> names;
  };

  void put(const Field& field, const std::string& type, const std::string& value) {
    const std::string name = field.key == "from" ? "from_" : field.key;
    fields_.push_back({name, type, value, explanation(field, "")});
  }

  PythonField single_field(const Inside& inside) {
    PythonTable table(classes_, path_);
    inside(table);
    return table.fields_.back();
  }

  void add_section(const Field& field, const Inside& inside) {
    PythonTable table(classes_, field.key);
    inside(table);
    const std::string name = class_name(field.key);
    classes_.add({name, field.sentence, true, "", "", table.fields_}, name + "Section");
  }

  /// Returns the class of a table, or "One | Another | …" for a table that has several forms.
  std::string classes_of(const Field& field, const Inside& inside) {
    const std::string name = class_name(field.key);
    PythonTable all(classes_, field.key);
    inside(all);
    if (all.found_.empty())
      return classes_.add({name, field.sentence, false, "", "", all.fields_},
                          class_name(path_) + name);
    const Choice& choice = all.choices_.at(all.found_);
    std::vector<std::string> classes;
    for (std::size_t k = 0; k < choice.names.size(); ++k) {
      PythonTable form(classes_, field.key, all.found_, k);
      inside(form);
      const std::string form_name = class_name(choice.names[k]);
      classes.push_back(classes_.add({form_name, about(choice.names[k], choice.sentence), false,
                                      all.found_, choice.names[k], form.fields_},
                                     form_name + name));
    }
    return fmt::format("{}", fmt::join(classes, " | "));
  }

  PythonClasses& classes_;
  std::string path_;
  std::string discriminator_;
  std::size_t form_;
  std::map<std::string, Choice> choices_;
  std::string found_;  ///< the first choice that other fields of the table depend on
  int depth_ = 0;      ///< depth of nested conditions
  std::vector<PythonField> fields_;
};

std::string field_documentation(const PythonField& field, bool is_section) {
  std::string text = field.meaning;
  if (is_section && field.value != "None" && field.value != "()")
    text += fmt::format(" Default: {}.", field.value);
  return "    " + wrapped(field.name + ": " + text, "        ", 120).substr(8);
}

std::string class_text(const PythonClass& c) {
  std::string text = c.is_section
                         ? fmt::format("class {}(TypedDict, total=False):\n", c.name)
                         : fmt::format("@dataclass(kw_only=True)\nclass {}(Setting):\n", c.name);
  text += wrapped("\"\"\"" + c.meaning, "    ", 120) + "\n";
  for (const PythonField& field : c.fields) text += field_documentation(field, c.is_section);
  text += "    \"\"\"\n\n";
  if (!c.discriminator.empty())
    text += fmt::format("    _form: ClassVar = (\"{}\", \"{}\")\n", c.discriminator, c.choice);
  for (const PythonField& field : c.fields)
    text += fmt::format("    {}: {}{}\n", field.name, field.type,
                        c.is_section ? "" : " = " + field.value);
  return text;
}

}  // namespace

std::string python_parameters(const FieldVisitor::Inside& describe,
                              const std::vector<std::string>& reserved) {
  PythonClasses classes(reserved);
  PythonTable root(classes, "");
  describe(root);
  std::string names, text;
  for (const PythonClass& c : classes.all()) {
    if (!c.is_section) names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", c.name);
    text += "\n\n" + class_text(c);
  }
  return "__all__ = [\n" + wrapped(names, "    ", 120) + "]\n" + text;
}

}  // namespace vitrel
