// File systems without locks, as some shared ones are: an flock that fails takes the place of the C library's.
#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>

#include "core/error.h"
#include "core/io/checked.h"
#include "core/io/h5.h"

namespace {
int failure = 0;
}

// NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name)
extern "C" int flock(int descriptor, int operation) noexcept {
  static const auto own = reinterpret_cast<decltype(&flock)>(dlsym(RTLD_NEXT, "flock"));
  if (failure == 0) return own(descriptor, operation);
  errno = failure;
  return -1;
}

namespace vitrel {
namespace {

namespace fs = std::filesystem;

class NoLocks : public testing::TestWithParam<int> {
 protected:
  NoLocks() {
    h5::File::create(path_).close();
    failure = GetParam();
  }
  ~NoLocks() override {
    failure = 0;
    checked(unsetenv("HDF5_USE_FILE_LOCKING"), "unsetenv");
    fs::remove(path_);
  }

  const fs::path path_ =
      fs::path(testing::TempDir()) / ("no_locks_" + std::to_string(getpid()) + ".h5");
};

// Two programs that write at the same time would leave a file that nobody can read.
TEST_P(NoLocks, WritingIsRefusedUnlessTheUserSeesToIt) {
  for (const auto& open : {+[](const fs::path& path) { h5::File::open(path, h5::Access::write); },
                           +[](const fs::path& path) { h5::File::create(path).close(); }}) {
    try {
      open(path_);
      FAIL() << "it was opened";
    } catch (const FileError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("no_locks_"));
      EXPECT_THAT(error.what(), testing::HasSubstr("HDF5_USE_FILE_LOCKING=FALSE"));
    }
  }
  for (const char* off : {"FALSE", "0"}) {
    checked(setenv("HDF5_USE_FILE_LOCKING", off, 1), "setenv");
    EXPECT_NO_THROW(h5::File::open(path_, h5::Access::write).close());
  }
}

TEST_P(NoLocks, ReadingGoesOn) {
  EXPECT_NO_THROW(h5::File::open(path_, h5::Access::read));
}

INSTANTIATE_TEST_SUITE_P(, NoLocks, testing::Values(ENOLCK, ENOTSUP, ENOSYS));

}  // namespace
}  // namespace vitrel
