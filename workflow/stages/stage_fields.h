#pragma once

#include <optional>

#include "core/io/parameters.h"
#include "edmd/options.h"
#include "mc/options.h"
#include "workflow/stages/stage_interface.h"

/// @file
/// Keys shared by several stages.
namespace vitrel {

inline constexpr double max_exchanges = 1e6;
inline constexpr Bounds growth_rate_bounds{
    0, 1, true, false,
    "lie above 0 and not above 1, where the surfaces are as fast as the particles"};
inline constexpr Bounds reduced_pressure_bounds{1, max_reduced_pressure, true};

inline constexpr Bounds share_of_local_moves{
    0, 1, false, true, "lie between 0 and 1, 1 excluded: exchanges alone move nothing"};

void describe_packing_fraction(auto& stage, FieldVisitor& visit) {
  visit.optional({"packing_fraction", "",
                  "Packing fraction at the end of the stage. The default is that of the system, "
                  "but at most 0.3 (0.01 in three dimensions) for insert. There is no default for "
                  "compress or if a reduced pressure is given.",
                  bounds::packing_fraction},
                 stage.packing_fraction, 0.3);
}

void describe_max_sweeps(auto& stage, FieldVisitor& visit) {
  visit.field(
      {"max_sweeps", "",
       "Maximum number of sweeps to reach a packing fraction or a number of decorrelations.",
       bounds::at_least_one, "most_sweeps"},
      stage.max_sweeps);
}

void describe_reduced_pressure(auto& stage, FieldVisitor& visit) {
  visit.optional(
      {"reduced_pressure", "",
       "βP/ρ at the end of the stage, at any packing fraction; use 1e6 or more for a jammed state. "
       "If a packing fraction is also given, the stage ends at whichever comes first.",
       reduced_pressure_bounds},
      stage.reduced_pressure, 1e6);
}

void describe_growth_rate(auto& stage, FieldVisitor& visit) {
  visit.field(
      {"growth_rate", "",
       "Relative growth of all lengths in the time in which a typical particle, the median, "
       "moves by its own size: √(m a b/kT), or √(m/kT) (a b c)^(1/3). Under slow growth the "
       "liquid can order and therefore jams at a higher packing fraction.",
       growth_rate_bounds},
      stage.growth_rate);
}

void describe_moves(auto& stage, FieldVisitor& visit) {
  static constexpr const char* names[] = {"chains", "local"};
  visit.field({"moves", "",
               "Monte Carlo moves: event chains, which relax density and positions many times "
               "faster, or local moves of one particle at a time, which can use several threads."},
              stage.moves, names);
}

void describe_exchanges(auto& stage, FieldVisitor& visit) {
  visit.field(
      {"exchanges", "",
       "Exchanges of the places of two particles of different shape, as a share of the local "
       "moves, or per particle and sweep beside event chains. For a broad size "
       "distribution 0.2 relaxes dense liquids many times faster; for two very different "
       "sizes exchanges gain nothing.",
       stage.moves == Moves::local ? share_of_local_moves : Bounds{0, max_exchanges}},
      stage.exchanges.trials);
  visit.when(stage.exchanges.trials > 0, "exchanges above 0", [&](FieldVisitor& in) {
    in.field(
        {"exchange_partners", "",
         "How close in size the two are, as a share of the ranks of all sizes: 1 exchanges any "
         "two.",
         bounds::share_above_none},
        stage.exchanges.partners);
  });
  visit.field({"collective_exchanges",
               "",
               "Steps of collective exchanges per particle and sweep, in which places are given "
               "larger and larger particles until one does not fit. For sizes distributed "
               "continuously and one aspect ratio.",
               {0, max_exchanges}},
              stage.exchanges.collective);
}

void describe_sweeps(auto& stage, FieldVisitor& visit) {
  visit.field({"sweeps", "",
               "Number of sweeps. A sweep makes as many trial moves as there are particles. For "
               "compress, only without a packing fraction; for sample, only without a number of "
               "decorrelations.",
               bounds::at_least_one},
              stage.sweeps);
}

}  // namespace vitrel
