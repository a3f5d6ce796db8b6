#include "workflow/stages/insert_stage.h"

#include <fmt/format.h>

#include <algorithm>

#include "mc/insertion.h"
#include "workflow/stages/stage_fields.h"

namespace vitrel {
namespace {

/// Random insertion is quick up to here: in three dimensions, where it serves as a start, for all lengths.
constexpr double easy_insertion = 0.3, easy_insertion_of_solids = 0.01;

void describe_attempts(InsertStage& stage, FieldVisitor& visit) {
  visit.field({"attempts", "", "Random positions tried for one particle before the stage fails."},
              stage.attempts);
}

void describe_orientations(InsertStage& stage, FieldVisitor& visit) {
  static constexpr const char* names[] = {"random", "aligned"};
  visit.field({"orientations", "", "Random orientations, or all particles aligned along x."},
              stage.orientations, names);
}

}  // namespace

std::vector<StageField<InsertStage>> InsertStage::fields() {
  return {{"packing_fraction", describe_packing_fraction},
          {"attempts", describe_attempts},
          {"orientations", describe_orientations}};
}

void InsertStage::validate(const Rules& rules, const StageSubject&) const {
  rules.require(attempts >= 1, "attempts", "is 0, but must be at least 1");
}

double InsertStage::end(const SystemParameters& system, double) const {
  const double easy = system.dimension == 2 ? easy_insertion : easy_insertion_of_solids;
  return packing_fraction.value_or(std::min(easy, system.packing_fraction));
}

std::string InsertStage::description(double goal) const {
  return fmt::format("insert at packing fraction {:.4g}", goal);
}

template <int Dim>
StageReport InsertStage::advance(Configuration<Dim>& configuration, NoState&,
                                 const StageContext& context, const RunControl& control) const {
  const bool aligned = orientations == Orientations::aligned;
  return insert_particles(configuration, {context.packing_fraction, attempts, aligned},
                          context.seed, control);
}

template StageReport InsertStage::advance(Configuration2&, NoState&, const StageContext&,
                                          const RunControl&) const;
template StageReport InsertStage::advance(Configuration3&, NoState&, const StageContext&,
                                          const RunControl&) const;

}  // namespace vitrel
