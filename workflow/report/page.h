#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "workflow/analyze/analyze.h"

/// @file
/// The page of whatever there is.
namespace vitrel {

enum class PageSubject { state, packing, run, sweep };

/// A folder is a sweep; a file of one frame is a state of the plane or a packing in space, one of more a run. Throws FileError.
PageSubject page_subject(const std::filesystem::path& input, const AnalysisChoice& choice = {});

struct Page {
  PageSubject subject;
  std::size_t count;  ///< of runs (states, packings) on it
  std::string html;   ///< needs nothing beside it, neither files nor a network
};

/// The results of runs are those that are stored beside them, unless they are out of date. A page of a sweep says which
/// jobs are missing. Throws FileError or UserError, also if an analysis is chosen for a single state.
Page page_of(const std::filesystem::path& input, const AnalysisChoice& choice,
             const AnalysisProgress& progress = {});

/// UserError if something is at this place that is not an HTML page, which alone a page may replace.
void require_place_of_page(const std::filesystem::path& output);

}  // namespace vitrel
