#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/io/parameters.h"
#include "core/state/species.h"

/// @file
/// Distributions in the parameter file: a number, or a table instead.
namespace vitrel {

/// Sizes are relative to 1, ratios to one another: a thousandth is as small as they may sensibly be.
inline constexpr double min_draw = 0.001;
/// Lengths and ratios beyond have no use; far beyond, volumes and masses would not be finite.
inline constexpr double max_draw = 1e6;

Distribution constant(double value);
/// A number in the template of the parameter file; as a table, it draws above `minimum`.
Distribution example_of(double value, double minimum = min_draw);

void describe_distribution(const Field& field, Distribution& d, FieldVisitor& visit);

/// The entries of an array, each a number or a distribution. A vector may have any number of them.
template <class Entries>
void describe_distributions(const Field& field, Entries& entries, FieldVisitor& visit) {
  visit.array(field, entries, example_of(1), describe_distribution);
}

/// Throws BadValue with `key` or a key in its table.
void validate_distribution(const Distribution& d, double least, const std::string& key);

/// In words, for messages.
std::string text(const Distribution& d);
std::string text(const std::vector<Distribution>& entries);

bool same(const Distribution& one, const Distribution& two);

/// How well a constant must agree with a number.
enum class Agreement {
  rounding,  ///< but for the rounding of shapes that were computed from ratios and sizes
  digits  ///< to the digits given, of which three count at least: 0.5 agrees with 0.5004, 0.898242 with 0.8982416
};
bool agree(double given, double found, Agreement agreement);
/// Nothing if one of them is drawn.
std::optional<double> constant_product(const std::vector<Distribution>& factors);

/// Whether the value can have been drawn.
bool allows(const Distribution& d, double value, Agreement agreement = Agreement::rounding);
/// The same for values in any order.
bool allow(const std::vector<Distribution>& entries, std::vector<double> values,
           Agreement agreement = Agreement::rounding);

}  // namespace vitrel
