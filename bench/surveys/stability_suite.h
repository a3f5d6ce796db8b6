#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/methods/collision_case.h"

namespace vitrel::bench {

/// A class of cases, generated from a seed.
template <int Dim>
struct CaseClassOf {
  std::string name;     ///< "grazing"
  std::string meaning;  ///< what all its cases have in common, in one sentence
  /// The larger aspect ratio of the pairs; classes that draw it draw from 1 to this.
  double aspect_ratio = 2;
  /// Case number `index`; a pure function of its arguments that any thread may call.
  std::function<CollisionCaseOf<Dim>(std::uint64_t seed, std::uint64_t index)> make;
};
using CaseClass = CaseClassOf<2>;

/// All classes of the stability suite, each of which some method fails on; those that make sense at
/// any aspect ratio once for 2 and once for 6.
std::vector<CaseClass> stability_suite();

template <int Dim>
CollisionCaseOf<Dim> make_case(const CaseClassOf<Dim>& of, std::uint64_t seed,
                               std::uint64_t index) {
  return of.make(seed, index);
}

}  // namespace vitrel::bench
