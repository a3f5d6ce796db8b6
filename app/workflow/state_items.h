#pragma once

#include <string>

#include "edmd/growth.h"
#include "mc/compression.h"
#include "mc/swelling.h"

/// The items of what checkpoints hold of runs and stages; `visit` is an ItemWriter or an ItemReader
/// (checkpoint_items.h), and `path` goes before every name.
namespace vitrel {

template <class Counters, class Visit>
void each_item_of_counters(Counters& counters, const std::string& path, Visit&& visit) {
  visit(path + "virial", counters.virial);
  visit(path + "dissipated", counters.dissipated);
  visit(path + "events", counters.events);
  visit(path + "collisions", counters.collisions);
  visit(path + "predictions", counters.predictions);
  visit(path + "searches", counters.searches);
  visit(path + "steps", counters.steps);
  visit(path + "renewals", counters.renewals);
  visit(path + "correction_moves", counters.correction_moves);
}

template <class Growth, class Visit>
void each_item_of_growth(Growth& growth, const std::string& path, Visit&& visit) {
  visit(path + "draws", growth.draws);
  visit(path + "under_way", growth.under_way);
  visit(path + "reduced_pressure", growth.reduced_pressure);
  visit(path + "time", growth.time);
  each_item_of_counters(growth.counters, path, visit);
}

template <class Counts, class Visit>
void each_item_of_trials(Counts& counts, const std::string& path, Visit&& visit) {
  visit(path + "translations_tried", counts.translations_tried);
  visit(path + "translations_accepted", counts.translations_accepted);
  visit(path + "rotations_tried", counts.rotations_tried);
  visit(path + "rotations_accepted", counts.rotations_accepted);
}

template <class Step, class Visit>
void each_item_of_step(Step& step, const std::string& path, Visit&& visit) {
  visit(path + "size", step.size);
  visit(path + "tried", step.tried);
  visit(path + "accepted", step.accepted);
}

template <class Moves, class Visit>
void each_item_of_moves(Moves& moves, const std::string& path, Visit&& visit) {
  visit(path + "next_sweep", moves.next_sweep);
  visit(path + "sweeps", moves.sweeps);
  each_item_of_step(moves.translation, path + "translation.", visit);
  each_item_of_step(moves.rotation, path + "rotation.", visit);
  each_item_of_trials(moves.counts, path, visit);
}

}  // namespace vitrel
