#pragma once

#include <vector>

#include "bench/surveys/stability_suite.h"

namespace vitrel::bench {

/// What a dense run asks, for aspect ratios 2 and 6: 256 equal ellipses at packing fraction 0.7,
/// inserted and swollen, run for 50 collisions per particle; from then on, question by question in
/// the order of the run, all that the engine asks its predictor about pairs whose circumcircles
/// meet. The horizon is the engine's, that is, the time up to which an answer would count.
///
/// Case `index` is question number `index` of the run that begins from `seed`. The run is made when
/// the first case is wanted and kept, with its questions so far, until another seed is asked for.
std::vector<CaseClass> recorded_classes();

/// The stability suite, and in the plane these.
template <int Dim>
std::vector<CaseClassOf<Dim>> all_classes() {
  std::vector<CaseClassOf<Dim>> classes = stability_suite<Dim>();
  if constexpr (Dim == 2)
    for (const CaseClass& of : recorded_classes()) classes.push_back(of);
  return classes;
}

}  // namespace vitrel::bench
