#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/io/parameter_words.h"
#include "core/io/parameters.h"
#include "core/io/quantity.h"

namespace vitrel {
namespace {

std::string choices_text(std::span<const char* const> names) {
  return fmt::format("\"{}\"", fmt::join(names, "\" | \""));
}

// Turns fields into "key, TOML text of the value"; the derived class decides what becomes of them.
class ValueVisitor : public FieldVisitor {
 public:
  using FieldVisitor::field;
  void field(const Field& field, bool& value) override { put(field, value ? "true" : "false", ""); }
  void field(const Field& field, double& value) override { put(field, to_toml(value), ""); }
  void field(const Field& field, std::string& value) override {
    put(field, to_toml(std::string_view(value)), "");
  }
  void quantity(const Field& field, double& value) override {
    put(field, to_toml(std::string_view(quantity_text(value, field.unit))), "");
  }
  void numbers(const Field& field, std::span<double> values) override {
    put(field, to_toml(values), "");
  }
  void field(const Field& field, std::vector<double>& values) override {
    put(field, to_toml(std::span<const double>(values)), "");
  }
  void integer(const Field& field, std::int64_t& value, std::int64_t, std::int64_t) override {
    put(field, fmt::format("{}", value), "");
  }
  void choice(const Field& field, std::size_t& index, std::span<const char* const> names) override {
    put(field, to_toml(std::string_view(names[index])), choices_text(names));
  }
  void array(const Field& field, const List& entries) override;

 protected:
  /// `choices` lists the words that a choice may be; it is empty for other fields.
  virtual void put(const Field& field, const std::string& value, const std::string& choices) = 0;
};

// Writes the applicable fields of an inline table as "key = value, …", or their values only.
class InlineWriter final : public ValueVisitor {
 public:
  std::string text() const {
    std::vector<std::string> items;
    for (const auto& [key, value] : items_)
      items.push_back(fmt::format("{} = {}", toml_key(key), value));
    return fmt::format("{{ {} }}", fmt::join(items, ", "));
  }
  std::string values() const {
    std::vector<std::string> items;
    for (const auto& [key, value] : items_) items.push_back(value);
    return fmt::format("[{}]", fmt::join(items, ", "));
  }
  /// The value of the last field.
  const std::string& value() const { return items_.back().second; }
  const std::string& choices() const { return choices_; }

  void table(const Field& field, TableStyle, const Inside& inside) override {
    InlineWriter inner;
    inside(inner);
    put(field, inner.text(), "");
  }
  void list(const Field& field, const List& list) override {
    std::vector<std::string> tables;
    for (std::size_t i = 0; i < list.size(); ++i) {
      InlineWriter inner;
      list.describe(i, inner);
      tables.push_back(inner.text());
    }
    put(field, fmt::format("[{}]", fmt::join(tables, ", ")), "");
  }
  void grid(const Field& field, ParameterGrid& grid) override {
    std::vector<std::string> rows;
    for (const auto& [key, values] : grid)
      rows.push_back(fmt::format("{} = [{}]", toml_key(key), fmt::join(values, ", ")));
    put(field, fmt::format("{{ {} }}", fmt::join(rows, ", ")), "");
  }

 private:
  void put(const Field& field, const std::string& value, const std::string& choices) override {
    items_.emplace_back(field.key, value);
    choices_ = choices;
  }

  std::vector<std::pair<std::string, std::string>> items_;
  std::string choices_;  ///< choices of the last field
};

void ValueVisitor::array(const Field& field, const List& entries) {
  InlineWriter writer;
  for (std::size_t k = 0; k < entries.size(); ++k) entries.describe(k, writer);
  put(field, writer.values(), "");
}

/// The text of a single field, and the words that it may be.
struct SingleValue {
  std::string text, choices;
};

SingleValue single_value(const FieldVisitor::Inside& inside) {
  InlineWriter writer;
  inside(writer);
  return {writer.value(), writer.choices()};
}

std::string inline_text(const FieldVisitor::Inside& inside) {
  InlineWriter writer;
  inside(writer);
  return writer.text();
}

// Writes the fields of a document, with comments (template) or without (effective parameters).
class DocumentWriter final : public ValueVisitor {
 public:
  DocumentWriter(bool comments, std::string path) : comments_(comments), path_(std::move(path)) {}

  const std::string& text() const { return text_; }

  void table(const Field& field, TableStyle style, const Inside& inside) override {
    if (style == TableStyle::section) {
      section(field, inside);
      return;
    }
    comment(field, "");
    comment_inline_fields(inside);
    line(field, inline_text(inside));
  }

