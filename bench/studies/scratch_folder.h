#pragma once

#include <filesystem>

#include "core/io/atomic_file.h"

namespace vitrel::bench {

/// A new folder for temporary files. It is removed with all its contents.
struct ScratchFolder : AtomicFile {
  ScratchFolder()
      : AtomicFile(std::filesystem::temp_directory_path() / "vitrel-bench", make_partial_folder) {}
};

}  // namespace vitrel::bench
