#pragma once

#include <filesystem>

#include "core/io/atomic_file.h"

namespace vitrel::bench {

/// A new folder for temporary files, removed with all that is in it.
struct ScratchFolder : AtomicFile {
  ScratchFolder()
      : AtomicFile(std::filesystem::temp_directory_path() / "vitrel-bench", make_partial_folder) {}
};

}  // namespace vitrel::bench
