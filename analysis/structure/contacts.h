#pragma once

#include <cstddef>
#include <vector>

#include "core/state/configuration.h"

/// @file
/// Contacts of a jammed packing, and which particles they hold.
namespace vitrel {

/// Two surfaces closer than a tolerance; i = j for a particle and its own image.
template <int Dim>
struct Contact {
  std::size_t i, j;
  Vec<Dim> normal;  ///< unit vector from i to j at the closest points
  double gap;
};

/// All contacts, each pair of images once. Throws nothing; of an overlapping pair only the sign of
/// the gap counts. Cost O(N).
template <int Dim>
std::vector<Contact<Dim>> contacts(const Configuration<Dim>& configuration, double tolerance);

/// What is left of a packing without its rattlers.
///
/// A particle is held if the normals at its contacts leave no half-plane (half-space) free: every
/// direction it might move to lies less than a right angle from the normal of one contact. Balance
/// of forces needs that, of round particles and of others alike, and it takes D + 1 contacts or more
/// in D dimensions. Particles that are not held are rattlers; they hold no others, so their contacts
/// are removed and the others judged again until all are held. The balance of torques is no part of
/// it: an ellipse may be held by three contacts whose normals meet in one point, by the curvatures
/// there (donev2007, schreck2012), and whether they meet exactly cannot be told from contacts that
/// are open by a little.
struct Backbone {
  std::size_t rattlers;
  std::size_t contacts;   ///< between particles that are held
  double contact_number;  ///< 2 contacts/(N − rattlers); NaN if all are rattlers
  /// 2 × degrees of freedom per particle: 4 for disks, 6 for ellipses and spheres, 10 for spheroids,
  /// 12 for scalene ellipsoids. Jammed disks and spheres have it, but for 1/N; others less, the less
  /// the rounder they are (donev2007).
  double isostatic_number;
};
template <int Dim>
Backbone backbone(const Configuration<Dim>& configuration, double tolerance);

/// From this reduced pressure on the contacts of a jammed packing can be told from other pairs.
inline constexpr double min_jammed_pressure = 1e5;

/// The backbone at the reduced pressure Z = βP/ρ, with a tolerance that follows from the state.
///
/// With d the mean diameter of disks (spheres) of equal area (volume): close to jamming a contact that
/// bears the force f is open by kT/f on the average, some d/Z for most, while the gaps of all other
/// pairs spread below d (donev2005pair). The tolerance is the geometric mean of both,
///
///     d Z^(−1/2),
///
/// and is doubled until more than half of the particles are held. Growth compresses faster than a
/// particle that came out of balance can move to its next support, and without it an isostatic
/// packing falls apart to the last particle. If more than d/10 were needed, the packing is not
/// jammed: the last tolerance is given, and hardly a particle is held.
///
/// Neighbours that nearly touch add some 1 % to the contacts of disks at Z = 10⁶, 2 to 3 % to those of spheres;
/// less at higher pressures and of others. A wide tolerance counts many more: 1000 spheres grown at the rate
/// 0.01 need 0.01 d and have 6.8 contacts each, at 0.003 and slower 6.1 to 6.2 with 0.001 d.
struct JammedBackbone : Backbone {
  double tolerance;
};
template <int Dim>
JammedBackbone jammed_backbone(const Configuration<Dim>& configuration, double reduced_pressure);

}  // namespace vitrel
