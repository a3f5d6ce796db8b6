#pragma once

#include <cstddef>
#include <vector>

#include "core/state/configuration.h"

/// @file
/// Which particles move alike but for chance: for the errors of averages over particles.
namespace vitrel {

/// Every particle belongs to one class.
struct LikeParticles {
  std::vector<std::size_t> class_of;  ///< of every particle, from 0
  std::size_t classes = 0;
};

/// Classes of the same species and about the same shape. The particles of a species are halved at the median of their
/// area (volume), each half at that of the longest semi-axis, and so on in turn, until those of a class have one shape,
/// are eight or fewer, or the species makes 32 classes.
template <int Dim>
LikeParticles like_particles(const Configuration<Dim>& configuration);

}  // namespace vitrel
