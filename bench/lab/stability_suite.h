#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/lab/collision_case.h"

namespace vitrel::lab {

/// A class of cases that some method fails on, generated from a seed.
struct CaseClass {
  std::string name;     ///< "grazing"
  std::string meaning;  ///< what all its cases have in common, in one sentence
  /// The larger aspect ratio of the pairs; classes that draw it draw from 1 to this.
  double aspect_ratio = 2;
};

/// All classes of the stability suite; those that make sense at any aspect ratio once for 2 and
/// once for 6.
std::vector<CaseClass> stability_suite();

/// Case number `index` of a class; a pure function of its arguments.
CollisionCase make_case(const CaseClass& of, std::uint64_t seed, std::uint64_t index);

}  // namespace vitrel::lab
