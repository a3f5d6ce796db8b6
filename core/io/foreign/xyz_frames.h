#pragma once

#include <filesystem>

#include "core/io/foreign/foreign_frame.h"

namespace vitrel {

/// Extended XYZ, as OVITO, ASE and vitrel write it: the number of particles, a line of key=value, and a line per
/// particle, frame after frame.
///
///     Lattice="…"           cell vectors along x, y and z; needed unless the box is known
///     Origin="x y z"        lower corner of the box; the default is 0 0 0
///     pbc="T T F"           the frame lies in the plane; else it does if it has the property `angle`. A box that is
///                           not periodic along x or y is refused
///     Time, Step            or timestep
///     Properties=…          type or species; pos; id; map_shift (boxes crossed); angle; orientation (x, y, z, w);
///                           aspherical_shape (semi-axes) or radius; mass or masses; velo, vel or velocities; omega
///
/// Keys may be written in any case, with blanks around =, numbers with D exponents, and values as lists in brackets.
/// Other keys and properties are skipped. FileError.
std::unique_ptr<ForeignFrames> open_xyz(const std::filesystem::path& path);

}  // namespace vitrel
