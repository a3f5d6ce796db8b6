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
#include "workflow/stages/state_stage.h"
#include "workflow/stages/swell_stage.h"

/// @file
/// The stages of a preparation, as the parameter file describes them.
namespace vitrel {

/// All stages; the first is the default.
using Stage = std::variant<InsertStage, LatticeStage, SwellStage, CompressStage, GrowStage,
                           HybridStage, SampleStage, StateStage>;

/// Returns the name of the stage in the parameter file.
const char* method_name(const Stage& stage);

/// Whether the method of this name places the particles, so that it must come first.
bool places_particles(const std::string& method);

/// Returns the options of the first stage if it takes the particles from a state, else null.
const StateStage* start_state(const std::vector<Stage>& stages);
StateStage* start_state(std::vector<Stage>& stages);

/// Whether all stages after the first keep the packing fraction.
bool keep_packing_fraction(const std::vector<Stage>& stages);

/// Whether the last stage samples until the state has decorrelated at least ten times.
bool end_in_equilibrium(const std::vector<Stage>& stages);

/// Describes `method`, which selects the stage, and the keys of all stages. The keys of a stage exist only with its
/// method.
void describe_stage(Stage& stage, FieldVisitor& visit);

/// Throws BadValue, for a key of [[prepare.stage]] or for system.packing_fraction, if an option of a stage is invalid
/// or if the stages do not fit together. The first stage must place the particles, and the others must move them.
/// None may lower the packing fraction or exceed `bound`, and the last one must reach the packing fraction of the
/// system unless a pressure ends it.
void validate_stages(const std::vector<Stage>& stages, const SystemParameters& system,
                     const PackingBound& bound);

/// The packing fraction at which a stage that begins at `before` ends. If a pressure ends the stage, this is unknown
/// and `before` is returned.
double end_of_stage(const Stage& stage, const SystemParameters& system, double before);

/// Whether the packing fraction at the end of the preparation is not known in advance.
bool has_unknown_end(const std::vector<Stage>& stages);

/// A short description of the stage with its options. `packing_fraction` is the result of end_of_stage.
std::string stage_description(const Stage& stage, double packing_fraction);

}  // namespace vitrel
