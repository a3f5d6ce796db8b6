#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/results.h"
#include "core/io/json.h"

/// @file
/// What a sweep runs through, as tables and charts need it.
namespace vitrel {

/// Dotted keys that a sweep runs through, and the JSON text of their values.
using SweptValues = std::vector<std::pair<std::string, std::string>>;
SweptValues swept_values(const Json& values);

inline constexpr const char* seed_key = "system.seed";

/// "packing_fraction" of "system.packing_fraction".
std::string last_part(const std::string& key);

/// A key that a sweep runs through.
struct StudyAxis {
  std::string key;     ///< dotted
  std::string symbol;  ///< "φ", or in words: "growth rate"
  std::string unit;    ///< "1" for pure numbers and categories
  /// One for each job: numbers, or the places of its category in the labels. An array counts by its first entry if the
  /// others equal it, are constant or are proportional to it; otherwise it is a category, like words.
  std::vector<double> value;
  std::vector<std::string> labels;  ///< of categories, in the order in which they first occur

  bool is_category() const { return !labels.empty(); }
  /// The name of its column: "system_packing_fraction".
  std::string column() const { return identifier(key); }
  std::size_t distinct_values() const;
  /// "φ = 0.5", "kind: brownian".
  std::string text(std::size_t job) const;
};

/// What a publication says of a job, or of all jobs of a sweep.
struct Published {
  std::string source, quantity;  ///< as PublishedResult
  double value;                  ///< of the job; of all jobs: the exponent of the abscissa
  bool is_exponent;
  double from, to;  ///< where the exponent holds
};

/// How a sweep is laid out.
struct StudyLayout {
  std::vector<std::string> together;  ///< keys that advance together
  std::optional<std::string> axis;    ///< the one along which charts run; none: chosen
};

/// All keys of these jobs but the seed, in their order.
std::vector<StudyAxis> study_keys(const std::vector<SweptValues>& jobs);

/// Those of these keys that differ. The last one is the abscissa of charts, the others tell curves apart. Of keys that
/// advance together, there are only as many as tell these steps apart: the one that the layout wants, else one that is a
/// number and another one in each step, else the first ones. The abscissa is that of the layout, or else the one with the
/// most different numbers, the earlier of two.
std::vector<StudyAxis> study_axes(std::vector<StudyAxis> keys, const StudyLayout& layout);

/// "κ = 2, φ = 0.5"; empty without axes.
std::string axes_text(const std::vector<StudyAxis>& axes, std::size_t job);

}  // namespace vitrel
