#pragma once

#include <hdf5.h>

#include "core/io/transactional_file.h"

namespace vitrel::h5 {

/// A file access property list, to be closed by the caller, that makes HDF5 read and write `file`
/// and nothing else. HDF5 never sees a failed write, which it would not survive: `file` keeps the
/// failure for `commit`. `file` must outlive the HDF5 file.
hid_t access_through(TransactionalFile& file);

}  // namespace vitrel::h5
