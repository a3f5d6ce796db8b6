#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "workflow/analyze/analyze.h"

/// @file
/// The page of a run, a sweep, a state or a packing.
namespace vitrel {

enum class PageSubject { state, packing, run, sweep };

/// The subject of the page. A folder is a sweep. A file of one frame is a state in the plane or a packing in space,
/// and any other file is a run. Throws FileError.
PageSubject page_subject(const std::filesystem::path& input, const AnalysisChoice& choice = {});

struct Page {
  PageSubject subject;
  std::size_t count;  ///< number of runs, states or packings on the page
  std::string html;   ///< complete in itself: the page needs neither other files nor a network
};

/// Makes the page. Results of runs are those stored beside them, unless they are out of date. The page of a sweep
/// says which jobs are missing. Throws FileError, and UserError if, among other things, an analysis is chosen for a
/// single state.
Page page_of(const std::filesystem::path& input, const AnalysisChoice& choice,
             const AnalysisProgress& progress = {});

/// Throws UserError if there is something at this place that is not an HTML page, because a page replaces nothing
/// else.
void require_place_of_page(const std::filesystem::path& output);

}  // namespace vitrel
