#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/state/stage.h"
#include "workflow/configuration/rules.h"
#include "workflow/configuration/system_parameters.h"

/// What the stages of a preparation have in common. A stage is one type: its members are the options, with
/// their defaults, and it has
///
///   method, summary       its name in the parameter file, and what it does
///   State                 where it stands; with the configuration, all it needs to go on
///   fields()              its keys in the parameter file (stage_fields.h)
///   validate              throws BadValue for an impossible option
///   ending, end           what ends it, and at which packing fraction
///   description           what it does with these options, in a few words
///   advance               does it, in the dimensions it is there for
///   each_item             names the items of its state in a checkpoint
///   record                adds what it did to the record of the stage
///
/// and what StageDefaults has, if that does not fit. To add a stage, write such a type in files of its own
/// and add it to the list in stage.h. The header holds no algorithm, so that readers of parameters compile
/// none.
namespace vitrel {

template <int Dim>
struct Configuration;
class FieldVisitor;
struct StageRecord;

/// Of a stage that cannot be continued, but begins anew.
struct NoState {};

enum class StageEnding {
  packing_fraction,  ///< ends at a packing fraction that is known before
  pressure,          ///< a pressure decides where it ends
  unchanged,         ///< ends at the packing fraction at which it begins
};

/// What a stage gets from its surroundings.
struct StageContext {
  double packing_fraction;  ///< `end` of the stage
  std::uint64_t seed;
  int threads;  ///< of Monte Carlo; the result does not depend on it
};

/// One key of a stage in the parameter file, with those that depend on its value.
template <class S>
struct StageField {
  const char* key;
  void (*describe)(S& stage, FieldVisitor& visit);
};

struct StageDefaults {
  using State = NoState;
  /// Whether it places the particles, and so comes first; the others move them.
  static constexpr bool places_particles = false;

  StageEnding ending() const { return StageEnding::packing_fraction; }
  void validate(const Rules&) const {}
  /// Sweeps of Monte Carlo draw by their number, counted through all stages.
  template <class State>
  static void number_sweeps(State&, std::uint64_t /*next_sweep*/) {}
  template <class State, class Visit>
  static void each_item(State&, Visit&&) {}
  void record(const NoState&, StageRecord&) const {}
};

}  // namespace vitrel
