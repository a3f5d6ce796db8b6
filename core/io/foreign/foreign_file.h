#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/io/foreign/foreign_frame.h"
#include "core/io/h5.h"

namespace vitrel {

/// What an import read, and what became of it, in the order in which it is printed: a heading ("format", "read",
/// "absent", "converted", "box crossings", "skipped") and a text for each. For vitrel's own files it is empty, or says
/// under `in_progress` up to which time a file that is being written was read.
using ImportReport = std::vector<std::pair<std::string, std::string>>;
inline constexpr const char* in_progress = "in progress";

/// A file in vitrel's own form of H5MD.
struct ImportedFile {
  h5::File file;
  ImportReport report;                ///< empty if the file is vitrel's own
  std::string box_crossings;          ///< what the file would have to have to state them
  bool angles_are_directors = false;  ///< known up to half turns
  std::vector<std::size_t> doubtful_frames = {};  ///< of nearest images (NearestImages)
  std::optional<FileUnits> units = {};  ///< for labels, not empty; vitrel's own files have none
};

/// The file as vitrel itself would have written it: opened if vitrel did, and otherwise a copy of all its frames. The
/// copy lies in the folder for temporary files and disappears with the process. What a file does not have (images,
/// angles, velocities) the copy does not have either, but for images that `known` asks for (NearestImages).
///
/// All frames must have the same particles, and state the same of them. FileError, which names the place in the file;
/// UserError for `known.import`.
ImportedFile open_as_h5md(const std::filesystem::path& path, const KnownSystem& known);

/// The dimension of the file, of which this reads no more than the first frame. FileError.
int dimension_of_file(const std::filesystem::path& path, const KnownSystem& known);

}  // namespace vitrel
