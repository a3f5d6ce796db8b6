#pragma once

#include <gmock/gmock.h>
#include <sys/mount.h>

#include <fstream>
#include <string>

#include "core/error.h"
#include "tests/support/files.h"
#include "tests/support/partial_files.h"

namespace vitrel {

/// The disk is a real file system of 4 MB; its tests need the right to mount.
class SmallDisk : public Files {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(disk_ = file("disk"));
    if (mount("tmpfs", disk_.c_str(), "tmpfs", 0, "size=4m") != 0)
      GTEST_SKIP() << "mounting a small tmpfs is not permitted here";
    mounted_ = true;
  }
  void TearDown() override {
    if (mounted_) umount2(disk_.c_str(), MNT_DETACH);
  }

  /// Leaves `bytes` free, in whole pages.
  void fill(std::uint64_t bytes) {
    const std::uint64_t free = std::filesystem::space(disk_).available;
    std::ofstream(disk_ / "filler") << std::string(free > bytes ? free - bytes : 0, 'x');
  }
  void empty() { std::filesystem::remove(disk_ / "filler"); }

  /// Checks that `write` fails with only `bytes` free and leaves nothing that it began.
  template <class Write>
  void expect_no_space(std::uint64_t bytes, Write&& write) {
    fill(bytes);
    try {
      write();
      ADD_FAILURE() << "was written into " << bytes << " bytes";
    } catch (const FileError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("No space left on device")) << bytes;
    }
    EXPECT_THAT(partial_files(disk_), testing::IsEmpty());
  }

  std::filesystem::path disk_;
  bool mounted_ = false;
};

}  // namespace vitrel
