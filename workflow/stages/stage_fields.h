#pragma once

#include <optional>

#include "core/io/parameters.h"
#include "mc/options.h"
#include "workflow/stages/stage_interface.h"

/// @file
/// Keys shared by several stages.
namespace vitrel {

template <class S>
void describe_packing_fraction(S& stage, FieldVisitor& visit) {
  visit.optional({"packing_fraction", "",
                  "Packing fraction at the end of the stage. The default is that of the system, "
                  "but at most 0.3 (0.01 in three dimensions) for insert. There is no default for "
                  "compress or if a reduced pressure is given."},
                 stage.packing_fraction, 0.3);
}

template <class S>
void describe_max_sweeps(S& stage, FieldVisitor& visit) {
  visit.field(
      {"max_sweeps", "", "Maximum number of sweeps to reach a packing fraction.", "most_sweeps"},
      stage.max_sweeps);
}

template <class S>
void describe_reduced_pressure(S& stage, FieldVisitor& visit) {
  visit.optional(
      {"reduced_pressure", "",
       "βP/ρ at the end of the stage, at any packing fraction; use 1e6 or more for a jammed state. "
       "If a packing fraction is also given, the stage ends at whichever comes first."},
      stage.reduced_pressure, 1e6);
}

template <class S>
void describe_growth_rate(S& stage, FieldVisitor& visit) {
  visit.field({"growth_rate", "1/time",
               "Growth rate of all lengths, relative to the current ones. Under slow growth the "
               "liquid can order and therefore jams at a higher packing fraction."},
              stage.growth_rate);
}

template <class S>
void describe_moves(S& stage, FieldVisitor& visit) {
  static constexpr const char* names[] = {"chains", "local"};
  visit.field({"moves", "",
               "Monte Carlo moves: event chains, which relax density and positions many times "
               "faster, or local moves of one particle at a time, which can use several threads."},
              stage.moves, names);
  visit.when(stage.moves == Moves::local, "moves = \"local\"", [&](FieldVisitor& in) {
    in.field({"exchanges", "",
              "Fraction of the moves that exchange the positions of two particles of different "
              "shape. For a broad size distribution 0.2 relaxes dense liquids many times faster; "
              "for two very different sizes exchanges gain nothing."},
             stage.exchanges);
  });
}

template <class S>
void describe_sweeps(S& stage, FieldVisitor& visit) {
  visit.field({"sweeps", "",
               "Number of sweeps. A sweep makes as many trial moves as there are particles. For "
               "compress, only without a packing fraction."},
              stage.sweeps);
}

void validate_growth_rate(double growth_rate, const Rules& rules);
void validate_reduced_pressure(const std::optional<double>& reduced_pressure, const Rules& rules);
void validate_exchanges(double exchanges, const Rules& rules);

}  // namespace vitrel
