#pragma once

#include <map>
#include <optional>
#include <string>

#include "analysis/results.h"
#include "core/io/foreign/foreign_frame.h"

/// @file
/// Relaxation as HTML: of one run and of the glass study, the rows of tables of the page and the notes
/// below them.
namespace vitrel {

/// The results of one run: the verdict with its reason, or why there is none; Z, D and D_r; the times in which F_s and L_n of
/// all particles fall to 1/e, and in a nematic that of L_2 seen from the director. From the tables
/// `relaxation` and `relaxation_times`; empty without them.
std::string result_rows(const Results& run, int dimension,
                        const std::optional<FileUnits>& units = {});

/// One row per run: its label or else φ, seed, verdict, what orientations do, q, τ_α at that q, τ_2, nematic order and
/// that by chance, plateau of L_2, duration. From the table `relaxation`; empty without it. Labels by the names of runs.
std::string relaxation_rows(const Results& study, const std::map<std::string, std::string>& labels);

/// One row per kind of time and law: φ_c with its error, or the bound "> 0.81", or "–" if the law was
/// refused; the two parts of the error, the exponent, the best window and how well the law fits there.
/// From the table `glass_fit`; empty without it.
std::string fit_rows(const Results& study);

/// The notes of the study (entries note_1, note_2 … of its provenance) as a list; empty without any.
std::string study_notes(const Results& study);

}  // namespace vitrel
