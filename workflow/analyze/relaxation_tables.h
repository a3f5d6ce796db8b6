#pragma once

#include "analysis/dynamics/cage_relative.h"
#include "analysis/dynamics/displacement.h"
#include "analysis/results.h"

namespace vitrel {

/// Adds the table `relaxation_times`: the times when F_s(q, t) and L_n(t) (in space P_n of every axis) have fallen to
/// 1/e (relaxation.h). It has one row for every group and wave number or order, and for F_s relative to the cage one
/// row for every wave number (none if `cage` is null). The provenance receives the names of the groups
/// (`group_<number>`) and the reasons why rows have no time (`relaxation_times_<row>`, counted from 0).
void store_relaxation_times(const Displacements& found, const CageRelative* cage, Results& results);

}  // namespace vitrel
