#pragma once

#include <filesystem>
#include <functional>

namespace vitrel {

/// Keeps other processes of the program out of a folder, by the file `lock` in it. The kernel lets go
/// when this process and those it started have ended, however they did.
class FolderLock {
 public:
  enum class Share { alone, with_others };

  /// Throws FileError if the file cannot be made.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Holds the folder, or returns false if others hold it and `gives_up`, asked ten times a second,
  /// says so. Throws FileError where the file system has no locks.
  bool acquire(Share share, const std::function<bool()>& gives_up);

  /// Holds it alone. Throws UserError if after a second others still hold it.
  void hold_alone();

 private:
  std::filesystem::path path_;
  int descriptor_;
};

}  // namespace vitrel
