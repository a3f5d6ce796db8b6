#pragma once

#include <filesystem>
#include <memory>

#include "workflow/export/frame_sink.h"

namespace vitrel {

/// A trajectory in HOOMD-blue's schema of GSD, for HOOMD-blue, OVITO, freud and gsd.hoomd. Numbers are rounded to
/// single precision, so neighbours in contact may overlap by 1e-7 of the box.
///
///     configuration/step, dimensions, box = [L_x, L_y, L_z, 0, 0, 0]   in the plane L_z = 0
///     particles/N, position, image                 wrapped; unwrapped = position + image ∘ box
///     particles/orientation                        quaternion w, x, y, z; in the plane
///                                                  (cos θ/2, 0, 0, sin θ/2)
///     particles/types, typeid                      the species
///     particles/type_shapes                        the shape of each species:
///         {"type":"Ellipsoid","a":a,"b":b,"c":c}; in space {"type":"Sphere","diameter":2a} if it is round.
///         In the plane c = b, since HOOMD-blue and OVITO do not accept flat bodies. A species whose
///         particles differ in shape has {}.
///     particles/diameter                           if there is such a species, and all its particles are round
///     log/particles/semiaxes                       if some of them are not round: of all particles, as doubles
///     particles/mass, moment_inertia               about the own axes; 0 where rotation is not
///         modelled: for round particles, about the axis of a spheroid, and out of the plane
///     particles/velocity                           if the trajectory has velocities
///     particles/angmom                             the quaternion 2 q (0, L) if it has angular velocities; L = I ω
///         in the own axes, and L = I⊥ ω for a spheroid (core/geometry/ellipsoid.h)
///     log/time
///
/// The edges of the box are rounded up, so that no position is rounded out of it.
template <int Dim>
std::unique_ptr<FrameSink<Dim>> gsd_sink(const std::filesystem::path& path, StoredMotion motion);

}  // namespace vitrel
