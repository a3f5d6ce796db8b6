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
void write_correlations(const std::filesystem::path& run, const Parameters& parameters,
                        std::vector<CorrelatedGroup> groups,
                        const std::vector<double>& wave_numbers);
/// Removes the file of an earlier run of that name, if there is one. Throws FileError.
void forget_correlations(const std::filesystem::path& run);

/// The tables of the file, as the analysis of the run names them: on_the_fly_<group> and
/// on_the_fly_wave_numbers. Empty without a file. Throws FileError.
std::vector<Table> on_the_fly_tables(const std::filesystem::path& run);

/// @name Runs that end as soon as their relaxation is known
/// The relaxation time is that of a correlator on the fly (relaxation.h): the time in which F_s at its first wave
/// number falls to 1/e, or L_2 of the rotors (P_2 in space), whichever takes longer. It is looked at after at_most/2^k,
/// so that neither threads nor stops and restarts change when a run ends. To stop by what is measured biases it: of
/// runs of one length those end in which relaxation happens to be fast.
/// @{
/// Whether at_most/2^k, k = 0, 1, 2 …, lies within the interval that ends now.
bool is_time_to_look(double time, double interval, double at_most);
/// The relaxation time so far, of all particles; NaN if it is not known.
double known_relaxation(const CorrelatedGroup& all, int dimension);
/// @}

}  // namespace vitrel
