#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "analysis/dynamics/multiple_tau.h"
#include "analysis/results.h"
#include "workflow/configuration/parameters.h"

/// @file
/// The correlations that a run measures on the fly, and the file `<output>.correlations.h5` that stores them with
/// every checkpoint. It has the format of results.h: a table correlations_<group> for all particles and for every
/// species, and the table wave_numbers, whose row k holds the q of the column fs_k.
namespace vitrel {

std::filesystem::path correlations_path(const std::filesystem::path& run);

/// The correlator of a run; none if the parameters do not ask for correlations. It covers time differences up to
/// output.correlations.longest_lag, by default half the run.
template <int Dim>
std::optional<MultipleTau<Dim>> correlator(const Parameters& parameters,
                                           const Configuration<Dim>& configuration);
/// The memory of the correlator without its sums, whose size does not depend on the number of particles.
double correlator_bytes(const Parameters& parameters);

/// Writes the file atomically, as write_results does. Throws FileError.
void write_correlations(const std::filesystem::path& run, const Parameters& parameters,
                        std::vector<CorrelatedGroup> groups,
                        const std::vector<double>& wave_numbers);
/// Removes the file that an earlier run of this name left, if there is one. Throws FileError.
void forget_correlations(const std::filesystem::path& run);

/// The tables of the file under the names that the analysis of the run gives them: on_the_fly_<group> and
/// on_the_fly_wave_numbers. There are none if there is no file. Throws FileError.
std::vector<Table> on_the_fly_tables(const std::filesystem::path& run);

/// @name Runs that end as soon as their relaxation is known
/// The relaxation time is measured by a correlator on the fly (relaxation.h). It is the time in which F_s at its
/// first wave number falls to 1/e, or L_2 of the rotors (P_2 in space), whichever takes longer. It is evaluated at
/// the times at_most/2^k only, so that neither threads nor stops and restarts change when a run ends. A stop that
/// depends on the measurement biases it: of runs of equal length, those end in which relaxation happens to be fast.
/// @{
/// Whether one of the times at_most/2^k, k = 0, 1, 2 …, lies within the interval that ends now.
bool is_time_to_look(double time, double interval, double at_most);
/// The relaxation time of all particles as measured so far; NaN if it is not known yet.
double known_relaxation(const CorrelatedGroup& all, int dimension);
/// @}

}  // namespace vitrel
