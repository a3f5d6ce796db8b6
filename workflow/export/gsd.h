#pragma once

#include <filesystem>
#include <memory>

#include "workflow/export/frame_sink.h"

namespace vitrel {

/// A trajectory in HOOMD-blue's schema of GSD, for HOOMD-blue, OVITO, freud and gsd.hoomd. Numbers
/// are rounded to single precision, so neighbours in contact may overlap by 1e-7 of the box.
///
///     configuration/step, dimensions, box = [L_x, L_y, L_z, 0, 0, 0]   in the plane L_z = 0
///     particles/N, position, image                 wrapped; unwrapped = position + image ∘ box
///     particles/orientation                        quaternion w, x, y, z; in the plane
///                                                  (cos θ/2, 0, 0, sin θ/2)
///     particles/types, typeid                      the species
///     particles/type_shapes                        {"type":"Ellipsoid","a":a,"b":b,"c":c} of a species whose particles
///         are all alike; in space a round one is {"type":"Sphere","diameter":2a}. In the plane c = b: HOOMD-blue and
///         OVITO do not take a flat one. A species of several shapes has {}
///     particles/diameter                           if there is such a species, and all of its particles are round
///     log/particles/semiaxes                       if some are not: of all particles, in double precision
///     particles/mass, moment_inertia               about the own axes; 0 where rotation is not
///         modelled: of round particles, about the axis of a spheroid, and out of the plane
///     particles/velocity                           if the trajectory has it
///     particles/angmom                             the quaternion 2 q (0, L), likewise; L = I ω in the
///         own axes, and of a spheroid I⊥ ω (core/geometry/ellipsoid.h)
///     log/time
///
/// The edges of the box are rounded up, and so no position is rounded out of it.
template <int Dim>
std::unique_ptr<FrameSink<Dim>> gsd_sink(const std::filesystem::path& path, StoredMotion motion);

}  // namespace vitrel
