#include "core/io/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <random>
#include <string>
#include <system_error>
#include <utility>

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

/// The names of unfinished files, for a signal handler, which must not access anything else. If there are more files
/// than places, which does not happen, the surplus files stay when the process ends at once.
std::array<std::atomic<const char*>, 8> unfinished{};

void exchange_unfinished(const char* from, const char* to) {
  for (std::atomic<const char*>& name : unfinished) {
    const char* expected = from;
    if (name.compare_exchange_strong(expected, to)) return;
  }
}

/// Calls `make` with one name after the other, until it makes a new file or folder.
fs::path make_partial(const fs::path& path, const char* what, const auto& make) {
  constexpr int attempts = 100;
  std::random_device random;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const fs::path partial = path.string() + "." + std::to_string(random()) + ".partial";
    if (make(partial)) return partial;
    if (errno != EEXIST) break;
  }
  throw FileError(path.string() + ": cannot create the " + what + ": " +
                  std::generic_category().message(errno));
}

/// Returns the file that a link leads to, whether this file exists or not.
fs::path target_of(const fs::path& path) {
  std::error_code error;
  const fs::path link = fs::read_symlink(path, error);
  if (error) return path;
  const fs::path target = fs::weakly_canonical(path.parent_path() / link, error);
  return error ? path : target;
}

}  // namespace

fs::path make_partial_file(const fs::path& path) {
  return make_partial(path, "file", [](const fs::path& partial) {
    const int descriptor =
        ::open(partial.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    return descriptor >= 0 && ::close(descriptor) == 0;
  });
}

fs::path make_partial_folder(const fs::path& path) {
  return make_partial(path, "folder",
                      [](const fs::path& partial) { return ::mkdir(partial.c_str(), 0777) == 0; });
}

void remove_unfinished_files() noexcept {
  for (const std::atomic<const char*>& name : unfinished)
    if (const char* file = name.load()) static_cast<void>(::unlink(file));
}

AtomicFile::AtomicFile(fs::path path, fs::path (*make_partial)(const fs::path&))
    : path_(target_of(path)), partial_(make_partial(path_)) {
  exchange_unfinished(nullptr, partial_.c_str());
}

AtomicFile::~AtomicFile() {
  if (partial_.empty()) return;
  std::error_code ignored;
  fs::remove_all(partial_, ignored);
  exchange_unfinished(partial_.c_str(), nullptr);
}

void AtomicFile::commit(const fs::path& previous) {
  synchronize(partial_);
  if (!previous.empty() && fs::exists(path_)) move_file(path_, previous);
  move_file(partial_, path_);
  exchange_unfinished(partial_.c_str(), nullptr);
  partial_.clear();
  synchronize(path_.has_parent_path() ? path_.parent_path() : ".");
}

}  // namespace vitrel
