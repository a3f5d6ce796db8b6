#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/displacement.h"
#include "analysis/energy.h"
#include "app/workflow/report/html.h"
#include "core/state/configuration.h"

/// The report: one HTML page that needs nothing beside it, neither files nor a network.
namespace vitrel {

/// One run, as the page shows it. Whatever is not known stays empty or NaN and is shown as "–".
struct ReportRun {
  std::string name;      ///< of its file or folder, to tell runs of equal density apart
  std::string dynamics;  ///< "Brownian, step 0.1"
  double packing_fraction = 0;
  std::size_t particles = 0;
  std::size_t rotors = 0;
  double duration = 0;
  std::uint64_t collisions = 0;
  Estimate compressibility{};
  Displacements displacements;  ///< the first group, all particles, is shown
  EnergySeries energy;
  Configuration2 final_state;
};

struct ReportData {
  std::string title;
  std::string subtitle;         ///< one line below it: what was simulated
  std::vector<ReportRun> runs;  ///< shown in the order of their packing fraction
  std::string parameters;       ///< TOML text
  PageProvenance provenance;    ///< shown if not empty
};

/// The page as HTML: MSD and MSR of all runs (log–log), a table of densities (collisions, Z,
/// diffusion coefficients where they can be read off), final state and energies of each run,
/// parameters, provenance.
///
/// To stay small, curves are thinned to 30 points a decade, energies to 400 samples, and a picture
/// shows a part of the box with 4000 particles at most; the page says where.
std::string report_page(const ReportData& data);

}  // namespace vitrel
