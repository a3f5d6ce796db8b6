#pragma once

#include <filesystem>

/// @file
/// Files and folders that appear under their names only when they are complete. Until then they are called
/// `<path>.<random>.partial`, a name that nothing else had, and lie in the same folder. A process deletes only what it
/// made itself, so the partial files of a killed process stay.
namespace vitrel {

/// Makes an empty file, or a folder, whose name is the path with a random part and `.partial`. It follows no link.
/// Throws FileError.
std::filesystem::path make_partial_file(const std::filesystem::path& path);
std::filesystem::path make_partial_folder(const std::filesystem::path& path);

/// Deletes the unfinished files of this process, for a process that ends at once. It is safe in a signal handler.
void remove_unfinished_files() noexcept;

/// A file that is replaced atomically, or a new folder. It is written as `partial()`, and `commit` renames it. Without
/// a commit, the destructor removes the partial file or folder. If `path` is a link, the file that it leads to is
/// replaced.
class AtomicFile {
 public:
  /// `make_partial` is make_partial_file or make_partial_folder.
  explicit AtomicFile(
      std::filesystem::path path,
      std::filesystem::path (*make_partial)(const std::filesystem::path&) = make_partial_file);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// The name under which to write.
  const std::filesystem::path& partial() const { return partial_; }
  /// Waits until the partial file is on disk, renames it to `path`, and waits for the folder. If `previous` is not
  /// empty, an existing file at `path` is first renamed to `previous`. Throws FileError; the old file then still
  /// exists, as `path` or as `previous`.
  void commit(const std::filesystem::path& previous = {});

 private:
  std::filesystem::path path_;
  std::filesystem::path partial_;  ///< empty once it is committed
};

}  // namespace vitrel
