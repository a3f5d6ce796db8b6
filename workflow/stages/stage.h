#pragma once

#include <string>
#include <variant>
#include <vector>

#include "workflow/stages/compress_stage.h"
#include "workflow/stages/grow_stage.h"
#include "workflow/stages/hybrid_stage.h"
#include "workflow/stages/insert_stage.h"
#include "workflow/stages/lattice_stage.h"
#include "workflow/stages/sample_stage.h"
#include "workflow/stages/swell_stage.h"

/// The stages of a preparation, as the parameter file describes them.
namespace vitrel {

/// All there are; the first is the default.
using Stage = std::variant<InsertStage, LatticeStage, SwellStage, CompressStage, GrowStage,
                           HybridStage, SampleStage>;

/// As the parameter file calls it.
const char* method_name(const Stage& stage);

/// Names `method`, which selects the stage, and the keys of all stages; those of other stages exist only
/// with their methods.
void describe_stage(Stage& stage, FieldVisitor& visit);

/// Throws BadValue, for keys of [[prepare.stage]] or system.packing_fraction, if a stage has an impossible
/// option, or if they do not fit each other: the first places the particles, the others move them, none
/// lowers the packing fraction, and the last one reaches that of the system, unless a pressure ends it.
void validate_stages(const std::vector<Stage>& stages, const SystemParameters& system);

/// The packing fraction at which a stage ends that begins at `before`; if a pressure ends it, `before`,
/// since the end is not known.
double end_of_stage(const Stage& stage, const SystemParameters& system, double before);

/// Whether a pressure decides at which packing fraction the preparation ends.
bool ends_at_pressure(const std::vector<Stage>& stages);

/// What the stage does with its options, in a few words; `packing_fraction`: end_of_stage.
std::string stage_description(const Stage& stage, double packing_fraction);

}  // namespace vitrel
