#include <algorithm>

#include "core/io/parameters.h"

namespace vitrel {
namespace {

/// Looks for the rest of a dotted key among the fields of one table.
class FieldFinder final : public FieldVisitor {
 public:
  FieldFinder(std::string rest, std::optional<Field>& found)
      : rest_(std::move(rest)), found_(found) {}

  using FieldVisitor::field;
  void field(const Field& field, bool&) override { compare(field); }
  void field(const Field& field, double&) override { compare(field); }
  void field(const Field& field, std::string&) override { compare(field); }
  void quantity(const Field& field, double&) override { compare(field); }
  void numbers(const Field& field, std::span<double>) override { compare(field); }
  void field(const Field& field, std::vector<double>&) override { compare(field); }
  void integer(const Field& field, std::int64_t&, std::int64_t, std::int64_t) override {
    compare(field);
  }
  void choice(const Field& field, std::size_t&, std::span<const char* const>) override {
    compare(field);
  }
  void table(const Field& field, TableStyle, const Inside& inside) override {
    compare(field);
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
    compare(field);
  }
  void optional(const Field&, bool&, const Inside& inside) override { inside(*this); }
  void when(bool, const std::string&, const Inside& inside) override { inside(*this); }
  void grid(const Field&, ParameterGrid&) override {}

 private:
  void compare(const Field& field) {
    if (!found_ && field.key == rest_) found_ = field;
  }

  /// What follows a key and a dot, if the rest begins with them.
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

}  // namespace vitrel
