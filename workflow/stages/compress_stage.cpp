#include "workflow/stages/compress_stage.h"

#include <fmt/format.h>

#include <span>

#include "mc/compression.h"
#include "workflow/stages/stage_fields.h"
#include "workflow/stages/stage_record.h"

namespace vitrel {
namespace {

void describe_pressure(CompressStage& stage, FieldVisitor& visit) {
  visit.field({"pressure", "kT/area",
               "βP, in units of the inverse unit of area (in three dimensions of volume).",
               bounds::positive},
              stage.pressure);
}

void describe_box(CompressStage& stage, FieldVisitor& visit) {
  static constexpr const char* names[] = {"isotropic", "anisotropic"};
  visit.field({"box", "",
               "Either all sides of the box change by a common factor (isotropic), or one side at "
               "a time does (anisotropic). The ratio of two sides stays within a factor of 2 of "
               "its initial value."},
              stage.box, names);
}

Estimate mean_of_second_half(const std::vector<double>& series) {
  return slow_average(std::span(series).subspan(series.size() / 2));
}

}  // namespace

std::vector<StageField<CompressStage>> CompressStage::fields() {
  return {{"packing_fraction", describe_packing_fraction},
          {"max_sweeps", describe_max_sweeps},
          {"pressure", describe_pressure},
          {"box", describe_box},
          {"sweeps", describe_sweeps}};
}

std::string CompressStage::description() const {
  if (packing_fraction) return {};
  return fmt::format("compress at pressure {:.4g} for {} sweeps", pressure, sweeps);
}

StageReport CompressStage::advance(CompressionState& state, const StageContext& context) const {
  const CompressionOptions options{pressure, box, packing_fraction,
                                   packing_fraction ? max_sweeps : sweeps, context.threads};
  return context.with_configuration([&](auto& configuration) {
    return compress(configuration, options, context.seed, state, context.control);
  });
}

void CompressStage::record(const CompressionState& state, StageRecord& record) const {
  record.add(state.moves);
  if (!packing_fraction) record.mean_packing_fraction = mean_of_second_half(state.packing_fraction);
}

}  // namespace vitrel
