#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "core/state/stage.h"
#include "workflow/rules.h"
#include "workflow/system_parameters.h"

/// @file
/// The interface of the stages of a preparation. A stage is a type whose members are its options, with their
/// defaults. It also has
///
///     method, summary       its name in the parameter file, and a description
///     State                 its progress; together with the configuration, all it needs to continue
///     fields()              its keys in the parameter file (stage_fields.h)
///     validate              throws BadValue for options that do not suit each other or the system
///     ending                the kind of its end
///     advance               runs it, in both dimensions
///     each_item             names the items of its state in a checkpoint
///     record                adds its results to the record of the stage
///
/// and overrides members of StageDefaults where needed. To add a stage, write such a type in files of its own and add
/// it to the list in stage.h. The header of a stage contains no algorithm, so that code that reads parameters
/// compiles none.
namespace vitrel {

template <int Dim>
struct Configuration;
class FieldVisitor;
class Rules;
struct StageRecord;

/// The state of a stage that cannot be continued and always starts from the beginning.
struct NoState {};

enum class StageEnding {
  packing_fraction,  ///< ends at a packing fraction known in advance
  unforeseen,        ///< ends where a pressure, or a state that is not read yet, determines
  unchanged,         ///< ends at the packing fraction at which it begins
};

constexpr StageEnding ending_known_if(bool known) {
  return known ? StageEnding::packing_fraction : StageEnding::unforeseen;
}

/// The input of a stage.
struct StageContext {
  std::variant<Configuration<2>*, Configuration<3>*> configuration;  ///< changed in place
  double packing_fraction;  ///< at the end of the stage (end_of_stage)
  std::uint64_t seed;
  int threads;  ///< for Monte Carlo; the result does not depend on it
  const RunControl& control;

  /// Calls `use` with the configuration, whatever its dimension, and returns the result.
  auto with_configuration(auto&& use) const {
    return std::visit([&](auto* of_dimension) { return use(*of_dimension); }, configuration);
  }
};

/// A key of a stage in the parameter file, with the keys that depend on the value of that key.
template <class S>
struct StageField {
  const char* key;
  void (*describe)(S& stage, FieldVisitor& visit);
};

struct StageDefaults {
  using State = NoState;
  /// Whether the stage places the particles and must therefore come first; other stages move them.
  static constexpr bool places_particles = false;

  StageEnding ending() const { return StageEnding::packing_fraction; }
  /// The packing fraction at the end of a stage that has none of its own but whose end is known.
  double default_packing_fraction(const SystemParameters& system) const {
    return system.packing_fraction;
  }
  void validate(const Rules&, int /*dimension*/) const {}
  /// A short description with these options; empty if the method and the packing fraction say everything.
  std::string description() const { return {}; }
  template <class State, class Visit>
  static void each_item(State&, Visit&&) {}
  void record(const NoState&, StageRecord&) const {}
};

}  // namespace vitrel
