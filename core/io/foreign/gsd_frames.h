#pragma once

#include <filesystem>

#include "core/io/foreign/foreign_frame.h"

namespace vitrel {

/// A file of GSD in the schema of HOOMD-blue (https://gsd.readthedocs.io), file layers 1 and 2. Of particles:
/// N, types, typeid, type_shapes ("Sphere", "Disk" and "Ellipsoid"), position, orientation, image, mass, moment_inertia,
/// velocity and angmom; and configuration/step, dimensions and box, and log/time. What a frame does not have is as in the
/// first, and else the default of the schema, but for images that no frame after the first has: these are unknown.
/// Types with one name up to "#" and a number are one species, as vitrel writes a species of several shapes. Numbers are
/// in single precision. FileError.
std::unique_ptr<ForeignFrames> open_gsd(const std::filesystem::path& path);

}  // namespace vitrel
