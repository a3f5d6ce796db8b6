#pragma once

#include <map>
#include <optional>
#include <string>

#include "analysis/results.h"
#include "core/io/foreign/foreign_frame.h"

/// @file
/// Relaxation as HTML, for one run and for the glass study: rows of tables of the page and notes below them.
namespace vitrel {

/// The results of one run: the verdict with its reason, or why there is none; Z, D and D_r; the times in which F_s
/// and L_n of all particles fall to 1/e; and in a nematic the time of L_2 seen from the director. They come from the
/// tables `relaxation` and `relaxation_times`, and rows whose table is missing are left out.
std::string result_rows(const Results& run, int dimension,
                        const std::optional<FileUnits>& units = {});

/// One row per run: its label or else φ, seed, the verdicts on translation and on all, what orientations do, q, τ_α
/// at that q, τ_2, nematic order, nematic order by chance, the plateau of L_2, and the duration. The rows come from
/// the table `relaxation` and are empty without it. `labels` maps names of runs to labels.
std::string relaxation_rows(const Results& study, const std::map<std::string, std::string>& labels);

/// One row per kind of time and law: φ_c with its error, the bound "> 0.81", or "–" if the law was refused; then the
/// exponent, the best window, χ² per degree of freedom there, and the scatter. The rows come from the table
/// `glass_fit` and are empty without it.
std::string fit_rows(const Results& study);

/// The notes of the study (entries note_1, note_2 … of its provenance) as a list; empty without any.
std::string study_notes(const Results& study);

}  // namespace vitrel
