#pragma once

#include <vector>

#include "mc/contact_pressure.h"
#include "mc/event_chain.h"
#include "tests/support/statistics.h"

namespace vitrel {

/// Z by the contacts of event chains, and by the contact function of the states that they visit.
struct ChainPressures {
  Estimate of_chains, of_contacts;
};

/// How long the chains run: sweeps that tune, and then blocks of samples of so many sweeps. The contact function is
/// evaluated after every other sweep.
struct ChainSampling {
  int tuning, blocks, samples, sweeps_per_sample;
};

template <int Dim>
ChainPressures chain_pressures(Configuration<Dim>& c, const ChainSampling& sampling) {
  EventChain<ParticleShape<Dim>> chains(c, {}, 11);
  for (int sweep = 0; sweep < sampling.tuning; ++sweep) {
    chains.sweep();
    chains.tune();
  }
  std::vector<double> of_chains, of_contacts;
  ContactPressure pressure;
  for (int block = 0; block < sampling.blocks; ++block) {
    const ChainCounts before = chains.counts();
    for (int sample = 0; sample < sampling.samples; ++sample) {
      for (int sweep = 0; sweep < sampling.sweeps_per_sample; ++sweep) {
        chains.sweep();
        if (sweep % 2 == 0) pressure.add(c);
      }
    }
    const ChainCounts& after = chains.counts();
    of_chains.push_back(1 + (after.ahead - before.ahead) / (after.length - before.length));
    of_contacts.push_back(pressure.compressibility());
    pressure.clear();
  }
  return {estimate(of_chains), estimate(of_contacts)};
}

}  // namespace vitrel
