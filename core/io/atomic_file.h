#pragma once

#include <filesystem>

/// @file
/// Files and folders that appear under their names when they are complete. Until then they are called
/// `<path>.<random>.partial`, a name that nothing else had, and lie in the same folder. A process deletes only what it
/// made itself; what a killed one left stays.
namespace vitrel {

/// Makes an empty file, or a folder, of such a name, and follows no link. FileError.
std::filesystem::path make_partial_file(const std::filesystem::path& path);
std::filesystem::path make_partial_folder(const std::filesystem::path& path);

/// Deletes the files that are not finished yet, before the process ends at once. Safe in a signal handler.
void remove_unfinished_files() noexcept;

/// A file that is replaced atomically, or a new folder: it is written as `partial()`, and `commit` renames it. Without
/// a commit the destructor removes what is partial. If `path` is a link, the file that it leads to is replaced.
class AtomicFile {
 public:
  /// `make_partial` is one of both above.
  explicit AtomicFile(
      std::filesystem::path path,
      std::filesystem::path (*make_partial)(const std::filesystem::path&) = make_partial_file);
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
  std::filesystem::path partial_;  ///< empty once it is committed
};

}  // namespace vitrel
