#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/io/parameters.h"
#include "core/state/species.h"

/// @file
/// Distributions in the parameter file: a key takes a number, or a table that describes a distribution.
namespace vitrel {

/// Smallest draw. Sizes are relative to 1 and ratios to one another, so nothing below a thousandth makes sense.
inline constexpr double min_draw = 0.001;
/// Largest length or ratio. Larger ones have no use, and much larger ones would make volumes and masses infinite.
inline constexpr double max_draw = 1e6;

Distribution constant(double value);
/// An example for the template of the parameter file: a number that, as a table, is a distribution above `minimum`.
Distribution example_of(double value, double minimum = min_draw);

void describe_distribution(const Field& field, Distribution& d, FieldVisitor& visit);

/// Describes the entries of an array, each a number or a distribution. A vector may have any number of entries.
template <class Entries>
void describe_distributions(const Field& field, Entries& entries, FieldVisitor& visit) {
  visit.array(field, entries, example_of(1), describe_distribution);
}

/// Throws BadValue that names `key` or a key in its table.
void validate_distribution(const Distribution& d, double least, const std::string& key);

/// The distribution in words, for messages.
std::string text(const Distribution& d);
std::string text(const std::vector<Distribution>& entries);

bool same(const Distribution& one, const Distribution& two);

/// How closely a constant must agree with a number.
enum class Agreement {
  rounding,  ///< up to the rounding of shapes computed from ratios and sizes
  /// Agreement to the digits given, but at least to three: 0.5 agrees with 0.5004, and 0.898242 with 0.8982416.
  digits
};
bool agree(double given, double found, Agreement agreement);
/// The product of the factors; no value if any factor is drawn.
std::optional<double> constant_product(const std::vector<Distribution>& factors);

/// Whether the value can have been drawn from the distribution.
bool allows(const Distribution& d, double value, Agreement agreement = Agreement::rounding);
/// Whether values in any order can have been drawn from the entries.
bool allow(const std::vector<Distribution>& entries, std::vector<double> values,
           Agreement agreement = Agreement::rounding);

}  // namespace vitrel
