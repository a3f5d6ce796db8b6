#pragma once

#include <optional>
#include <vector>

#include "mc/options.h"
#include "workflow/stages/stage_interface.h"

namespace vitrel {

/// Random sequential insertion (mc/insertion.h).
struct InsertStage : StageDefaults {
  static constexpr const char* method = "insert";
  static constexpr const char* summary =
      "random positions without overlap, as a start at low density";
  static constexpr bool places_particles = true;

  enum class Orientations { random, aligned, planar, tensor };

  std::optional<double> packing_fraction;
  std::uint64_t attempts = InsertionOptions().attempts;
  Orientations orientations = Orientations::random;
  /// The diagonal of the tensor, or all of its rows, for Orientations::tensor.
  std::optional<std::vector<double>> orientation_tensor;

  static std::vector<StageField<InsertStage>> fields();
  void validate(const Rules& rules, int dimension) const;
  double default_packing_fraction(const SystemParameters& system) const;
  StageReport advance(NoState& state, const StageContext& context) const;
};

}  // namespace vitrel
