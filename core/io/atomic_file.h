#pragma once

#include <filesystem>

namespace vitrel {

/// A file that appears under its name only when it is complete: it is written as `<path>.partial`
/// in the same folder, and `commit` renames it. Without a commit the partial file is removed.
class PendingFile {
 public:
  explicit PendingFile(std::filesystem::path path);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  /// Where to write.
  const std::filesystem::path& partial() const { return partial_; }
  /// Waits until the disk has the partial file, then renames it over `path`, then waits for the
  /// folder. With `previous` not empty, a file already at `path` is first renamed to it. Throws
  /// FileError; the file at `path` is then still what it was, under its name or as `previous`.
  void commit(const std::filesystem::path& previous = {});

 private:
  std::filesystem::path path_;
  std::filesystem::path partial_;
};

}  // namespace vitrel
