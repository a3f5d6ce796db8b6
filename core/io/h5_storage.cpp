#include "core/io/h5_open_file.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <vector>

namespace vitrel::h5 {
namespace {

std::vector<H5Z_filter_t> filters(const Check& check, const Handle& creation) {
  std::vector<H5Z_filter_t> found;
  const int number = check(H5Pget_nfilters(creation.id()));
  for (int k = 0; k < number; ++k) {
    unsigned flags = 0, configuration = 0;
    std::size_t values = 0;
    found.push_back(check(H5Pget_filter2(creation.id(), static_cast<unsigned>(k), &flags, &values,
                                         nullptr, 0, nullptr, &configuration)));
  }
  return found;
}

bool is_own_filter(H5Z_filter_t filter) {
  constexpr std::array own = {H5Z_FILTER_DEFLATE, H5Z_FILTER_SHUFFLE, H5Z_FILTER_FLETCHER32,
                              H5Z_FILTER_SZIP,    H5Z_FILTER_NBIT,    H5Z_FILTER_SCALEOFFSET};
  return std::ranges::find(own, filter) != own.end();
}

/// Returns whether the chunk at this place is stored. HDF5 1.10 searches the whole index to answer this, so only chunks
/// that seem to be empty are looked up.
bool has_chunk(const Check& check, const Handle& dataset, const Shape& at) {
  unsigned skipped = 0;
  haddr_t address = HADDR_UNDEF;
  hsize_t bytes = 0;
  check(H5Dget_chunk_info_by_coord(dataset.id(), reinterpret_cast<const hsize_t*>(at.data()),
                                   &skipped, &address, &bytes));
  return address != HADDR_UNDEF;
}

hsize_t file_size(const Check& check, const OpenFile& file) {
  hsize_t bytes = 0;
  check(H5Fget_filesize(file.id(), &bytes));
  return bytes;
}

}  // namespace

bool has_link(OpenFile& file, const Handle& group, const std::string& name,
              const std::string& path) {
  for (auto slash = path.find('/');; slash = path.find('/', slash + 1)) {
    const std::string part = path.substr(0, slash);
    const std::string whole = name.empty() ? part : name + '/' + part;
    const Check check(file, "look for", whole);
    if (check(H5Lexists(group.id(), part.c_str(), H5P_DEFAULT)) == 0) return false;
    H5L_info_t link;
    check(H5Lget_info(group.id(), part.c_str(), &link, H5P_DEFAULT));
    if (link.type != H5L_TYPE_HARD)
      throw_file_error(
          file.path(), "read", whole,
          link.type == H5L_TYPE_SOFT
              ? "it is a soft link; vitrel reads the object itself, or hard links to it"
              : "it is a link to another file; copy its data into this one");
    if (slash == std::string::npos) return true;
  }
}

namespace {

/// Throws FileError if an array states more numbers than it can have: a damaged file may state any size, for which
/// there would be no memory. The stored bytes of an array limit its size by the largest factor of compression; only
/// small arrays may have more numbers, which were never written.
void require_stored_numbers(OpenFile& file, const Handle& dataset, const std::string& name) {
  constexpr double best_compression = 1032, never_written = 1 << 23;
  const Check check(file, "inspect", name);
  double stated = 1;
  for (const std::uint64_t extent : shape_of(check, dataset))
    stated *= static_cast<double>(std::max<std::uint64_t>(1, extent));
  if (stated <= never_written) return;
  const hsize_t stored = std::min(H5Dget_storage_size(dataset.id()), file_size(check, file));
  if (stated > never_written + best_compression * static_cast<double>(stored))
    throw_file_error(
        file.path(), "read", name,
        fmt::format("its shape is that of {:g} numbers, but the file holds {} bytes of "
                    "them; it is damaged",
                    stated, stored));
}

}  // namespace

Shape shape_of(const Check& check, const Handle& dataset) {
  const Handle space(check(H5Dget_space(dataset.id())));
  Shape shape(check(H5Sget_simple_extent_ndims(space.id())));
  check(H5Sget_simple_extent_dims(space.id(), reinterpret_cast<hsize_t*>(shape.data()), nullptr));
  return shape;
}

std::size_t attribute_size(const Check& check, const Handle& attribute) {
  const Handle space(check(H5Aget_space(attribute.id())));
  const auto count = static_cast<std::size_t>(check(H5Sget_simple_extent_npoints(space.id())));
  if (count > largest_text)
    check.refuse(fmt::format("it states {} values; the file is damaged", count));
  return count;
}

void require_plain_storage(OpenFile& file, const Handle& dataset, const std::string& name) {
  const Check check(file, "inspect", name);
  const Handle creation(check(H5Dget_create_plist(dataset.id())));
  if (check(H5Pget_layout(creation.id())) == H5D_VIRTUAL)
    throw_file_error(file.path(), "read", name,
                     "it is a virtual dataset, whose data lie in others; copy them into this one");
  if (check(H5Pget_external_count(creation.id())) > 0)
    throw_file_error(file.path(), "read", name,
                     "its data lie in another file; copy them into this one");
  for (const H5Z_filter_t filter : filters(check, creation))
    if (!is_own_filter(filter))
      throw_file_error(file.path(), "read", name,
                       "it is stored by the filter " + std::to_string(filter) +
                           ", which is not one of HDF5's own; h5repack -f GZIP=1 changes that");
  require_stored_numbers(file, dataset, name);
}

void require_checksums(OpenFile& file, const Handle& dataset, const std::string& name,
                       const Shape& extent, std::uint64_t first, std::uint64_t last) {
  constexpr hsize_t checksum = 4;
  const Check check(file, "inspect", name);
  const Handle creation(check(H5Dget_create_plist(dataset.id())));
  if (check(H5Pget_layout(creation.id())) != H5D_CHUNKED ||
      std::ranges::count(filters(check, creation), H5Z_FILTER_FLETCHER32) == 0)
    return;
  Shape chunk(extent.size());
  check(H5Pget_chunk(creation.id(), static_cast<int>(chunk.size()),
                     reinterpret_cast<hsize_t*>(chunk.data())));
  const hsize_t whole = file_size(check, file);
  Shape at(extent.size(), 0);
  at[0] = first / chunk[0] * chunk[0];
  while (at[0] <= last) {
    hsize_t bytes = 0;
    check(H5Dget_chunk_storage_size(dataset.id(), reinterpret_cast<const hsize_t*>(at.data()),
                                    &bytes));
    if (bytes > whole || (bytes < checksum && has_chunk(check, dataset, at)))
      throw_file_error(file.path(), "read", name, "the file is damaged");
    std::size_t axis = at.size() - 1;
    for (at[axis] += chunk[axis]; axis > 0 && at[axis] >= extent[axis]; at[axis] += chunk[axis]) {
      at[axis] = 0;
      --axis;
    }
  }
}

}  // namespace vitrel::h5
