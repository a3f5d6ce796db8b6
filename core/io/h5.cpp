#include "core/io/h5.h"

#include <hdf5.h>

#include <algorithm>
#include <functional>
#include <numeric>

#include "core/io/h5_open_file.h"

namespace vitrel::h5 {
namespace {

static_assert(std::is_same_v<Id, hid_t>);

constexpr hsize_t entries_per_chunk = 128;

template <class T>
Id native_type();
template <>
Id native_type<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
Id native_type<std::int32_t>() {
  return H5T_NATIVE_INT32;
}
template <>
Id native_type<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
Id native_type<std::uint64_t>() {
  return H5T_NATIVE_UINT64;
}
template <>
Id native_type<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}

template <class T>
Id stored_type();
template <>
Id stored_type<double>() {
  return H5T_IEEE_F64LE;
}
template <>
Id stored_type<std::int32_t>() {
  return H5T_STD_I32LE;
}
template <>
Id stored_type<std::int64_t>() {
  return H5T_STD_I64LE;
}
template <>
Id stored_type<std::uint64_t>() {
  return H5T_STD_U64LE;
}
template <>
Id stored_type<std::uint8_t>() {
  return H5T_STD_U8LE;
}

/// What stands for numbers that were never written: HDF5 takes a chunk that it does not find, because its index is
/// damaged, for one of those.
template <class T>
void mark_missing(Id properties, Id type = native_type<T>()) {
  const T missing = std::numeric_limits<T>::has_quiet_NaN ? std::numeric_limits<T>::quiet_NaN()
                                                          : std::numeric_limits<T>::min();
  H5Pset_fill_value(properties, type, &missing);
}

std::uint64_t elements(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::uint64_t{1}, std::multiplies<>());
}

}  // namespace

Object::Handle::~Handle() {
  if (id_ < 0) return;
  silence_hdf5();
  H5Idec_ref(id_);
}

Object::Handle& Object::Handle::operator=(Handle&& other) noexcept {
  std::swap(id_, other.id_);
  return *this;
}

Object::Object(std::shared_ptr<OpenFile> file, Handle handle, std::string name)
    : file_(std::move(file)), handle_(std::move(handle)), name_(std::move(name)) {}

bool Object::has_attribute(const std::string& name) const {
  return file_->run("look for attribute", name,
                    [&] { return H5Aexists(handle_.id(), name.c_str()); }) > 0;
}

void Object::write_attribute(const std::string& name, Id stored, Id memory, Id space,
                             const void* data) {
  if (has_attribute(name))
    file_->run("replace attribute", name, [&] { return H5Adelete(handle_.id(), name.c_str()); });
  const Handle attribute(file_->run("create attribute", name, [&] {
    return H5Acreate2(handle_.id(), name.c_str(), stored, space, H5P_DEFAULT, H5P_DEFAULT);
  }));
  file_->run("write attribute", name, [&] { return H5Awrite(attribute.id(), memory, data); });
}

void Object::set_attribute(const std::string& name, std::span<const std::string> texts,
                           std::size_t width) {
  std::string padded;
  for (const std::string& text : texts)
    padded += (text + std::string(width, '\0')).substr(0, width);
  const Handle type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type.id(), width);
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  const hsize_t count = texts.size();
  const Handle space(count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr));
  write_attribute(name, type.id(), type.id(), space.id(), padded.data());
}

void Object::set_attribute(const std::string& name, const std::string& text) {
  set_attribute(name, std::span<const std::string>(&text, 1),
                std::max<std::size_t>(1, text.size()));
}

template <class T>
void Object::set_attribute(const std::string& name, std::span<const T> values) {
  const hsize_t count = values.size();
  const Handle space(count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr));
  write_attribute(name, stored_type<T>(), native_type<T>(), space.id(), values.data());
}

namespace {

/// Reads one string of either kind HDF5 has; `read` fills memory of the type it is given.
template <class Read>
std::string read_string(Id stored, Read&& read) {
  if (H5Tget_class(stored) != H5T_STRING) return {};
  if (H5Tis_variable_str(stored) > 0) {
    char* text = nullptr;
    read(stored, &text);
    std::string copy = text ? text : "";
    H5free_memory(text);
    return copy;
  }
  std::string text(H5Tget_size(stored), '\0');
  read(stored, text.data());
  return text.substr(0, text.find('\0'));
}

}  // namespace

