#include "workflow/stages/stage_record.h"

#include "mc/sampling.h"

namespace vitrel {

void StageRecord::add(const SweepState& moves) {
  sweeps += moves.sweeps;
  trials.add(moves.counts);
}

void StageRecord::add(const SamplingState& sampling) {
  add(sampling.local);
  const ChainState& chains = sampling.chains;
  sweeps += chains.sweeps;
  chain_contacts += chains.counts.contacts;
  if (chains.counts.chains > 0) chain_pressure = chains.counts.compressibility();
  decorrelations += sampling.decorrelation.count;
  trials.rotations_tried += chains.counts.rotations_tried;
  trials.rotations_accepted += chains.counts.rotations_accepted;
  trials.exchanges.add(chains.counts.exchanges);
}

}  // namespace vitrel
