#pragma once

#include "analysis/dynamics/multiple_tau.h"

/// @file
/// Runs that end as soon as their relaxation is known.
///
/// The relaxation time is that of a correlator on the fly (relaxation.h): the time in which F_s at its first wave number
/// falls to 1/e, or L_2 of the rotors (P_2 in space), whichever takes longer. It is looked at after at_most/2^k, so that
/// neither threads nor stops and restarts change when a run ends. To stop by what is measured biases it: of runs of one
/// length those end in which relaxation happens to be fast.
namespace vitrel {

/// Whether at_most/2^k, k = 0, 1, 2 …, lies within the interval that ends now.
bool is_time_to_look(double time, double interval, double at_most);

/// The relaxation time so far; NaN if it is not known.
template <int Dim>
double known_relaxation(const MultipleTau<Dim>& correlator);

}  // namespace vitrel
