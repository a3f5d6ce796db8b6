#include "workflow/stages/lattice_stage.h"

#include <fmt/format.h>

#include <cmath>

#include "core/io/parameters.h"
#include "mc/hard_core.h"
#include "mc/lattice.h"
#include "workflow/stages/stage_fields.h"

namespace vitrel {
namespace {

constexpr const char* arrangement_names[] = {"square", "triangular", "simple_cubic",
                                             "face_centred_cubic", "body_centred_cubic"};

void describe_arrangement(LatticeStage& stage, FieldVisitor& visit) {
  visit.field({"arrangement", "",
               "Lattice type: square or triangular in two dimensions, the others in three. All but "
               "the square lattice are stretched like the particles, which lie along the axes of "
               "the box."},
              stage.arrangement, arrangement_names);
}

void describe_angle(LatticeStage& stage, FieldVisitor& visit) {
  visit.field({"angle", "radians",
               "Angle from the x axis to the major axes; must be 0 on all but the square lattice."},
              stage.angle);
}

}  // namespace

std::vector<StageField<LatticeStage>> LatticeStage::fields() {
  return {{"packing_fraction", describe_packing_fraction},
          {"arrangement", describe_arrangement},
          {"angle", describe_angle}};
}

void LatticeStage::validate(const Rules& rules, int dimension) const {
  rules.require(std::isfinite(angle), "angle", "must be a finite number");
  rules.require(arrangement == Arrangement::square || angle == 0, "angle",
                fmt::format("is {}, but must be 0 on all but the square lattice", show(angle)));
  rules.require(has_dimension(arrangement, dimension), "arrangement",
                fmt::format("is \"{}\", but must be {}",
                            arrangement_names[static_cast<std::size_t>(arrangement)],
                            dimension == 2 ? "\"square\" or \"triangular\""
                                           : "\"simple_cubic\", \"face_centred_cubic\" or "
                                             "\"body_centred_cubic\" in three dimensions"));
}

StageReport LatticeStage::advance(NoState&, const StageContext& context) const {
  return context.with_configuration([&](auto& configuration) {
    if (packing_fraction) scale_to_packing_fraction(configuration, context.packing_fraction);
    return place_on_lattice(configuration, {arrangement, angle}, context.seed);
  });
}

}  // namespace vitrel