std::string Object::text_attribute(const std::string& name) const {
  const Handle attribute(file_->run(
      "open attribute", name, [&] { return H5Aopen(handle_.id(), name.c_str(), H5P_DEFAULT); }));
  const Handle type(H5Aget_type(attribute.id())), space(H5Aget_space(attribute.id()));
  if (H5Sget_simple_extent_npoints(space.id()) != 1)
    throw_file_error(file_->path(), "read attribute", name, "it is not one string");
  return read_string(type.id(), [&](Id memory, void* out) {
    file_->run("read attribute", name, [&] { return H5Aread(attribute.id(), memory, out); });
  });
}

template <class T>
T Object::number_attribute(const std::string& name) const {
  const Handle attribute(file_->run(
      "open attribute", name, [&] { return H5Aopen(handle_.id(), name.c_str(), H5P_DEFAULT); }));
  const Handle space(H5Aget_space(attribute.id()));
  std::vector<T> values(std::max<hssize_t>(1, H5Sget_simple_extent_npoints(space.id())));
  file_->run("read attribute", name,
             [&] { return H5Aread(attribute.id(), native_type<T>(), values.data()); });
  return values.front();
}

Shape Dataset::shape() const {
  const Handle space(file_->run("inspect", name_, [&] { return H5Dget_space(handle_.id()); }));
  Shape shape(std::max(0, H5Sget_simple_extent_ndims(space.id())));
  H5Sget_simple_extent_dims(space.id(), reinterpret_cast<hsize_t*>(shape.data()), nullptr);
  return shape;
}

namespace {

bool has_checksums(Id creation) {
  for (int k = 0; k < H5Pget_nfilters(creation); ++k) {
    unsigned flags = 0, configuration = 0;
    std::size_t values = 0;
    if (H5Pget_filter2(creation, static_cast<unsigned>(k), &flags, &values, nullptr, 0, nullptr,
                       &configuration) == H5Z_FILTER_FLETCHER32)
      return true;
  }
  return false;
}

}  // namespace

// HDF5 itself reads beyond the memory of such a chunk.
void Dataset::require_checksums(std::uint64_t first, std::uint64_t last) const {
  constexpr hsize_t checksum = 4;
  const Handle creation(
      file_->run("inspect", name_, [&] { return H5Dget_create_plist(handle_.id()); }));
  if (H5Pget_layout(creation.id()) != H5D_CHUNKED || !has_checksums(creation.id())) return;
  const Shape extent = shape();
  Shape chunk(extent.size());
  H5Pget_chunk(creation.id(), static_cast<int>(chunk.size()),
               reinterpret_cast<hsize_t*>(chunk.data()));
  Shape at(extent.size(), 0);
  at[0] = first / chunk[0] * chunk[0];
  while (at[0] <= last) {
    unsigned skipped = 0;
    haddr_t address = HADDR_UNDEF;
    hsize_t bytes = 0;
    file_->run("inspect", name_, [&] {
      return H5Dget_chunk_info_by_coord(handle_.id(), reinterpret_cast<const hsize_t*>(at.data()),
                                        &skipped, &address, &bytes);
    });
    if (address != HADDR_UNDEF && bytes < checksum)
      throw_file_error(file_->path(), "read", name_, "the file is damaged");
    std::size_t axis = at.size() - 1;
    for (at[axis] += chunk[axis]; axis > 0 && at[axis] >= extent[axis]; at[axis] += chunk[axis]) {
      at[axis] = 0;
      --axis;
    }
  }
}

