#pragma once

#include <filesystem>
#include <string>

#include "core/io/foreign/foreign_frame.h"
#include "core/io/h5.h"

namespace vitrel {

/// A file as H5MD, and what became of its content on the way.
struct ImportedFile {
  h5::File file;
  std::string remark;         ///< a sentence for the user, or nothing
  std::string box_crossings;  ///< what the file would have to state them
};

/// The file as H5MD: opened if it is HDF5; otherwise a copy of all its frames, from GSD, extended XYZ or CSV, which its
/// content tells apart. The copy lies in the folder for temporary files and disappears with the process. What a file
/// does not have (images, angles, velocities) the copy does not have either, but for images that `known` asks for
/// (NearestImages); then HDF5 is copied, too.
///
/// All frames must have the same particles. FileError, which names the place in the file.
ImportedFile open_as_h5md(const std::filesystem::path& path, const KnownSystem& known);

/// The dimension of the file, of which this reads no more than the first frame. FileError.
int dimension_of_file(const std::filesystem::path& path, const KnownSystem& known);

}  // namespace vitrel
