#include "workflow/prepare/backbone_report.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace vitrel {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void add_backbone_rows(std::vector<QualityRow>& rows, const std::optional<JammedBackbone>& backbone,
                       std::size_t particles) {
  if (!backbone) return;
  const bool jammed = std::isfinite(backbone->contact_number);
  rows.push_back({"contacts per particle",
                  jammed ? fmt::format("{:.3f}", backbone->contact_number) : "–",
                  jammed ? fmt::format("without rattlers; isostatic: {:.3g}; gaps below {:.2g}",
                                       backbone->isostatic_number, backbone->tolerance)
                         : "not jammed"});
  rows.push_back({"rattlers", fmt::format("{} of {}", backbone->rattlers, particles),
                  "particles that their contacts do not hold"});
}

Json backbone_json(const std::optional<JammedBackbone>& backbone) {
  if (!backbone) return nullptr;
  return {{"contact_tolerance", backbone->tolerance},
          {"contact_number", backbone->contact_number},
          {"isostatic_number", backbone->isostatic_number},
          {"contacts", backbone->contacts},
          {"rattlers", backbone->rattlers}};
}

std::optional<JammedBackbone> backbone_from(const Json& json) {
  if (json.is_null()) return std::nullopt;
  return JammedBackbone{
      {json.at("rattlers"), json.at("contacts"), number_or(json.at("contact_number"), unknown),
       number_or(json.at("isostatic_number"), unknown)},
      json.at("contact_tolerance")};
}

}  // namespace vitrel
