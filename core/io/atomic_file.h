#pragma once

#include <filesystem>

namespace vitrel {

/// A file that is replaced atomically: it is written as `<path>.partial` in the same folder, and `commit` renames it.
/// Without a commit the destructor removes the partial file.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where to write.
  const std::filesystem::path& partial() const { return partial_; }
  /// Waits until the partial file is on disk, renames it to `path`, and waits for the folder. With `previous` not
  /// empty, renames an existing file at `path` to it first. Throws FileError; the old file then still exists, as
  /// `path` or as `previous`.
  void commit(const std::filesystem::path& previous = {});

 private:
  std::filesystem::path path_;
  std::filesystem::path partial_;
};

}  // namespace vitrel
