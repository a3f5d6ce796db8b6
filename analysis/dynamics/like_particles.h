#pragma once

#include <cstddef>
#include <vector>

#include "core/state/configuration.h"

/// @file
/// Groups of particles that move alike except for chance, for the errors of averages over particles.
namespace vitrel {

/// Every particle belongs to one class.
struct LikeParticles {
  std::vector<std::size_t> class_of;  ///< class of every particle, from 0
  std::size_t classes = 0;
};

/// Returns classes of the same species and about the same shape. The particles of a species are halved at the median of
/// their area (volume), each half at the median of the longest semi-axis, and so on in turn, until the particles of a
/// class have one shape or are eight or fewer, or the species makes 32 classes.
template <int Dim>
LikeParticles like_particles(const Configuration<Dim>& configuration);

}  // namespace vitrel
