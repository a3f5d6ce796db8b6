#include <hdf5.h>

#include <algorithm>
#include <functional>
#include <new>

#include "core/error.h"
#include "core/io/h5_open_file.h"

namespace vitrel::h5 {
namespace {

/// What HDF5 holds for an open file; the base must come first.
struct DriverFile {
  H5FD_t base;
  TransactionalFile* file;
  haddr_t end_of_allocation;
};

DriverFile& self(H5FD_t* file) {
  return *reinterpret_cast<DriverFile*>(file);
}
const DriverFile& self(const H5FD_t* file) {
  return *reinterpret_cast<const DriverFile*>(file);
}

/// HDF5 also calls this for files that an open file refers to; none of them is opened.
H5FD_t* open_file(const char* name, unsigned, hid_t access, haddr_t) {
  const void* info = H5Pget_driver_info(access);
  if (!info) return nullptr;
  TransactionalFile* file = *static_cast<TransactionalFile* const*>(info);
  if (file->path() != name) return nullptr;
  auto* opened = new (std::nothrow) DriverFile{};
  if (!opened) return nullptr;
  opened->file = file;
  return &opened->base;
}

herr_t close_file(H5FD_t* file) {
  delete &self(file);
  return 0;
}

/// HDF5 compares files to recognise that one is open already.
int compare(const H5FD_t* x, const H5FD_t* y) {
  const std::less<const TransactionalFile*> before;
  return before(self(y).file, self(x).file) - before(self(x).file, self(y).file);
}

/// The features are those of HDF5's own driver for plain files, whose layout this driver keeps.
herr_t query(const H5FD_t*, unsigned long* features) {
  *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
              H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

/// HDF5 allocates from here on.
haddr_t get_end_of_allocation(const H5FD_t* file, H5FD_mem_t) {
  return std::max<haddr_t>(self(file).end_of_allocation, self(file).file->free_from());
}

herr_t set_end_of_allocation(H5FD_t* file, H5FD_mem_t, haddr_t end) {
  self(file).end_of_allocation = end;
  return 0;
}

haddr_t get_end_of_file(const H5FD_t* file, H5FD_mem_t) {
  return self(file).file->size();
}

herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t offset, std::size_t size, void* out) {
  return self(file).file->read(offset, {static_cast<std::byte*>(out), size}) ? 0 : -1;
}

herr_t write(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t offset, std::size_t size, const void* data) {
  TransactionalFile& written = *self(file).file;
  try {
    written.write(offset, {static_cast<const std::byte*>(data), size});
  } catch (const std::bad_alloc&) {
    written.give_up("not enough memory");
  }
  return 0;
}

herr_t truncate(H5FD_t* file, hid_t, hbool_t) {
  self(file).file->resize(self(file).end_of_allocation);
  return 0;
}

/// These do nothing, because TransactionalFile has its own lock.
herr_t lock(H5FD_t*, hbool_t) {
  return 0;
}
herr_t unlock(H5FD_t*) {
  return 0;
}

H5FD_class_t describe_driver() {
  H5FD_class_t driver{};
#ifdef H5FD_CLASS_VERSION  // HDF5 1.14 and later demand a number, too; these are free for drivers nobody shares
  driver.version = H5FD_CLASS_VERSION;
  driver.value = static_cast<H5FD_class_value_t>(H5_VFD_RESERVED + 118);
#endif
  driver.name = "vitrel";
  driver.maxaddr = HADDR_MAX;
  driver.fc_degree = H5F_CLOSE_STRONG;
  driver.fapl_size = sizeof(TransactionalFile*);
  driver.open = open_file;
  driver.close = close_file;
  driver.cmp = compare;
  driver.query = query;
  driver.get_eoa = get_end_of_allocation;
  driver.set_eoa = set_end_of_allocation;
  driver.get_eof = get_end_of_file;
  driver.read = read;
  driver.write = write;
  driver.truncate = truncate;
  driver.lock = lock;
  driver.unlock = unlock;
  const H5FD_mem_t free_lists[] = H5FD_FLMAP_DICHOTOMY;
  for (int type = 0; type < H5FD_MEM_NTYPES; ++type) driver.fl_map[type] = free_lists[type];
  return driver;
}

}  // namespace

hid_t access_through(TransactionalFile& file) {
  static const H5FD_class_t driver = describe_driver();
  static const hid_t registered = H5FDregister(&driver);
  TransactionalFile* info = &file;
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  if (access < 0 || H5Pset_driver(access, registered, &info) < 0)
    throw FileError(file.path().string() + ": HDF5 refuses vitrel's file driver (" H5_VERS_INFO
                                           ")");
  return access;
}

}  // namespace vitrel::h5
