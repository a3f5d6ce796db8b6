#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/io/foreign/foreign_frame.h"
#include "workflow/stages/stage_interface.h"

namespace vitrel {

/// A state from a file, or from arrays in the parameter file. The stage is given a configuration that is already the
/// state: configuration/start_state.h takes the number, species, box and packing fraction of the system from it.
struct StateStage : StageDefaults {
  static constexpr const char* method = "state";
  static constexpr const char* summary = "a state from a file, or from arrays in this file";
  static constexpr bool places_particles = true;

  enum class OnOverlap { stop, shrink };
  using Rows = std::vector<std::vector<double>>;

  std::optional<std::string> file;
  OnOverlap on_overlap = OnOverlap::stop;
  std::optional<std::vector<double>> box;
  // These arrays replace the file and have one row per particle.
  std::optional<Rows> positions, velocities, quaternions, semi_axes;
  std::optional<std::vector<double>> angles, masses;
  std::optional<Rows> angular_velocities;  ///< in the plane, rows of one number
  std::optional<std::vector<std::string>> species;

  /// The packing fraction of the state, once it is known. It is not a key of the parameter file.
  std::optional<double> packing_fraction;

  static std::vector<StageField<StateStage>> fields();
  StageEnding ending() const { return ending_known_if(packing_fraction.has_value()); }
  void validate(const Rules& rules, int dimension) const;
  std::string description() const;
  StageReport advance(NoState& state, const StageContext& context) const;

  /// The particles that the arrays describe.
  ForeignFrame frame(int dimension) const;
};

}  // namespace vitrel
