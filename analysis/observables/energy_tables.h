#pragma once

#include <vector>

#include "analysis/dynamics/energy.h"
#include "analysis/observables/observable.h"
#include "analysis/results.h"

namespace vitrel {

/// Returns tables of energies and of the compressibility factor in the course of a run; there are none for a single
/// sample.
std::vector<Table> energy_tables(const EnergySeries& energy, const CompressibilitySeries& z);

/// Returns the descriptions of these tables, in their order.
std::vector<Observable> energy_observables();

}  // namespace vitrel
