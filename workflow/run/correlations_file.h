#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "analysis/dynamics/multiple_tau.h"
#include "analysis/results.h"
#include "workflow/configuration/parameters.h"

/// @file
/// The correlations that a run measures on the fly, and the file `<output>.correlations.h5` they are
/// written to with every checkpoint. It has the form of results.h: a table correlations_<group> for all
/// particles and every species, and the table wave_numbers, whose row k is the q of the column fs_k.
namespace vitrel {

std::filesystem::path correlations_path(const std::filesystem::path& run);

/// None if the parameters ask for none. Time differences up to half the run.
template <int Dim>
std::optional<MultipleTau<Dim>> correlator(const Parameters& parameters,
                                           const Configuration<Dim>& configuration);
/// Its memory, but for the sums, whose size does not depend on the number of particles.
double correlator_bytes(const Parameters& parameters);

/// Atomic like write_results. Throws FileError.
template <int Dim>
void write_correlations(const std::filesystem::path& run, const Parameters& parameters,
                        const MultipleTau<Dim>& correlator);
/// Removes the file of an earlier run of that name, if there is one. Throws FileError.
void forget_correlations(const std::filesystem::path& run);

/// The tables of the file, as the analysis of the run names them: on_the_fly_<group> and
/// on_the_fly_wave_numbers. Empty without a file. Throws FileError.
std::vector<Table> on_the_fly_tables(const std::filesystem::path& run);

}  // namespace vitrel
