#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/io/foreign/foreign_frame.h"
#include "core/io/h5.h"

namespace vitrel {

/// The report of an import, in the order in which it is printed: pairs of a heading ("format", "frames", "read",
/// "absent", "converted", "box crossings", "skipped") and a text. For vitrel's own files it is empty, or says under
/// `in_progress` up to which time a file that is being written was read.
using ImportReport = std::vector<std::pair<std::string, std::string>>;
inline constexpr const char* in_progress = "in progress";

/// A file in vitrel's own form of H5MD.
struct ImportedFile {
  h5::File file;
  ImportReport report;                ///< empty if the file is vitrel's own
  std::string box_crossings;          ///< what a file of this format needs to state them
  bool angles_are_directors = false;  ///< angles are known up to half turns
  std::vector<std::size_t> doubtful_frames = {};  ///< frames with doubtful nearest images
  std::optional<FileUnits> units = {};  ///< for labels, not empty; vitrel's own files have none
};

/// Returns the file as vitrel itself would have written it. A file that vitrel wrote is opened; otherwise, this is a
/// copy of all frames, which lies in the folder for temporary files and disappears with the process. The copy lacks
/// what the file lacks (images, angles, velocities), except for images that `known` requests (NearestImages).
///
/// All frames must have the same particles, and state the same quantities for them. Throws FileError, which names the
/// place in the file, or UserError for `known.import`.
ImportedFile open_as_h5md(const std::filesystem::path& path, const KnownSystem& known);

/// Returns the dimension of the file, and reads no more than its first frame. Throws FileError.
int dimension_of_file(const std::filesystem::path& path, const KnownSystem& known);

}  // namespace vitrel