template <class T>
std::vector<T> Dataset::read() const {
  const Shape extent = shape();
  std::vector<T> values(elements(extent));
  if (!values.empty() && !extent.empty()) require_checksums(0, extent[0] - 1);
  file_->run("read", name_, [&] {
    return H5Dread(handle_.id(), native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  });
  return values;
}

template <class T>
void Dataset::write(std::span<const T> values) {
  if (values.size() != elements(shape())) file_->fail("write", name_, "wrong number of values");
  file_->run("write", name_, [&] {
    return H5Dwrite(handle_.id(), native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  });
}

std::string Dataset::read_text() const {
  const Handle type(file_->run("inspect", name_, [&] { return H5Dget_type(handle_.id()); }));
  if (elements(shape()) != 1)
    throw_file_error(file_->path(), "read", name_, "it is not one string");
  return read_string(type.id(), [&](Id memory, void* out) {
    file_->run("read", name_,
               [&] { return H5Dread(handle_.id(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, out); });
  });
}

void Dataset::resize(std::uint64_t frames) {
  Shape extent = shape();
  extent.at(0) = frames;
  file_->run("resize", name_, [&] {
    return H5Dset_extent(handle_.id(), reinterpret_cast<const hsize_t*>(extent.data()));
  });
}

Dataset::FrameSpaces Dataset::frame_spaces(std::uint64_t frame, std::uint64_t count) const {
  Shape block = shape();
  if (block.empty() || frame >= block[0])
    throw_file_error(file_->path(), "access frame " + std::to_string(frame) + " of", name_,
                     "it has " + std::to_string(block.empty() ? 0 : block[0]) + " frames");
  block[0] = 1;
  if (elements(block) != count)
    throw_file_error(
        file_->path(), "access frame " + std::to_string(frame) + " of", name_,
        "a frame has " + std::to_string(elements(block)) + " values, not " + std::to_string(count));
  Shape start(block.size(), 0);
  start[0] = frame;
  Handle space(file_->run("inspect", name_, [&] { return H5Dget_space(handle_.id()); }));
  H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, reinterpret_cast<const hsize_t*>(start.data()),
                      nullptr, reinterpret_cast<const hsize_t*>(block.data()), nullptr);
  // Of the same shape: between spaces of different ranks HDF5 goes element by element.
  return {std::move(space),
          Handle(H5Screate_simple(static_cast<int>(block.size()),
                                  reinterpret_cast<const hsize_t*>(block.data()), nullptr))};
}

template <class T>
void Dataset::write_frame(std::uint64_t frame, std::span<const T> values) {
  const FrameSpaces spaces = frame_spaces(frame, values.size());
  file_->run("write", name_, [&] {
    return H5Dwrite(handle_.id(), native_type<T>(), spaces.memory.id(), spaces.file.id(),
                    H5P_DEFAULT, values.data());
  });
}

template <class T>
void Dataset::read_frame(std::uint64_t frame, std::span<T> values) const {
  const FrameSpaces spaces = frame_spaces(frame, values.size());
  require_checksums(frame, frame);
  file_->run("read", name_, [&] {
    return H5Dread(handle_.id(), native_type<T>(), spaces.memory.id(), spaces.file.id(),
                   H5P_DEFAULT, values.data());
  });
}

std::vector<std::string> Dataset::enumeration() const {
  const Handle type(file_->run("inspect", name_, [&] { return H5Dget_type(handle_.id()); }));
  if (H5Tget_class(type.id()) != H5T_ENUM) return {};
  std::vector<std::string> names;
  for (int member = 0; member < H5Tget_nmembers(type.id()); ++member) {
    std::int64_t value = 0;  // holds a member of any integer size before the conversion
    H5Tget_member_value(type.id(), member, &value);
    const Handle base(H5Tget_super(type.id()));
    H5Tconvert(base.id(), H5T_NATIVE_INT64, 1, &value, nullptr, H5P_DEFAULT);
    if (value < 0 || value > 1'000'000)
      throw_file_error(file_->path(), "read", name_, "its enumerated values do not count from 0");
    if (names.size() <= static_cast<std::size_t>(value)) names.resize(value + 1);
    char* name = H5Tget_member_name(type.id(), member);
    names[value] = name;
    H5free_memory(name);
  }
  return names;
}

std::string Group::path_of(const std::string& name) const {
  return name_.empty() ? name : name_ + '/' + name;
}

bool Group::has(const std::string& path) const {
  for (auto slash = path.find('/');; slash = path.find('/', slash + 1)) {
    const std::string part = path.substr(0, slash);
    if (file_->run("look for", path_of(part),
                   [&] { return H5Lexists(handle_.id(), part.c_str(), H5P_DEFAULT); }) == 0)
      return false;
    if (slash == std::string::npos) return true;
  }
}

bool Group::has_object(const std::string& path, int type) const {
  if (!has(path)) return false;
  const Handle object(file_->run("open", path_of(path),
                                 [&] { return H5Oopen(handle_.id(), path.c_str(), H5P_DEFAULT); }));
  return H5Iget_type(object.id()) == type;
}

bool Group::has_group(const std::string& path) const {
  return has_object(path, H5I_GROUP);
}

bool Group::has_dataset(const std::string& path) const {
  return has_object(path, H5I_DATASET);
}

std::vector<std::string> Group::members() const {
  std::vector<std::string> names;
  const auto add = [](Id, const char* name, const H5L_info_t*, void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  file_->run("list", name_, [&] {
    return H5Literate(handle_.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names);
  });
  return names;
}

Group Group::group(const std::string& path) const {
  return {file_,
          Handle(file_->run("open group", path_of(path),
                            [&] { return H5Gopen2(handle_.id(), path.c_str(), H5P_DEFAULT); })),
          path_of(path)};
}

Dataset Group::dataset(const std::string& path) const {
  return {file_,
          Handle(file_->run("open dataset", path_of(path),
                            [&] { return H5Dopen2(handle_.id(), path.c_str(), H5P_DEFAULT); })),
          path_of(path)};
}

Group Group::create_group(const std::string& name) {
  return {file_,
          Handle(file_->run("create group", path_of(name),
                            [&] {
                              return H5Gcreate2(handle_.id(), name.c_str(), H5P_DEFAULT,
                                                H5P_DEFAULT, H5P_DEFAULT);
                            })),
          path_of(name)};
}

Dataset Group::create(const std::string& name, Id type, Id space, Id properties) {
  return {file_,
          Handle(file_->run("create dataset", path_of(name),
                            [&] {
                              return H5Dcreate2(handle_.id(), name.c_str(), type, space,
                                                H5P_DEFAULT, properties, H5P_DEFAULT);
                            })),
          path_of(name)};
}

namespace {

/// Checksums exist for chunks only; one holds all of an array that is not huge.
template <class T>
Id with_checksum(const Shape& shape, Id type = native_type<T>()) {
  const Id properties = H5Pcreate(H5P_DATASET_CREATE);
  constexpr std::uint64_t largest = std::uint64_t{1} << 30;  // bytes; HDF5 allows 4 GiB
  const std::uint64_t bytes = elements(shape) * sizeof(T);
  if (shape.empty() || bytes == 0) return properties;
  Shape chunk = shape;
  chunk[0] = std::max<std::uint64_t>(1, chunk[0] / (1 + bytes / largest));
  H5Pset_chunk(properties, static_cast<int>(chunk.size()),
               reinterpret_cast<const hsize_t*>(chunk.data()));
  H5Pset_fletcher32(properties);
  mark_missing<T>(properties, type);
  return properties;
}

Id create_space(const Shape& shape) {
  if (shape.empty()) return H5Screate(H5S_SCALAR);
  return H5Screate_simple(static_cast<int>(shape.size()),
                          reinterpret_cast<const hsize_t*>(shape.data()), nullptr);
}

}  // namespace

template <class T>
Dataset Group::create_array(const std::string& name, const Shape& shape,
                            std::span<const T> values) {
  const Handle space(create_space(shape)), properties(with_checksum<T>(shape));
  Dataset dataset = create(name, stored_type<T>(), space.id(), properties.id());
  dataset.write(values);
  return dataset;
}

Dataset Group::create_text(const std::string& name, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type.id(), std::max<std::size_t>(1, text.size()));
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  const Handle space(H5Screate(H5S_SCALAR));
  Dataset dataset = create(name, type.id(), space.id(), H5P_DEFAULT);
  file_->run("write", dataset.name_, [&] {
    return H5Dwrite(dataset.handle_.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str());
  });
  return dataset;
}

Dataset Group::create_enumeration(const std::string& name, std::span<const std::string> names,
                                  std::span<const std::int32_t> values) {
  const Handle type(H5Tenum_create(H5T_NATIVE_INT32));
  for (std::int32_t value = 0; value < static_cast<std::int32_t>(names.size()); ++value)
    file_->run("name a value of", path_of(name),
               [&] { return H5Tenum_insert(type.id(), names[value].c_str(), &value); });
  const Shape shape{values.size()};
  const Handle space(create_space(shape)),
      properties(with_checksum<std::int32_t>(shape, type.id()));
  Dataset dataset = create(name, type.id(), space.id(), properties.id());
  file_->run("write", dataset.name_, [&] {
    return H5Dwrite(dataset.handle_.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  });
  return dataset;
}

template <class T>
Dataset Group::create_series(const std::string& name, const Shape& frame_shape,
                             SeriesStorage storage) {
  Shape extent{0};
  extent.insert(extent.end(), frame_shape.begin(), frame_shape.end());
  Shape limit = extent, chunk = extent;
  limit[0] = H5S_UNLIMITED;
  chunk[0] = storage == SeriesStorage::shared_chunks ? entries_per_chunk : 1;

  const int rank = static_cast<int>(extent.size());
  const Handle space(H5Screate_simple(rank, reinterpret_cast<const hsize_t*>(extent.data()),
                                      reinterpret_cast<const hsize_t*>(limit.data())));
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_chunk(properties.id(), rank, reinterpret_cast<const hsize_t*>(chunk.data()));
  if (storage == SeriesStorage::compressed_chunks) {
    H5Pset_shuffle(properties.id());
    H5Pset_deflate(properties.id(), 1);
  }
  H5Pset_fletcher32(properties.id());
  mark_missing<T>(properties.id());
  return create(name, stored_type<T>(), space.id(), properties.id());
}

void Group::remove(const std::string& name) {
  file_->run("remove", path_of(name),
             [&] { return H5Ldelete(handle_.id(), name.c_str(), H5P_DEFAULT); });
}

void Group::link(const std::string& name, const std::string& target) {
  file_->run("link", path_of(name), [&] {
    return H5Lcreate_hard(handle_.id(), ('/' + target).c_str(), handle_.id(), name.c_str(),
                          H5P_DEFAULT, H5P_DEFAULT);
  });
}

File File::create(const std::filesystem::path& path) {
  return File(std::make_shared<OpenFile>(path, TransactionalFile::Mode::create));
}

File File::open(const std::filesystem::path& path, Access access) {
  return File(std::make_shared<OpenFile>(path, access == Access::write
                                                   ? TransactionalFile::Mode::write
                                                   : TransactionalFile::Mode::read));
}

const std::string& File::path() const {
  return file_->path();
}

Group File::root() const {
  return {file_,
          Group::Handle(file_->run("open", "the root group",
                                   [&] { return H5Gopen2(file_->id(), "/", H5P_DEFAULT); })),
          ""};
}

void File::flush() {
  file_->flush();
}

void File::synchronize() {
  file_->synchronize();
}

void File::close() {
  file_->close();
}

#define VITREL_H5_INSTANTIATE(T)                                                                 \
  template void Object::set_attribute<T>(const std::string&, std::span<const T>);                \
  template T Object::number_attribute<T>(const std::string&) const;                              \
  template std::vector<T> Dataset::read<T>() const;                                              \
  template void Dataset::write<T>(std::span<const T>);                                           \
  template void Dataset::write_frame<T>(std::uint64_t, std::span<const T>);                      \
  template void Dataset::read_frame<T>(std::uint64_t, std::span<T>) const;                       \
  template Dataset Group::create_array<T>(const std::string&, const Shape&, std::span<const T>); \
  template Dataset Group::create_series<T>(const std::string&, const Shape&, SeriesStorage);

VITREL_H5_INSTANTIATE(double)
VITREL_H5_INSTANTIATE(std::int32_t)
VITREL_H5_INSTANTIATE(std::int64_t)
VITREL_H5_INSTANTIATE(std::uint64_t)
VITREL_H5_INSTANTIATE(std::uint8_t)
#undef VITREL_H5_INSTANTIATE

}  // namespace vitrel::h5
