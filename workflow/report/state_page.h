#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/results.h"
#include "analysis/structure/order.h"
#include "core/io/foreign/foreign_frame.h"
#include "core/state/configuration.h"
#include "workflow/report/html.h"

/// @file
/// The report of one prepared state: one HTML page that needs nothing beside it.
namespace vitrel {

struct StatePage {
  std::string title;
  std::string subtitle;  ///< one line below it: what was prepared
  std::vector<QualityRow> rows;
  Results structure;  ///< tables pair_correlation and structure_factor
  Configuration2 state;
  NematicCorrelation nematic_correlation;  ///< not shown if empty
  double nematic_order = 0;                ///< S² is marked in the chart of the correlation
  /// After so many sweeps from the state on; nothing is shown of what is empty.
  std::vector<double> sweeps, orientation, displacement;
  std::string parameters;          ///< TOML text
  std::optional<FileUnits> units;  ///< of a file of another program
  PageProvenance provenance;       ///< shown if not empty
};

/// The page as HTML: table of the rows, the particles (of more than 4000 a part), g(r) and S(q),
/// nematic correlation with its scatter, and both time correlations.
std::string state_page(const StatePage& page);

}  // namespace vitrel
