#pragma once

#include <optional>
#include <vector>

#include "analysis/structure/contacts.h"
#include "core/io/json.h"
#include "workflow/prepare/quality_row.h"

/// @file
/// The backbone of a jammed state in its quality report, in the plane and in space; nothing stands for a
/// state that is not compressed enough to tell.
namespace vitrel {

/// The backbone if the reduced pressure is at least min_jammed_pressure.
template <int Dim>
std::optional<JammedBackbone> backbone_at_pressure(const Configuration<Dim>& state,
                                                   double reduced_pressure) {
  if (!(reduced_pressure >= min_jammed_pressure)) return std::nullopt;
  return jammed_backbone(state, reduced_pressure);
}

/// Contact number, gap limit and rattlers, in words and rounded numbers.
void add_backbone_rows(std::vector<QualityRow>& rows, const std::optional<JammedBackbone>& backbone,
                       std::size_t particles);

Json backbone_json(const std::optional<JammedBackbone>& backbone);
/// What backbone_json returned. Throws Json::exception.
std::optional<JammedBackbone> backbone_from(const Json& json);

}  // namespace vitrel
