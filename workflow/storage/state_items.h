#pragma once

#include <string>

#include "core/state/observer.h"

/// @file
/// The items that runs and stages have in common in their checkpoints. `visit` is an ItemWriter or an
/// ItemReader (checkpoint_items.h), and every name begins with `path`.
namespace vitrel {

void each_item_of_counters(auto& counters, const std::string& path, auto&& visit) {
  visit(path + "virial", counters.virial);
  visit(path + "dissipated", counters.dissipated);
  visit(path + "events", counters.events);
  visit(path + "collisions", counters.collisions);
  visit(path + "predictions", counters.predictions);
  visit(path + "searches", counters.searches);
  visit(path + "steps", counters.steps);
  visit(path + "renewals", counters.list_updates);
  visit(path + "correction_moves", counters.correction_moves);
  visit(path + "refused_turns", counters.blocked_rotations);
  visit(path + "early_releases", counters.early_releases);
  visit(path + "integrations", counters.integrations);
  visit.if_recorded(path + "short_flights", counters.short_flights);
  visit.if_recorded(path + "spared", counters.spared);
  visit.if_recorded(path + "added", counters.added);
  visit.if_recorded(path + "supplied", counters.supplied);
  for (std::size_t k = 0; k < counters.helfand_moment.size(); ++k)
    visit.if_recorded(path + "helfand_moment_" + shear_element_names[k],
                      counters.helfand_moment[k]);
}

void each_item_of_growth(auto& growth, const std::string& path, auto&& visit) {
  visit(path + "draws", growth.draws);
  visit.if_recorded(path + "retries", growth.retries);
  visit(path + "under_way", growth.under_way);
  visit(path + "reduced_pressure", growth.reduced_pressure);
  visit(path + "time", growth.time);
  each_item_of_counters(growth.counters, path, visit);
}

void each_item_of_exchanges(auto& counts, const std::string& path, auto&& visit) {
  visit.if_recorded(path + "exchanges_tried", counts.tried);
  visit.if_recorded(path + "exchanges_accepted", counts.accepted);
  visit.if_recorded(path + "exchange_steps", counts.steps);
  visit.if_recorded(path + "accepted_exchange_steps", counts.accepted_steps);
}

void each_item_of_trials(auto& counts, const std::string& path, auto&& visit) {
  visit(path + "translations_tried", counts.translations_tried);
  visit(path + "translations_accepted", counts.translations_accepted);
  visit(path + "rotations_tried", counts.rotations_tried);
  visit(path + "rotations_accepted", counts.rotations_accepted);
  each_item_of_exchanges(counts.exchanges, path, visit);
}

void each_item_of_step(auto& step, const std::string& path, auto&& visit) {
  visit(path + "size", step.size);
  visit(path + "tried", step.tried);
  visit(path + "accepted", step.accepted);
}

void each_item_of_moves(auto& moves, const std::string& path, auto&& visit) {
  visit(path + "next_sweep", moves.next_sweep);
  visit(path + "sweeps", moves.sweeps);
  each_item_of_step(moves.translation, path + "translation.", visit);
  each_item_of_step(moves.rotation, path + "rotation.", visit);
  each_item_of_trials(moves.counts, path, visit);
}

void each_item_of_chains(auto& state, const std::string& path, auto&& visit) {
  visit(path + "next_sweep", state.next_sweep);
  visit(path + "sweeps", state.sweeps);
  visit(path + "chains", state.chains);
  visit(path + "rotations", state.rotations);
  visit(path + "length", state.length);
  each_item_of_step(state.rotation, path + "rotation.", visit);
  visit(path + "all_chains", state.counts.chains);
  visit(path + "all_contacts", state.counts.contacts);
  visit(path + "cut_short", state.counts.cut_short);
  visit(path + "looks", state.counts.searches);
  visit(path + "rotations_tried", state.counts.rotations_tried);
  visit(path + "rotations_accepted", state.counts.rotations_accepted);
  each_item_of_exchanges(state.counts.exchanges, path, visit);
  visit(path + "all_length", state.counts.length);
  visit(path + "all_ahead", state.counts.ahead);
  visit(path + "tuned_chains", state.tuned_chains);
  visit(path + "tuned_contacts", state.tuned_contacts);
}

void each_item_of_decorrelation(auto& state, const std::string& path, auto&& visit) {
  visit.if_recorded(path + "count", state.count);
  visit.if_recorded(path + "places", state.places);
  visit.if_recorded(path + "orientations", state.orientations);
  visit.if_recorded(path + "sizes", state.sizes);
  visit.if_recorded(path + "begin", state.begin);
  visit.if_recorded(path + "next", state.next);
  visit.if_recorded(path + "first", state.first);
}

void each_item_of_sampling(auto& state, const std::string& path, auto&& visit) {
  each_item_of_chains(state.chains, path + "chains.", visit);
  each_item_of_moves(state.local, path + "local.", visit);
  each_item_of_decorrelation(state.decorrelation, path + "decorrelation.", visit);
}

}  // namespace vitrel
