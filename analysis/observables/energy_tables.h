#pragma once

#include <vector>

#include "analysis/dynamics/energy.h"
#include "analysis/observables/observable.h"
#include "analysis/results.h"

namespace vitrel {

/// Energies and compressibility factor in the course of a run; none of a single sample.
std::vector<Table> energy_tables(const EnergySeries& energy, const CompressibilitySeries& z);

/// Those tables, in their order.
std::vector<Observable> energy_observables();

}  // namespace vitrel
