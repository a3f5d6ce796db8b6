#pragma once

#include <filesystem>

namespace vitrel {

/// A new folder that appears complete: its files are written into `partial()` (core/io/atomic_file.h), and `commit` renames
/// that. Without a commit the destructor removes it. Throws FileError.
class PendingFolder {
 public:
  explicit PendingFolder(std::filesystem::path folder);
  ~PendingFolder();
  PendingFolder(const PendingFolder&) = delete;
  PendingFolder& operator=(const PendingFolder&) = delete;

  /// Where to write.
  const std::filesystem::path& partial() const { return partial_; }
  void commit();

 private:
  std::filesystem::path folder_;
  std::filesystem::path partial_;  ///< empty once it is committed
};

}  // namespace vitrel
