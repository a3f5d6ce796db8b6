#pragma once

#include <filesystem>
#include <functional>

namespace vitrel {

/// Keeps other processes of the program out of a folder by the file `lock` in it. The kernel releases the lock when
/// this process and its children have ended, however they ended.
class FolderLock {
 public:
  enum class Share { alone, with_others };

  /// Throws FileError if the file cannot be created.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Waits until this process holds the lock. Returns false if other processes hold it and `gives_up`, called ten
  /// times a second, returns true. Throws FileError if the file system does not support locks.
  bool acquire(Share share, const std::function<bool()>& gives_up);

  /// Acquires the lock for this process alone. Throws UserError if other processes still hold it after a second.
  void hold_alone();

 private:
  std::filesystem::path path_;
  int descriptor_;
};

}  // namespace vitrel
