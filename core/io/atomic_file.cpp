#include "core/io/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "core/error.h"

namespace vitrel {
namespace fs = std::filesystem;
namespace {

void synchronize(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool done = descriptor >= 0 && (::fsync(descriptor) == 0 || errno == EINVAL);
  const int reason = errno;
  if (descriptor >= 0) static_cast<void>(::close(descriptor));
  if (!done)
    throw FileError(path.string() +
                    ": cannot save to the disk: " + std::generic_category().message(reason));
}

void move_file(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error)
    throw FileError(to.string() + ": cannot rename " + from.string() +
                    " to it: " + error.message());
}

}  // namespace

AtomicFile::AtomicFile(fs::path path) : path_(std::move(path)), partial_(path_) {
  partial_ += ".partial";
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  fs::remove(partial_, ignored);
}

void AtomicFile::commit(const fs::path& previous) {
  synchronize(partial_);
  if (!previous.empty() && fs::exists(path_)) move_file(path_, previous);
  move_file(partial_, path_);
  synchronize(path_.has_parent_path() ? path_.parent_path() : ".");
}

}  // namespace vitrel
