#include "workflow/stages/lattice_stage.h"

#include <fmt/format.h>

#include <cmath>

#include "core/io/parameters.h"
#include "mc/lattice.h"

namespace vitrel {
namespace {

void describe_arrangement(LatticeStage& stage, FieldVisitor& visit) {
  static constexpr const char* names[] = {"square", "triangular"};
  visit.field({"arrangement", "",
               "Lattice type. The triangular lattice is stretched along x by the aspect ratio of "
               "the particles."},
              stage.arrangement, names);
}

void describe_angle(LatticeStage& stage, FieldVisitor& visit) {
  visit.field({"angle", "radians",
               "Angle from the x axis to the major axes; must be 0 on the triangular lattice."},
              stage.angle);
}

}  // namespace

std::vector<StageField<LatticeStage>> LatticeStage::fields() {
  return {{"arrangement", describe_arrangement}, {"angle", describe_angle}};
}

void LatticeStage::validate(const Rules& rules) const {
  rules.require(std::isfinite(angle), "angle", "must be a finite number");
  rules.require(arrangement == Arrangement::square || angle == 0, "angle",
                fmt::format("is {}, but must be 0 on the triangular lattice", show(angle)));
}

double LatticeStage::end(const SystemParameters& system, double) const {
  return system.packing_fraction;
}

std::string LatticeStage::description(double goal) const {
  return fmt::format("lattice at packing fraction {:.4g}", goal);
}

StageReport LatticeStage::advance(Configuration<2>& configuration, NoState&,
                                  const StageContext& context, const RunControl&) const {
  return place_on_lattice(configuration, {arrangement, angle}, context.seed);
}

}  // namespace vitrel