  void list(const Field& field, const List& list) override {
    for (std::size_t i = 0; i < list.size(); ++i) {
      // Only the first entry is explained.
      DocumentWriter entry(comments_ && i == 0, joined(field.key));
      list.describe(i, entry);
      blank_line();
      if (i == 0) comment(field, "");
      text_ += fmt::format("[[{}]]\n{}", joined(field.key), entry.text());
    }
  }

  void value_or_table(const Field& field, bool& is_table, const Inside& value,
                      const Inside& inside) override {
    const SingleValue single = single_value(value);
    comment(field, single.choices);
    comment_inline_fields(inside);
    line(field, is_table ? inline_text(inside) : single.text);
  }

  void optional(const Field&, bool& present, const Inside& inside) override {
    if (present || comments_) commented_out(!present, inside);
  }

  void when(bool condition, const std::string& label, const Inside& inside) override {
    if (!condition && !comments_) return;
    if (!condition) text_ += wrapped("Only with " + label + ":", indent());
    commented_out(!condition, inside);
  }

  void grid(const Field& field, ParameterGrid& grid) override {
    if (grid.empty() && !comments_) return;
    blank_line();
    comment(field, "");
    text_ += fmt::format("[{}]\n", joined(field.key));
    for (const auto& [key, values] : grid)
      text_ += fmt::format("{} = [{}]\n", toml_key(key), fmt::join(values, ", "));
  }

 private:
  std::string joined(const std::string& key) const {
    return path_.empty() ? key : path_ + "." + key;
  }
  std::string indent() const { return "# "; }

  void blank_line() {
    if (!text_.empty()) text_ += "\n";
  }

  void section(const Field& field, const Inside& inside) {
    DocumentWriter section(comments_, joined(field.key));
    section.out_ = out_;
    inside(section);
    if (section.text().empty()) return;
    blank_line();
    comment(field, "");
    // A section that holds only sections of its own needs no heading.
    if (section.text().front() != '[')
      text_ += fmt::format("{}[{}]\n", out_ ? "# " : "", joined(field.key));
    text_ += section.text();
  }

  void comment(const Field& field, const std::string& choices) {
    if (comments_) text_ += wrapped(explanation(field, choices), "# ");
  }

  void comment_inline_fields(const Inside& inside);

  void line(const Field& field, const std::string& value) {
    text_ += fmt::format("{}{} = {}\n", out_ ? "# " : "", toml_key(field.key), value);
  }

  void commented_out(bool out, const Inside& inside) {
    const bool outer = out_;
    out_ = out_ || out;
    inside(*this);
    out_ = outer;
  }

  void put(const Field& field, const std::string& value, const std::string& choices) override {
    comment(field, choices);
    line(field, value);
  }

  bool comments_;
  bool out_ = false;  ///< lines are written behind a #
  std::string path_;
  std::string text_;
};

// Writes comment lines for the fields of an inline table, which has no room for comments of its own.
class InlineComments final : public ValueVisitor {
 public:
  const std::string& text() const { return text_; }

  void table(const Field& field, TableStyle, const Inside& inside) override {
    put(field, "", "");
    inside(*this);
  }
  void list(const Field& field, const List& list) override {
    put(field, "", "");
    list.describe_blank(*this);
  }
  void value_or_table(const Field& field, bool&, const Inside& value, const Inside&) override {
    put(field, "", single_value(value).choices);
  }
  void optional(const Field&, bool&, const Inside& inside) override { inside(*this); }
  void when(bool, const std::string& label, const Inside& inside) override {
    const std::string outer = label_;
    label_ = fmt::format(" (with {})", label);
    inside(*this);
    label_ = outer;
  }
  void grid(const Field& field, ParameterGrid&) override { put(field, "", ""); }

 private:
  void put(const Field& field, const std::string&, const std::string& choices) override {
    text_ +=
        wrapped(fmt::format("{}{}: {}", field.key, label_, explanation(field, choices)), "#   ");
  }

  std::string label_;
  std::string text_;
};

void DocumentWriter::comment_inline_fields(const Inside& inside) {
  if (!comments_) return;
  InlineComments inner;
  inside(inner);
  text_ += inner.text();
}

// Writes one Markdown table per section; fields of inline tables become rows key.field.
class TableWriter final : public ValueVisitor {
 public:
  explicit TableWriter(std::string path) : path_(std::move(path)) {}

  std::string text() const {
    std::string result;
    if (!rows_.empty())
      result = "| key | default | unit | meaning |\n|---|---|---|---|\n" + rows_ + "\n";
    return result + sections_;
  }

