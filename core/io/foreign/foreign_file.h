#pragma once

#include <filesystem>

#include "core/io/foreign/foreign_frame.h"
#include "core/io/h5.h"

namespace vitrel {

/// The file as H5MD: opened if it is HDF5; otherwise a copy of all its frames, from GSD, extended XYZ or CSV, which its
/// content tells apart. The copy lies in the folder for temporary files and disappears with the process. What a file
/// does not have (images, angles, velocities) the copy does not have either.
///
/// All frames must have the same particles. FileError, which names the place in the file.
h5::File open_as_h5md(const std::filesystem::path& path, const KnownSystem& known);

/// The dimension of the file, of which this reads no more than the first frame. FileError.
int dimension_of_file(const std::filesystem::path& path, const KnownSystem& known);

}  // namespace vitrel
