#pragma once

#include <cstddef>
#include <vector>

#include "core/state/configuration.h"

/// @file
/// Contacts of a jammed packing, and the particles that they hold.
namespace vitrel {

/// Two surfaces that are closer than a tolerance. If i = j, a particle touches its own image.
template <int Dim>
struct Contact {
  std::size_t i, j;
  Vec<Dim> normal;  ///< unit vector from i to j at the closest points
  double gap;
};

/// Returns all contacts, each pair of images once. Throws nothing; for an overlapping pair only the sign of the gap
/// counts. The cost is O(N).
template <int Dim>
std::vector<Contact<Dim>> contacts(const Configuration<Dim>& configuration, double tolerance);

/// A packing without its rattlers.
///
/// A particle is held if the normals at its contacts leave no half-plane (half-space) free: every direction it might
/// move to lies less than a right angle from the normal of one contact. The balance of forces needs that, for round
/// particles and for others alike, and it takes D + 1 contacts or more in D dimensions. Particles that are not held are
/// rattlers; they hold no other particles, so their contacts are removed and the other particles judged again until all
/// are held. The balance of torques is no part of the criterion: three contacts whose normals meet in one point may
/// hold an ellipse by the curvatures there (donev2007, schreck2012), and contacts that are open by a little do not show
/// whether their normals meet exactly.
struct Backbone {
  std::size_t rattlers;
  std::size_t contacts;   ///< contacts between particles that are held
  double contact_number;  ///< 2 contacts/(N − rattlers); NaN if all are rattlers
  /// Twice the degrees of freedom per particle: 4 for disks, 6 for ellipses and spheres, 10 for spheroids, 12 for
  /// scalene ellipsoids. Jammed disks and spheres have this number of contacts up to 1/N; other particles have fewer,
  /// and the fewer the rounder they are (donev2007).
  double isostatic_number;
};
template <int Dim>
Backbone backbone(const Configuration<Dim>& configuration, double tolerance);

/// From this reduced pressure on, the contacts of a jammed packing can be distinguished from other pairs.
inline constexpr double min_jammed_pressure = 1e5;

/// The backbone at the reduced pressure Z = βP/ρ, with a tolerance that follows from the state.
///
/// Let d be the mean diameter of disks (spheres) of equal area (volume). Close to jamming, a contact that bears the
/// force f is open by kT/f on the average, which is about d/Z for most contacts, while the gaps of all other pairs
/// spread below d (donev2005pair). The tolerance is the geometric mean of d/Z and d,
///
///     d Z^(−1/2),
///
/// and is doubled until more than half of the particles are held. This is necessary because growth compresses faster
/// than a particle that came out of balance can move to its next support; otherwise an isostatic packing would fall
/// apart to the last particle. If more than d/10 were needed, the packing is not jammed: the last tolerance is given,
/// and hardly a particle is held.
///
/// Neighbours that nearly touch add some 1 % to the contacts of disks at Z = 10⁶, and 2 to 3 % to those of spheres;
/// they add less at higher pressures and for other shapes. A wide tolerance counts many more: 1000 spheres grown at the
/// rate 0.01 need 0.01 d and have 6.8 contacts each, while at 0.003 and slower they have 6.1 to 6.2 with 0.001 d.
struct JammedBackbone : Backbone {
  double tolerance;
};
template <int Dim>
JammedBackbone jammed_backbone(const Configuration<Dim>& configuration, double reduced_pressure);

}  // namespace vitrel
