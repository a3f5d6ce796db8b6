#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/results.h"
#include "core/io/json.h"

/// @file
/// The keys of a sweep as axes of tables and charts.
namespace vitrel {

/// The dotted keys that a sweep runs through, with the JSON text of their values.
using SweptValues = std::vector<std::pair<std::string, std::string>>;
SweptValues swept_values(const Json& values);

inline constexpr const char* seed_key = "system.seed";

/// The part of a key after its last dot: "packing_fraction" for "system.packing_fraction".
std::string last_part(const std::string& key);

/// A key that a sweep runs through.
struct StudyAxis {
  std::string key;     ///< dotted
  std::string symbol;  ///< "φ", or words such as "growth rate"
  std::string unit;    ///< "1" for pure numbers and categories
  /// The value of each job: a number, or the index of its category in `labels`. An array counts by its first entry if
  /// its other entries are constant or proportional to the first; otherwise it is a category, as words are.
  std::vector<double> value;
  std::vector<std::string> labels;  ///< the categories in the order in which they first occur

  bool is_category() const { return !labels.empty(); }
  /// The name of its column: "system_packing_fraction".
  std::string column() const { return identifier(key); }
  std::size_t distinct_values() const;
  /// The value of a job in words: "φ = 0.5" or "kind: brownian".
  std::string text(std::size_t job) const;
};

/// A published result for one job, or for all jobs of a sweep.
struct Published {
  std::string source, quantity;  ///< as in PublishedResult
  /// The value of a job, or for all jobs the exponent of the abscissa.
  double value;
  bool is_exponent;
  double from, to;  ///< range of the abscissa in which the exponent holds
};

/// The layout of a sweep.
struct StudyLayout {
  std::vector<std::string> together;  ///< keys that advance together
  std::optional<std::string> axis;    ///< key along which charts run; if none, study_axes chooses
};

/// All keys of these jobs except the seed, in their order.
std::vector<StudyAxis> study_keys(const std::vector<SweptValues>& jobs);

/// The keys whose values differ. The last one is the abscissa of charts, and the others distinguish curves. Of the
/// keys that advance together, it keeps only as many as distinguish their steps: first the key that the layout names,
/// then keys that are a number and a different one in each step, then the others in their order. The abscissa is the
/// key that the layout names, or else the key with the most different numbers, and the first of several such keys.
std::vector<StudyAxis> study_axes(std::vector<StudyAxis> keys, const StudyLayout& layout);

/// The values of all axes in words: "κ = 2, φ = 0.5"; empty without axes.
std::string axes_text(const std::vector<StudyAxis>& axes, std::size_t job);

}  // namespace vitrel
