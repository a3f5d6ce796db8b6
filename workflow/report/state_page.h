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
/// The report of one prepared state, or of one packing of ellipsoids: a single HTML page that needs nothing else.
namespace vitrel {

struct StatePage {
  std::string title;
  std::string subtitle;  ///< one line below the title: what was prepared
  std::vector<QualityRow> rows;
  Results structure;  ///< tables pair_correlation, structure_factor and, in space, two_point
  AnyMovie movie;     ///< has one frame
  NematicCorrelation nematic_correlation;  ///< left out if empty
  double nematic_order = 0;                ///< the chart of the correlation marks S²
  /// The correlations after these numbers of sweeps from the state on; those that are empty are not shown.
  std::vector<double> sweeps, orientation, displacement;
  std::string parameters;          ///< as TOML
  std::optional<FileUnits> units;  ///< of a file of another program
  PageProvenance provenance;       ///< left out if empty
};

/// The page as HTML: the table of the rows, the particles, g(r) and S(q). In the plane it also shows the nematic
/// correlation with its scatter, and both time correlations. In space the bodies can be turned and cut, and S₂(r) and
/// the lineal path are shown.
std::string state_page(const StatePage& page);

}  // namespace vitrel
