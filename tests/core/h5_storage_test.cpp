// What HDF5 can store and vitrel does not read: each is one message that names the object.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <functional>

#include "core/error.h"
#include "core/io/h5.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

constexpr hsize_t size = 4;

class StorageOfHdf5 : public testing::Test {
 protected:
  StorageOfHdf5() {
    fs::create_directories(folder_);
    write("other.h5", [](hid_t file) { add(file, "data", H5P_DEFAULT); });
  }
  ~StorageOfHdf5() override { fs::remove_all(folder_); }

  static void add(hid_t file, const char* name, hid_t properties) {
    const hid_t space = H5Screate_simple(1, &size, nullptr);
    const hid_t dataset =
        H5Dcreate2(file, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, properties, H5P_DEFAULT);
    ASSERT_GE(dataset, 0);
    constexpr std::array<double, size> numbers{1, 2, 3, 4};
    EXPECT_GE(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()),
              0);
    EXPECT_GE(H5Dclose(dataset), 0);
    EXPECT_GE(H5Sclose(space), 0);
  }

  void write(const char* name, const std::function<void(hid_t)>& content) const {
    const hid_t file = H5Fcreate((folder_ / name).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    ASSERT_GE(file, 0);
    content(file);
    EXPECT_GE(H5Fclose(file), 0);
  }

  /// A dataset that shows the one of this file and name; "." is the file itself.
  static void add_virtual(hid_t file, const char* source, const char* dataset) {
    const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    const hid_t space = H5Screate_simple(1, &size, nullptr);
    EXPECT_GE(H5Pset_virtual(properties, space, source, dataset, space), 0);
    const hid_t created =
        H5Dcreate2(file, "x", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, properties, H5P_DEFAULT);
    EXPECT_GE(created, 0);
    EXPECT_GE(H5Dclose(created), 0);
    EXPECT_GE(H5Sclose(space), 0);
    EXPECT_GE(H5Pclose(properties), 0);
  }

  void expect_refusal(const std::function<void(hid_t)>& content, const std::string& reason) const {
    write("a.h5", content);
    const h5::File file = h5::File::open(folder_ / "a.h5", h5::Access::read);
    try {
      const std::vector<double> numbers = file.root().dataset("x").read<double>();
      ADD_FAILURE() << reason << ": was read";
    } catch (const FileError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("a.h5: cannot read x: "));
      EXPECT_THAT(error.what(), testing::HasSubstr(reason));
    }
  }

  const fs::path folder_ = fs::path(testing::TempDir()) / ("storage_" + std::to_string(getpid()));
};

TEST_F(StorageOfHdf5, OfOtherDatasetsIsRefused) {
  for (const char* source : {"other.h5", "a.h5", "."})
    for (const char* dataset : {"data", "x"})  // x shows itself
      expect_refusal([&](hid_t file) { add_virtual(file, source, dataset); }, "virtual dataset");
}

TEST_F(StorageOfHdf5, InOtherFilesIsRefused) {
  expect_refusal(
      [&](hid_t file) {
        const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
        EXPECT_GE(H5Pset_external(properties, (folder_ / "raw").c_str(), 0, H5F_UNLIMITED), 0);
        add(file, "x", properties);
        EXPECT_GE(H5Pclose(properties), 0);
      },
      "another file");
  expect_refusal(
      [](hid_t file) {
        EXPECT_GE(H5Lcreate_external("other.h5", "data", file, "x", H5P_DEFAULT, H5P_DEFAULT), 0);
      },
      "link to another file");
}

TEST_F(StorageOfHdf5, BySoftLinksIsRefused) {
  for (const char* target : {"/data", "/x", "/nowhere"})
    expect_refusal(
        [&](hid_t file) {
          add(file, "data", H5P_DEFAULT);
          EXPECT_GE(H5Lcreate_soft(target, file, "x", H5P_DEFAULT, H5P_DEFAULT), 0);
        },
        "soft link");
}

// Memory for them would be missing, or take minutes to fill.
TEST_F(StorageOfHdf5, OfFewerNumbersThanStatedIsRefused) {
  constexpr hsize_t huge = hsize_t{1} << 40;
  for (const std::array<hsize_t, 2> extent :
       {std::array{huge, hsize_t{1}}, {huge, huge}, {huge, 0}})
    expect_refusal(
        [&](hid_t file) {
          const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
          constexpr std::array<hsize_t, 2> chunk{4, 1};
          EXPECT_GE(H5Pset_chunk(properties, 2, chunk.data()), 0);
          constexpr std::array<hsize_t, 2> none{0, 0}, all{H5S_UNLIMITED, H5S_UNLIMITED};
          const hid_t space = H5Screate_simple(2, none.data(), all.data());
          const hid_t dataset =
              H5Dcreate2(file, "x", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, properties, H5P_DEFAULT);
          EXPECT_GE(H5Dset_extent(dataset, extent.data()), 0);
          EXPECT_GE(H5Dclose(dataset), 0);
          EXPECT_GE(H5Sclose(space), 0);
          EXPECT_GE(H5Pclose(properties), 0);
        },
        "the file holds 0 bytes of them");
}

TEST_F(StorageOfHdf5, ThatVitrelReadsNeedsNothingElse) {
  const auto expect_read = [&](const std::function<void(hid_t)>& content) {
    write("a.h5", content);
    const h5::File file = h5::File::open(folder_ / "a.h5", h5::Access::read);
    EXPECT_THAT(file.root().dataset("x").read<double>(), testing::ElementsAre(1, 2, 3, 4));
  };
  expect_read([](hid_t file) { add(file, "x", H5P_DEFAULT); });
  expect_read([](hid_t file) {
    add(file, "data", H5P_DEFAULT);
    EXPECT_GE(H5Lcreate_hard(file, "data", file, "x", H5P_DEFAULT, H5P_DEFAULT), 0);
    EXPECT_GE(H5Lcreate_external("nowhere.h5", "y", file, "unused", H5P_DEFAULT, H5P_DEFAULT), 0);
  });
  expect_read([](hid_t file) {
    const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    EXPECT_GE(H5Pset_layout(properties, H5D_COMPACT), 0);
    add(file, "x", properties);
    EXPECT_GE(H5Pclose(properties), 0);
  });
  expect_read([](hid_t file) {
    const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    EXPECT_GE(H5Pset_chunk(properties, 1, &size), 0);
    EXPECT_GE(H5Pset_shuffle(properties), 0);
    EXPECT_GE(H5Pset_deflate(properties, 6), 0);
    EXPECT_GE(H5Pset_fletcher32(properties), 0);
    add(file, "x", properties);
    EXPECT_GE(H5Pclose(properties), 0);
  });
}

}  // namespace
}  // namespace vitrel
