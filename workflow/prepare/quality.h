#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/statistics/blocking.h"
#include "analysis/structure/contacts.h"
#include "analysis/structure/order.h"
#include "mc/decorrelation.h"
#include "workflow/prepare/prepare.h"
#include "workflow/prepare/quality_row.h"

/// @file
/// How good a prepared state is.
namespace vitrel {

struct Quality {
  std::size_t particles = 0, rotors = 0;
  double packing_fraction = 0;

  enum class PressureFrom { nothing, sampling, growth };
  PressureFrom pressure_from = PressureFrom::nothing;
  Estimate reduced_pressure{};  ///< that of a growth has no error

  double nematic_order = 0;
  NematicCorrelation nematic_correlation;
  HexaticOrder hexatic_order{};
  std::size_t overlaps = 0;
  double smallest_gap = 0;  ///< infinity beyond the longest semi-axis

  std::optional<JammedBackbone> backbone;      ///< from min_jammed_pressure on
  std::optional<Decorrelation> decorrelation;  ///< none if no sweeps were asked for
};

/// Measures a complete preparation; the state stays as it is. The pressure is that of a short sampling on
/// a copy; without one, or if the last stage was a growth that ended jammed (min_jammed_pressure), that of
/// the growth. Nothing if the run control asked to stop.
std::optional<Quality> measure_quality(const Preparation<2>& preparation,
                                       const Parameters& parameters, const RunControl& control,
                                       int threads = 1);

/// The properties, in words and rounded numbers.
std::vector<QualityRow> quality_rows(const Quality& quality);

}  // namespace vitrel
