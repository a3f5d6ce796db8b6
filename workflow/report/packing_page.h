#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/results.h"
#include "core/io/foreign/foreign_frame.h"
#include "workflow/report/html.h"
#include "workflow/report/movie.h"

/// @file
/// The report of one packing of ellipsoids: one HTML page that needs nothing beside it.
namespace vitrel {

struct PackingPage {
  std::string title;
  std::string subtitle;  ///< one line below it: what was packed
  std::vector<QualityRow> rows;
  Movie3 movie;            ///< of one frame
  Results results;         ///< of which pair_correlation, structure_factor and two_point are shown
  std::string parameters;  ///< TOML text
  std::optional<FileUnits> units;  ///< of a file of another program
  PageProvenance provenance;       ///< shown if not empty
};

/// The page as HTML: the bodies, to be turned and cut, table of the rows, g(r), S(q), S₂(r) and lineal path.
std::string packing_page(const PackingPage& page);

}  // namespace vitrel
