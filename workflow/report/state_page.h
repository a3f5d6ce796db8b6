#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/results.h"
#include "analysis/structure/order.h"
#include "core/io/foreign/foreign_frame.h"
#include "workflow/report/html.h"
#include "workflow/report/movie.h"

/// @file
/// The report of one prepared state, or of one packing of ellipsoids: one HTML page that needs nothing beside it.
namespace vitrel {

struct StatePage {
  std::string title;
  std::string subtitle;  ///< one line below it: what was prepared
  std::vector<QualityRow> rows;
  Results structure;  ///< tables pair_correlation, structure_factor, and in space two_point
  AnyMovie movie;     ///< of one frame
  NematicCorrelation nematic_correlation;  ///< not shown if empty
  double nematic_order = 0;                ///< S² is marked in the chart of the correlation
  /// After so many sweeps from the state on; nothing is shown of what is empty.
  std::vector<double> sweeps, orientation, displacement;
  std::string parameters;          ///< TOML text
  std::optional<FileUnits> units;  ///< of a file of another program
  PageProvenance provenance;       ///< shown if not empty
};

/// The page as HTML: table of the rows, the particles, g(r) and S(q); in the plane nematic correlation with its
/// scatter, and both time correlations; in space the bodies can be turned and cut, and there are S₂(r) and lineal path.
std::string state_page(const StatePage& page);

}  // namespace vitrel
