#pragma once

#include <optional>

#include "core/io/parameters.h"
#include "mc/options.h"
#include "workflow/stages/stage_interface.h"

/// The keys that several stages have.
namespace vitrel {

template <class S>
void describe_packing_fraction(S& stage, FieldVisitor& visit) {
  visit.optional(
      {"packing_fraction", "",
       "At the end of the stage. If left out: that of the system, but to insert at most 0.3 "
       "(0.01 in three dimensions), and none to compress, or where there is a reduced "
       "pressure."},
      stage.packing_fraction, 0.3);
}

template <class S>
void describe_max_sweeps(S& stage, FieldVisitor& visit) {
  visit.field(
      {"max_sweeps", "", "Sweeps after which a packing fraction is given up.", "most_sweeps"},
      stage.max_sweeps);
}

template <class S>
void describe_reduced_pressure(S& stage, FieldVisitor& visit) {
  visit.optional({"reduced_pressure", "",
                  "βP/ρ at the end of the stage, however dense that is: 1e6 or more for a jammed "
                  "state. With a packing fraction, too, whichever comes first."},
                 stage.reduced_pressure, 1e6);
}

template <class S>
void describe_growth_rate(S& stage, FieldVisitor& visit) {
  visit.field({"growth_rate", "1/time",
               "Growth of all lengths, relative to the present ones. Slow growth lets the liquid "
               "order, and so jams at higher packing fractions."},
              stage.growth_rate);
}

template <class S>
void describe_moves(S& stage, FieldVisitor& visit) {
  static constexpr const char* names[] = {"chains", "local"};
  visit.field(
      {"moves", "",
       "How Monte Carlo moves particles: in event chains, which forget density and places many "
       "times sooner, or one at a time (local), on any number of threads."},
      stage.moves, names);
  visit.when(stage.moves == Moves::local, "moves = \"local\"", [&](FieldVisitor& in) {
    in.field({"exchanges", "",
              "Share of the moves in which two particles of different shape exchange their places. "
              "Where sizes are spread, 0.2 relaxes dense liquids many times sooner; two sizes far "
              "apart gain nothing."},
             stage.exchanges);
  });
}

template <class S>
void describe_sweeps(S& stage, FieldVisitor& visit) {
  visit.field({"sweeps", "",
               "Sweeps; one is as many trial moves as there are particles. To compress: without a "
               "packing fraction."},
              stage.sweeps);
}

void validate_growth_rate(double growth_rate, const Rules& rules);
void validate_reduced_pressure(const std::optional<double>& reduced_pressure, const Rules& rules);
void validate_exchanges(double exchanges, const Rules& rules);

}  // namespace vitrel
