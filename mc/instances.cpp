// Instances of the moves for the shapes that configurations have.

#include "mc/event_chain.h"
#include "mc/exchanges.h"
#include "mc/hard_particles.h"
#include "mc/pressure_sampler.h"
#include "mc/sampler.h"

namespace vitrel {

template class HardParticles<ParticleShape<2>>;
template class HardParticles<ParticleShape<3>>;
template class Exchanges<ParticleShape<2>>;
template class Exchanges<ParticleShape<3>>;
template class Sampler<ParticleShape<2>>;
template class Sampler<ParticleShape<3>>;
template class EventChain<ParticleShape<2>>;
template class EventChain<ParticleShape<3>>;
template class PressureSampler<ParticleShape<2>>;
template class PressureSampler<ParticleShape<3>>;

}  // namespace vitrel