  void table(const Field& field, TableStyle style, const Inside& inside) override {
    if (style == TableStyle::section)
      section(field, "[{}]", inside);
    else
      row_with_fields(field, inline_text(inside), inside);
  }
  void list(const Field& field, const List& list) override {
    section(field, "[[{}]]", list.describe_blank);
  }
  void value_or_table(const Field& field, bool& is_table, const Inside& value,
                      const Inside& inside) override {
    const SingleValue single = single_value(value);
    row_with_fields(field, is_table ? inline_text(inside) : single.text, inside, single.choices);
  }
  void optional(const Field&, bool& present, const Inside& inside) override {
    const bool outer = absent_;
    absent_ = !present;
    inside(*this);
    absent_ = outer;
  }
  void when(bool, const std::string& label, const Inside& inside) override {
    const std::string outer = label_;
    label_ = fmt::format("With `{}`: ", label);
    inside(*this);
    label_ = outer;
  }
  void grid(const Field& field, ParameterGrid&) override {
    section(field, "[{}]", [](FieldVisitor&) {});
  }

 private:
  void section(const Field& field, const char* brackets, const Inside& inside) {
    const std::string path = path_.empty() ? field.key : path_ + "." + field.key;
    TableWriter inner(path);
    inside(inner);
    sections_ += fmt::format("## `{}`\n\n{}\n\n{}", fmt::format(fmt::runtime(brackets), path),
                             explanation(field, ""), inner.text());
  }

  void row_with_fields(const Field& field, const std::string& value, const Inside& inside,
                       const std::string& choices = "") {
    put(field, value, choices);
    const std::string outer = prefix_;
    const bool outer_absent = absent_;
    prefix_ += field.key + ".";
    absent_ = false;
    inside(*this);
    prefix_ = outer;
    absent_ = outer_absent;
  }

  void put(const Field& field, const std::string& value, const std::string& choices) override {
    std::string meaning = label_ + field.sentence;
    if (!choices.empty()) meaning += fmt::format(" One of `{}`.", choices);
    std::string escaped;
    for (const char c : meaning) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
    rows_ += fmt::format("| `{}{}` | {} | {} | {} |\n", prefix_, field.key,
                         absent_ ? "none" : "`" + value + "`", field.unit, escaped);
  }

  std::string path_, prefix_, label_, rows_, sections_;
  bool absent_ = false;
};

/// Looks for the rest of a dotted key among the fields of one table.
class FieldFinder final : public ValueVisitor {
 public:
  FieldFinder(std::string rest, std::optional<Field>& found)
      : rest_(std::move(rest)), found_(found) {}

  void table(const Field& field, TableStyle, const Inside& inside) override {
    put(field, "", "");
    if (const auto rest = behind(field.key)) search(*rest, inside);
  }
  void list(const Field& field, const List& list) override {
    if (const auto rest = behind(field.key))
      if (const std::size_t dot = rest->find('.'); dot != std::string::npos)
        search(rest->substr(dot + 1), list.describe_blank);
  }
  void value_or_table(const Field& field, bool&, const Inside& value,
                      const Inside& inside) override {
    value(*this);
    if (const auto rest = behind(field.key)) search(*rest, inside);
  }
  void array(const Field& field, const List&) override {
    if (behind(field.key)) found_ = field;
    put(field, "", "");
  }
  void optional(const Field&, bool&, const Inside& inside) override { inside(*this); }
  void when(bool, const std::string&, const Inside& inside) override { inside(*this); }
  void grid(const Field&, ParameterGrid&) override {}

 private:
  void put(const Field& field, const std::string&, const std::string&) override {
    if (!found_ && field.key == rest_) found_ = field;
  }

  /// Returns what follows a key and a dot, if the rest begins with them.
  std::optional<std::string> behind(const std::string& key) const {
    if (!rest_.starts_with(key + ".")) return std::nullopt;
    return rest_.substr(key.size() + 1);
  }

  void search(const std::string& rest, const Inside& inside) {
    FieldFinder finder(rest, found_);
    inside(finder);
  }

  std::string rest_;
  std::optional<Field>& found_;
};

}  // namespace

std::string Field::short_name() const {
  if (!symbol.empty()) return symbol;
  std::string words = key;
  std::ranges::replace(words, '_', ' ');
  return words;
}

std::optional<Field> find_field(const FieldVisitor::Inside& describe,
                                const std::string& dotted_key) {
  std::optional<Field> found;
  FieldFinder finder(dotted_key, found);
  describe(finder);
  return found;
}

std::string write_parameters(const FieldVisitor::Inside& describe) {
  DocumentWriter writer(false, "");
  describe(writer);
  return writer.text();
}

std::string parameter_template(const FieldVisitor::Inside& describe) {
  DocumentWriter writer(true, "");
  describe(writer);
  return writer.text();
}

std::string parameter_tables(const FieldVisitor::Inside& describe) {
  TableWriter writer("");
  describe(writer);
  return writer.text();
}

}  // namespace vitrel
