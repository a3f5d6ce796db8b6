// Every number that a parameter file can hold has bounds; the few that have none are checked by rules of their own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <set>

#include "core/io/parameters.h"
#include "workflow/configuration/parameters.h"

namespace vitrel {
namespace {

/// The keys of all numbers that lack a bound, whether a scene has them or not.
class NumbersWithoutBounds final : public FieldVisitor {
 public:
  NumbersWithoutBounds(std::set<std::string>& found, std::string path)
      : found_(found), path_(std::move(path)) {}

  using FieldVisitor::field;
  void field(const Field&, bool&) override {}
  void field(const Field& field, double&) override { note(field); }
  void field(const Field&, std::string&) override {}
  void quantity(const Field& field, double&) override { note(field); }
  void numbers(const Field& field, std::span<double>) override { note(field); }
  void field(const Field& field, std::vector<double>&) override { note(field); }
  void integer(const Field&, std::int64_t&, std::int64_t, std::int64_t) override {
  }  // have their type's
  void choice(const Field&, std::size_t&, std::span<const char* const>) override {}
  void table(const Field& field, TableStyle, const Inside& inside) override {
    NumbersWithoutBounds below(found_, path_ + field.key + ".");
    inside(below);
  }
  void list(const Field& field, const List& list) override {
    table(field, TableStyle::section, list.describe_blank);
  }
  void value_or_table(const Field& field, bool&, const Inside& value,
                      const Inside& inside) override {
    value(*this);
    table(field, TableStyle::inline_table, inside);
  }
  void array(const Field& field, const List& entries) override {
    for (std::size_t k = 0; k < entries.size(); ++k)
      table(field, TableStyle::inline_table, [&](FieldVisitor& in) { entries.describe(k, in); });
  }
  void optional(const Field&, bool&, const Inside& inside) override { inside(*this); }
  void when(bool, const std::string&, const Inside& inside) override { inside(*this); }
  void grid(const Field&, ParameterGrid&) override {}

 private:
  void note(const Field& field) {
    if (!std::isfinite(field.bounds.low)) found_.insert(path_ + field.key);
  }

  std::set<std::string>& found_;
  std::string path_;
};

TEST(ParameterBounds, AreThoseOfEveryNumber) {
  Parameters parameters;
  std::set<std::string> found;
  NumbersWithoutBounds visit(found, "");
  fields(parameters)(visit);
  for (const std::string& key : found) {
    // Sizes are drawn from distributions (distributions.h); states are checked like those of files.
    const bool is_size = key.starts_with("species.");
    const bool is_state = std::regex_match(
        key, std::regex("prepare[.]stage[.](angles?|angular_velocities.*|orientation_tensor|"
                        "positions.*|quaternions.*|semi_axes.*|velocities.*)"));
    EXPECT_TRUE(is_size || is_state) << key;
  }
}

// What the bounds say is what a message says would be right.
TEST(ParameterBounds, AreSaidInWords) {
  EXPECT_EQ(requirement(bounds::positive, -1), "must be positive");
  EXPECT_EQ(requirement(bounds::positive, 0), "must be positive");
  EXPECT_EQ(requirement(bounds::positive, 1e30), "must lie between 1e-20 and 1e+20");
  EXPECT_EQ(requirement(bounds::positive, NAN), "must lie between 1e-20 and 1e+20");
  EXPECT_EQ(requirement(bounds::not_negative, -1), "must be 0 or more");
  EXPECT_EQ(requirement(bounds::not_negative, INFINITY), "must lie between 0 and 1e+20");
  EXPECT_EQ(requirement(bounds::at_least_one, 0.5), "must be at least 1");
  EXPECT_EQ(requirement(bounds::share, 2), "must lie between 0 and 1");
  EXPECT_EQ(requirement(bounds::share_above_none, 0), "must lie above 0 and not above 1");
  EXPECT_EQ(requirement({}, NAN), "must be a number");
  EXPECT_EQ(requirement({0, 1, false, false, "be even"}, 3), "must be even");
  for (const double bad : {-1., 0., 1e30, double{NAN}, double{INFINITY}})
    EXPECT_FALSE(bounds::positive.contains(bad)) << bad;
  EXPECT_FALSE(bounds::share_above_none.contains(0));
  EXPECT_TRUE(bounds::share_above_none.contains(1));
  EXPECT_TRUE(bounds::share.contains(0));
}

}  // namespace
}  // namespace vitrel
