#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace vitrel {

/// A value for each pair of species, the same for (a, b) and (b, a), or one value for all particles.
template <class T>
class PairsOfSpecies {
 public:
  /// Holds one value for all pairs.
  template <std::convertible_to<T> U = T>
  PairsOfSpecies(U all = {})
      : values_{T(std::move(all))} {}  // NOLINT: a value is that of all pairs
  /// Holds one value for all pairs except those that `set` changes.
  PairsOfSpecies(std::size_t species, const T& all)
      : species_(species), values_(species * species, all) {}

  void set(std::size_t one, std::size_t two, const T& value) {
    values_[one * species_ + two] = values_[two * species_ + one] = value;
  }

  bool are_the_same() const { return values_.size() == 1; }
  const T& common() const { return values_.front(); }
  const T& of(std::size_t one, std::size_t two) const { return values_[one * species_ + two]; }
  std::span<const T> values() const { return values_; }

 private:
  std::size_t species_ = 1;
  std::vector<T> values_;
};

}  // namespace vitrel
