#pragma once

#include <string>

namespace vitrel {

/// Formats the value as a parameter file would hold it.
std::string show(double value);

/// A packing fraction that particles cannot exceed (packing_bound), as a number and in words.
struct PackingBound {
  double value;
  const char* text;
};

/// The rules that the values of one table must obey. Each function throws BadValue, which says what is
/// wrong and what would be right, if its rule does not hold.
class Rules {
 public:
  /// `path` is the dotted key of the table; it is empty for the whole document.
  explicit Rules(std::string path) : path_(std::move(path)) {}

  void require(bool holds, const std::string& key, const std::string& complaint) const;
  void positive(double value, const std::string& key) const;
  void not_negative(double value, const std::string& key) const;
  /// The value must lie above 0 and below the bound.
  void packing_fraction(double value, const std::string& key, const PackingBound& bound) const;

 private:
  std::string path_;
};

}  // namespace vitrel
