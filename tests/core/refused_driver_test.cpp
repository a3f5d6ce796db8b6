#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "core/error.h"
#include "core/io/h5.h"

namespace {
bool is_refused = false;
}

// NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name)
extern "C" hid_t H5FDregister(const H5FD_class_t* driver) {
  static const auto own =
      reinterpret_cast<decltype(&H5FDregister)>(dlsym(RTLD_NEXT, "H5FDregister"));
  return is_refused ? -1 : own(driver);
}

namespace vitrel {
namespace {

[[noreturn]] void create_without_driver(const std::filesystem::path& path) {
  is_refused = true;
  try {
    h5::File::create(path).close();
  } catch (const FileError& error) {
    std::cerr << error.what() << '\n';
    std::filesystem::remove(path);
    std::exit(3);
  }
  std::exit(0);
}

// HDF5 would go on with its own driver, which writes past the transactions and the lock.
TEST(RefusedDriver, IsOneMessageThatNamesTheFileAndTheVersionOfHdf5) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // in a new process: a driver is registered once
  const std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) / ("refused_" + std::to_string(getpid()) + ".h5");
  EXPECT_EXIT(create_without_driver(path), testing::ExitedWithCode(3),
              "refused_.*h5: HDF5 refuses vitrel's file driver .*version: [0-9]+");
}

}  // namespace
}  // namespace vitrel
