#pragma once

#include <vector>

#include "bench/surveys/stability_suite.h"

namespace vitrel::bench {

/// Predictions that a dense run requests, for aspect ratios 2 and 6: 256 equal ellipses at packing fraction 0.7 are
/// inserted and swollen, and run for 50 collisions per particle. From then on, the cases are all predictions that the
/// engine requests for pairs whose circumcircles meet, in the order of the run. The horizon is that of the engine,
/// which is the time up to which an answer would count.
///
/// Case `index` is prediction number `index` of the run that begins from `seed`. The run is made when the first case
/// is needed, and is kept with its predictions until another seed is needed.
std::vector<CaseClass> recorded_classes();

/// All classes of the stability suite and, in the plane, the recorded classes.
template <int Dim>
std::vector<CaseClassOf<Dim>> all_classes() {
  std::vector<CaseClassOf<Dim>> classes = stability_suite<Dim>();
  if constexpr (Dim == 2)
    for (const CaseClass& of : recorded_classes()) classes.push_back(of);
  return classes;
}

}  // namespace vitrel::bench
