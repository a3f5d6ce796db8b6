#pragma once

#include <string>

#include "core/state/observer.h"

/// @file
/// The items that the checkpoints of runs and of stages have in common. `visit` is an ItemWriter or an ItemReader
/// (checkpoint_items.h).
namespace vitrel {

void each_item_of_counters(auto& counters, auto&& visit) {
  visit("virial", counters.virial);
  visit("dissipated", counters.dissipated);
  visit("events", counters.events);
  visit("collisions", counters.collisions);
  visit("predictions", counters.predictions);
  visit("searches", counters.searches);
  visit("steps", counters.steps);
  visit("renewals", counters.list_updates);
  visit("correction_moves", counters.correction_moves);
  visit("refused_turns", counters.blocked_rotations);
  visit("early_releases", counters.early_releases);
  visit("integrations", counters.integrations);
  visit.if_recorded("short_flights", counters.short_flights);
  visit.if_recorded("spared", counters.spared);
  visit.if_recorded("added", counters.added);
  visit.if_recorded("supplied", counters.supplied);
  for (std::size_t k = 0; k < counters.helfand_moment.size(); ++k)
    visit.if_recorded(std::string("helfand_moment_") + shear_element_names[k],
                      counters.helfand_moment[k]);
}

void each_item_of_growth(auto& growth, auto&& visit) {
  visit("draws", growth.draws);
  visit.if_recorded("retries", growth.retries);
  visit("under_way", growth.under_way);
  visit("reduced_pressure", growth.reduced_pressure);
  visit("time", growth.time);
  each_item_of_counters(growth.counters, visit);
}

void each_item_of_exchanges(auto& counts, auto&& visit) {
  visit.if_recorded("exchanges_tried", counts.tried);
  visit.if_recorded("exchanges_accepted", counts.accepted);
  visit.if_recorded("exchange_steps", counts.steps);
  visit.if_recorded("accepted_exchange_steps", counts.accepted_steps);
}

void each_item_of_trials(auto& counts, auto&& visit) {
  visit("translations_tried", counts.translations_tried);
  visit("translations_accepted", counts.translations_accepted);
  visit("rotations_tried", counts.rotations_tried);
  visit("rotations_accepted", counts.rotations_accepted);
  each_item_of_exchanges(counts.exchanges, visit);
}

void each_item_of_step(auto& step, auto&& visit) {
  visit("size", step.size);
  visit("tried", step.tried);
  visit("accepted", step.accepted);
}

void each_item_of_moves(auto& moves, auto&& visit) {
  visit("next_sweep", moves.next_sweep);
  visit("sweeps", moves.sweeps);
  each_item_of_step(moves.translation, visit.below("translation."));
  each_item_of_step(moves.rotation, visit.below("rotation."));
  each_item_of_trials(moves.counts, visit);
}

void each_item_of_chains(auto& state, auto&& visit) {
  visit("next_sweep", state.next_sweep);
  visit("sweeps", state.sweeps);
  visit("chains", state.chains);
  visit("rotations", state.rotations);
  visit("length", state.length);
  each_item_of_step(state.rotation, visit.below("rotation."));
  visit("all_chains", state.counts.chains);
  visit("all_contacts", state.counts.contacts);
  visit("cut_short", state.counts.cut_short);
  visit("looks", state.counts.searches);
  visit("rotations_tried", state.counts.rotations_tried);
  visit("rotations_accepted", state.counts.rotations_accepted);
  each_item_of_exchanges(state.counts.exchanges, visit);
  visit("all_length", state.counts.length);
  visit("all_ahead", state.counts.ahead);
  visit("tuned_chains", state.tuned_chains);
  visit("tuned_contacts", state.tuned_contacts);
}

void each_item_of_decorrelation(auto& state, auto&& visit) {
  visit.if_recorded("count", state.count);
  visit.if_recorded("places", state.places);
  visit.if_recorded("orientations", state.orientations);
  visit.if_recorded("sizes", state.sizes);
  visit.if_recorded("begin", state.begin);
  visit.if_recorded("next", state.next);
  visit.if_recorded("first", state.first);
}

void each_item_of_sampling(auto& state, auto&& visit) {
  each_item_of_chains(state.chains, visit.below("chains."));
  each_item_of_moves(state.local, visit.below("local."));
  each_item_of_decorrelation(state.decorrelation, visit.below("decorrelation."));
}

}  // namespace vitrel
