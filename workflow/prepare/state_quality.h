#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/blocking.h"
#include "analysis/structure/contacts.h"
#include "core/io/json.h"
#include "core/state/stage.h"
#include "mc/decorrelation.h"
#include "workflow/prepare/prepare.h"
#include "workflow/prepare/quality_row.h"

/// @file
/// What the quality reports of both dimensions have in common.
namespace vitrel {

struct StateQuality {
  std::size_t particles = 0, rotors = 0;  ///< rotors: those that are not round
  double packing_fraction = 0;

  enum class PressureFrom { nothing, sampling, growth };
  PressureFrom pressure_from = PressureFrom::nothing;
  Estimate reduced_pressure{};  ///< βP/ρ; NaN from nothing. That of a growth has no error

  std::size_t overlaps = 0;
  double smallest_gap = 0;  ///< infinity beyond the longest semi-axis

  std::optional<JammedBackbone> backbone;      ///< from min_jammed_pressure on
  std::optional<Decorrelation> decorrelation;  ///< none if no sweeps were asked for
};

/// Measures a complete preparation; the state stays as it is. The pressure is that of a short sampling on
/// a copy; without one, or if the last stage was a growth that ended jammed (min_jammed_pressure), that of
/// the growth. False if the run control asked to stop.
template <int Dim>
bool measure_state(StateQuality& quality, const Preparation<Dim>& preparation,
                   const Parameters& parameters, const RunControl& control, int threads);

/// @name In words and rounded numbers
/// @{
QualityRow packing_fraction_row(const StateQuality& quality);
QualityRow pressure_row(const StateQuality& quality);
QualityRow gap_row(const StateQuality& quality);
/// Contact number, gap limit and rattlers of a jammed state.
void add_backbone_rows(std::vector<QualityRow>& rows, const StateQuality& quality);
/// The time of the orientation is that of this correlation.
void add_time_rows(std::vector<QualityRow>& rows, const StateQuality& quality,
                   const std::string& correlation);
/// @}

/// @name As JSON
/// It has neither NaN nor infinity: null stands for both. A limit that was not met within what was looked at is told
/// by "reached": false, and the value is how far that was. Reading throws Json::exception.
/// @{
Json limit_json(bool reached, Json value);
const char* name_of(StateQuality::PressureFrom from);
StateQuality::PressureFrom pressure_source(const std::string& name);
Json backbone_json(const std::optional<JammedBackbone>& backbone);
std::optional<JammedBackbone> backbone_from(const Json& json);
Json decorrelation_json(const std::optional<Decorrelation>& decorrelation);
std::optional<Decorrelation> decorrelation_from(const Json& json);
/// @}

}  // namespace vitrel
