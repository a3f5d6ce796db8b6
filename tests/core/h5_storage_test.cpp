// What HDF5 can store and vitrel does not read: each is one message that names the object.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <array>
#include <functional>

#include "core/error.h"
#include "core/io/h5.h"
#include "tests/support/files.h"

namespace vitrel {
namespace {

constexpr hsize_t size = 4;

class StorageOfHdf5 : public Files {
 protected:
  using Content = std::function<void(hid_t)>;

  StorageOfHdf5() {
    write("other.h5", [](hid_t file) { add(file, "data"); });
  }

  void write(const char* name, const Content& content) const {
    const hid_t created = H5Fcreate(file(name).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    ASSERT_GE(created, 0);
    content(created);
    EXPECT_GE(H5Fclose(created), 0);
  }

  /// `use` gets a new dataset in this space with the properties that `configure` sets.
  static void create(hid_t file, const char* name, hid_t space, const Content& configure,
                     const Content& use) {
    const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    configure(properties);
    const hid_t dataset =
        H5Dcreate2(file, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, properties, H5P_DEFAULT);
    ASSERT_GE(dataset, 0);
    use(dataset);
    EXPECT_GE(H5Dclose(dataset), 0);
    EXPECT_GE(H5Sclose(space), 0);
    EXPECT_GE(H5Pclose(properties), 0);
  }

  static void add(
      hid_t file, const char* name, const Content& configure = [](hid_t) {}) {
    create(file, name, H5Screate_simple(1, &size, nullptr), configure, [](hid_t dataset) {
      constexpr std::array<double, size> numbers{1, 2, 3, 4};
      EXPECT_GE(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()),
                0);
    });
  }

  /// A dataset that shows the one of this file and name; "." is the file itself.
  static void add_virtual(hid_t file, const char* source, const char* dataset) {
    const hid_t space = H5Screate_simple(1, &size, nullptr);
    const auto show = [&](hid_t properties) {
      EXPECT_GE(H5Pset_virtual(properties, space, source, dataset, space), 0);
    };
    create(file, "x", space, show, [](hid_t) {});
  }

  h5::File written(const Content& content) const {
    write("a.h5", content);
    return h5::File::open(file("a.h5"), h5::Access::read);
  }
  void expect_read(const Content& content) const {
    const h5::File file = written(content);
    EXPECT_THAT(file.root().dataset("x").read<double>(), testing::ElementsAre(1, 2, 3, 4));
  }
  void expect_refusal(const Content& content, const std::string& reason) const {
    const h5::File file = written(content);
    try {
      const std::vector<double> numbers = file.root().dataset("x").read<double>();
      ADD_FAILURE() << reason << ": was read";
    } catch (const FileError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("a.h5: cannot read x: "));
      EXPECT_THAT(error.what(), testing::HasSubstr(reason));
    }
  }
};

TEST_F(StorageOfHdf5, OfOtherDatasetsIsRefused) {
  for (const char* source : {"other.h5", "a.h5", "."})
    for (const char* dataset : {"data", "x"})  // x shows itself
      expect_refusal([&](hid_t file) { add_virtual(file, source, dataset); }, "virtual dataset");
}

TEST_F(StorageOfHdf5, InOtherFilesIsRefused) {
  const auto put_outside = [&](hid_t properties) {
    EXPECT_GE(H5Pset_external(properties, file("raw").c_str(), 0, H5F_UNLIMITED), 0);
  };
  expect_refusal([&](hid_t file) { add(file, "x", put_outside); }, "another file");
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
          add(file, "data");
          EXPECT_GE(H5Lcreate_soft(target, file, "x", H5P_DEFAULT, H5P_DEFAULT), 0);
        },
        "soft link");
}

// Memory for them would be missing, or take minutes to fill.
TEST_F(StorageOfHdf5, OfFewerNumbersThanStatedIsRefused) {
  constexpr hsize_t huge = hsize_t{1} << 40;
  constexpr std::array<hsize_t, 2> chunk{4, 1}, none{0, 0}, all{H5S_UNLIMITED, H5S_UNLIMITED};
  const auto in_chunks = [&](hid_t properties) {
    EXPECT_GE(H5Pset_chunk(properties, 2, chunk.data()), 0);
  };
  for (const std::array<hsize_t, 2> extent :
       {std::array{huge, hsize_t{1}}, {huge, huge}, {huge, 0}}) {
    const auto extend = [&](hid_t dataset) { EXPECT_GE(H5Dset_extent(dataset, extent.data()), 0); };
    expect_refusal(
        [&](hid_t file) {
          create(file, "x", H5Screate_simple(2, none.data(), all.data()), in_chunks, extend);
        },
        "the file holds 0 bytes of them");
  }
}

TEST_F(StorageOfHdf5, ThatVitrelReadsNeedsNothingElse) {
  expect_read([](hid_t file) { add(file, "x"); });
  expect_read([](hid_t file) {
    add(file, "data");
    EXPECT_GE(H5Lcreate_hard(file, "data", file, "x", H5P_DEFAULT, H5P_DEFAULT), 0);
    EXPECT_GE(H5Lcreate_external("nowhere.h5", "y", file, "unused", H5P_DEFAULT, H5P_DEFAULT), 0);
  });
  const auto compact = [](hid_t properties) {
    EXPECT_GE(H5Pset_layout(properties, H5D_COMPACT), 0);
  };
  expect_read([&](hid_t file) { add(file, "x", compact); });
  const auto filtered = [](hid_t properties) {
    EXPECT_GE(H5Pset_chunk(properties, 1, &size), 0);
    EXPECT_GE(H5Pset_shuffle(properties), 0);
    EXPECT_GE(H5Pset_deflate(properties, 6), 0);
    EXPECT_GE(H5Pset_fletcher32(properties), 0);
  };
  expect_read([&](hid_t file) { add(file, "x", filtered); });
}

}  // namespace
}  // namespace vitrel
