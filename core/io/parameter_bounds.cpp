#include <fmt/format.h>

#include "core/io/parameters.h"

namespace vitrel {
namespace {

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
    BoundsCheck check(below(field.key));
    inside(check);
  }
  void list(const Field& field, const List& list) override {
    for (std::size_t k = 0; k < list.size(); ++k) {
      BoundsCheck check(below(fmt::format("{}.{}", field.key, k)));
      list.describe(k, check);
    }
  }
  void array(const Field& field, const List& entries) override {
    BoundsCheck check(below(field.key));
    for (std::size_t k = 0; k < entries.size(); ++k) entries.describe(k, check);
  }
  void grid(const Field&, ParameterGrid&) override {}

 private:
  std::string below(const std::string& key) const {
    return path_.empty() ? key : path_ + "." + key;
  }

  void require(const Field& field, double value, const std::string& key) const {
    if (!field.bounds.contains(value)) refuse(field, value, key, to_toml(value));
  }

  [[noreturn]] void refuse(const Field& field, double value, const std::string& key,
                           const std::string& shown) const {
    throw BadValue(below(key),
                   fmt::format("is {}, but {}", shown, requirement(field.bounds, value)));
  }

  std::string path_;
};

}  // namespace

void check_bounds(const FieldVisitor::Inside& describe) {
  BoundsCheck check("");
  describe(check);
}

}  // namespace vitrel
