#include "workflow/sweep/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "core/error.h"

namespace vitrel {

// Children inherit the descriptor and with it the lock, because a child that outlives a killed parent, even for the
// moment that it takes to die, still works in the folder.
FolderLock::FolderLock(const std::filesystem::path& folder)
    : path_(folder / "lock"),
      descriptor_(open(path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW, 0666)) {
  if (descriptor_ < 0)
    throw FileError(fmt::format("{}: cannot be written: {}", path_.string(), std::strerror(errno)));
}

FolderLock::~FolderLock() {
  static_cast<void>(close(descriptor_));
}

bool FolderLock::acquire(Share share, const std::function<bool()>& gives_up) {
  while (flock(descriptor_, (share == Share::alone ? LOCK_EX : LOCK_SH) | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK && errno != EINTR)
      throw FileError(
          fmt::format("{}: cannot be locked: {}", path_.string(), std::strerror(errno)));
    if (gives_up()) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return true;
}

void FolderLock::hold_alone() {
  // Children of a killed sweep may take up to a second to die.
  int asked = 0;
  if (!acquire(Share::alone, [&asked] { return ++asked > 10; }))
    throw UserError(path_.parent_path().string() +
                    ": another process works on this sweep; wait for it or stop it "
                    "(vitrel sweep --status shows how far it is)");
}

}  // namespace vitrel
