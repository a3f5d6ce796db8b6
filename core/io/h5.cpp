#include "core/io/h5.h"

#include <hdf5.h>

#include <algorithm>
#include <functional>
#include <numeric>

#include "core/io/h5_open_file.h"

namespace vitrel::h5 {
namespace {

static_assert(std::is_same_v<Id, hid_t>);

/// HDF5's identifiers of a type of number: in memory, and in the file.
struct TypeNames {
  Id native, stored;
};
template <class T>
TypeNames type_names() {
  if constexpr (std::is_same_v<T, double>) return {H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE};
  if constexpr (std::is_same_v<T, float>) return {H5T_NATIVE_FLOAT, H5T_IEEE_F32LE};
  if constexpr (std::is_same_v<T, std::int16_t>) return {H5T_NATIVE_INT16, H5T_STD_I16LE};
  if constexpr (std::is_same_v<T, std::int32_t>) return {H5T_NATIVE_INT32, H5T_STD_I32LE};
  if constexpr (std::is_same_v<T, std::int64_t>) return {H5T_NATIVE_INT64, H5T_STD_I64LE};
  if constexpr (std::is_same_v<T, std::uint64_t>) return {H5T_NATIVE_UINT64, H5T_STD_U64LE};
  if constexpr (std::is_same_v<T, std::uint8_t>) return {H5T_NATIVE_UINT8, H5T_STD_U8LE};
}

/// Sets the value that stands for numbers that were never written. HDF5 also gives this value for a chunk that it does
/// not find because its index is damaged.
template <class T>
void mark_missing(const Check& check, const Handle& properties, Id type) {
  const T missing = std::numeric_limits<T>::has_quiet_NaN ? std::numeric_limits<T>::quiet_NaN()
                                                          : std::numeric_limits<T>::min();
  check(H5Pset_fill_value(properties.id(), type, &missing));
}

std::uint64_t elements(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::uint64_t{1}, std::multiplies<>());
}

const hsize_t* sizes(const Shape& shape) {
  return reinterpret_cast<const hsize_t*>(shape.data());
}
hsize_t* sizes(Shape& shape) {
  return reinterpret_cast<hsize_t*>(shape.data());
}

Handle create_space(const Check& check, const Shape& shape) {
  if (shape.empty()) return Handle(check(H5Screate(H5S_SCALAR)));
  return Handle(check(H5Screate_simple(static_cast<int>(shape.size()), sizes(shape), nullptr)));
}

/// Returns the type of texts of `width` bytes, padded with zeros.
Handle text_type(const Check& check, std::size_t width) {
  Handle type(check(H5Tcopy(H5T_C_S1)));
  check(H5Tset_size(type.id(), width));
  check(H5Tset_strpad(type.id(), H5T_STR_NULLPAD));
  check(H5Tset_cset(type.id(), H5T_CSET_UTF8));
  return type;
}

}  // namespace

Handle::~Handle() {
  if (id_ <= 0) return;  // none, or HDF5's default
  silence_hdf5();
  // The identifiers of a closed file are not valid. An object that cannot be closed here is closed with its file.
  if (H5Iis_valid(id_) > 0) static_cast<void>(H5Idec_ref(id_));
}

Handle& Handle::operator=(Handle&& other) noexcept {
  std::swap(id_, other.id_);
  return *this;
}

Object::Object(std::shared_ptr<OpenFile> file, Handle handle, std::string name)
    : file_(std::move(file)), handle_(std::move(handle)), name_(std::move(name)) {}

bool Object::has_attribute(const std::string& name) const {
  const Check check(*file_, "look for attribute", name);
  return check(H5Aexists(handle_.id(), name.c_str())) > 0;
}

void Object::write_attribute(const std::string& name, Id stored, Id memory, std::size_t count,
                             const void* data) {
  const Check check(*file_, "write attribute", name);
  if (has_attribute(name)) check(H5Adelete(handle_.id(), name.c_str()));
  const Handle space = create_space(check, count == 1 ? Shape{} : Shape{count});
  const Handle attribute(
      check(H5Acreate2(handle_.id(), name.c_str(), stored, space.id(), H5P_DEFAULT, H5P_DEFAULT)));
  check(H5Awrite(attribute.id(), memory, data));
}

void Object::set_attribute(const std::string& name, std::span<const std::string> texts,
                           std::size_t width) {
  std::string padded;
  for (const std::string& text : texts)
    padded += (text + std::string(width, '\0')).substr(0, width);
  const Handle type = text_type({*file_, "write attribute", name}, width);
  write_attribute(name, type.id(), type.id(), texts.size(), padded.data());
}

void Object::set_attribute(const std::string& name, const std::string& text) {
  set_attribute(name, std::span<const std::string>(&text, 1),
                std::max<std::size_t>(1, text.size()));
}

template <class T>
void Object::set_attribute(const std::string& name, std::span<const T> values) {
  write_attribute(name, type_names<T>().stored, type_names<T>().native, values.size(),
                  values.data());
}

namespace {

/// Reads strings of fixed or variable length; `read` fills memory of the type it is given.
std::vector<std::string> read_strings(const Check& check, const Handle& stored, std::size_t count,
                                      auto&& read) {
  if (check(H5Tget_class(stored.id())) != H5T_STRING) check.refuse("it is not a text");
  std::vector<std::string> texts(count);
  if (check(H5Tis_variable_str(stored.id())) > 0) {
    std::vector<char*> pointers(count, nullptr);
    check(read(stored.id(), pointers.data()));
    for (std::size_t k = 0; k < count; ++k) {
      texts[k] = pointers[k] ? pointers[k] : "";
      check(H5free_memory(pointers[k]));
    }
    return texts;
  }
  const std::size_t width = check(H5Tget_size(stored.id()));
  if (width > largest_text / std::max<std::size_t>(1, count))
    check.refuse("it states a text of " + std::to_string(width) + " bytes; the file is damaged");
  std::string block(count * width, '\0');
  check(read(stored.id(), block.data()));
  for (std::size_t k = 0; k < count; ++k) texts[k] = block.substr(k * width, width).c_str();
  return texts;
}

}  // namespace

std::vector<std::string> Object::texts_attribute(const std::string& name) const {
  const Check check(*file_, "read attribute", name);
  const Handle attribute(check(H5Aopen(handle_.id(), name.c_str(), H5P_DEFAULT)));
  const Handle type(check(H5Aget_type(attribute.id())));
  return read_strings(check, type, attribute_size(check, attribute),
                      [&](Id memory, void* out) { return H5Aread(attribute.id(), memory, out); });
}

std::string Object::text_attribute(const std::string& name) const {
  const std::vector<std::string> texts = texts_attribute(name);
  if (texts.size() != 1)
    throw_file_error(file_->path(), "read attribute", name, "it is not one string");
  return texts.front();
}

template <class T>
T Object::number_attribute(const std::string& name) const {
  const Check check(*file_, "read attribute", name);
  const Handle attribute(check(H5Aopen(handle_.id(), name.c_str(), H5P_DEFAULT)));
  if (attribute_size(check, attribute) != 1) check.refuse("it is not one number");
  T value{};
  check(H5Aread(attribute.id(), type_names<T>().native, &value));
  return value;
}

Shape Dataset::shape() const {
  return shape_of({*file_, "inspect", name_}, handle_);
}

template <class T>
std::vector<T> Dataset::read() const {
  const Shape extent = shape();
  std::vector<T> values(elements(extent));
  if (!values.empty() && !extent.empty())
    require_checksums(*file_, handle_, name_, extent, 0, extent[0] - 1);
  const Check check(*file_, "read", name_);
  check(
      H5Dread(handle_.id(), type_names<T>().native, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  return values;
}

template <class T>
void Dataset::write(std::span<const T> values) {
  if (values.size() != elements(shape())) file_->fail("write", name_, "wrong number of values");
  const Check check(*file_, "write", name_);
  check(
      H5Dwrite(handle_.id(), type_names<T>().native, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
}

std::string Dataset::read_text() const {
  if (elements(shape()) != 1)
    throw_file_error(file_->path(), "read", name_, "it is not one string");
  const Check check(*file_, "read", name_);
  const auto texts =
      read_strings(check, Handle(check(H5Dget_type(handle_.id()))), 1, [&](Id memory, void* out) {
        return H5Dread(handle_.id(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, out);
      });
  return texts.front();
}

void Dataset::resize(std::uint64_t frames) {
  Shape extent = shape();
  extent.at(0) = frames;
  const Check check(*file_, "resize", name_);
  check(H5Dset_extent(handle_.id(), sizes(extent)));
}

std::uint64_t Dataset::frames_per_chunk() const {
  const Check check(*file_, "inspect", name_);
  const Handle creation(check(H5Dget_create_plist(handle_.id())));
  if (check(H5Pget_layout(creation.id())) != H5D_CHUNKED) return 1;
  Shape chunk(shape().size());
  check(H5Pget_chunk(creation.id(), static_cast<int>(chunk.size()), sizes(chunk)));
  return chunk.front();
}

std::size_t Dataset::bytes_per_number() const {
  const Check check(*file_, "inspect", name_);
  const Handle type(check(H5Dget_type(handle_.id())));
  return check(H5Tget_size(type.id()));
}

Dataset::FrameSpaces Dataset::frame_spaces(std::uint64_t first, std::uint64_t count,
                                           std::uint64_t values) const {
  Shape block = shape();
  const std::uint64_t frames = block.empty() ? 0 : block[0];
  if (count > frames || first > frames - count)
    throw_file_error(file_->path(), "access frame " + std::to_string(first + count - 1) + " of",
                     name_, "it has " + std::to_string(frames) + " frames");
  block[0] = count;
  if (elements(block) != values)
    throw_file_error(file_->path(), "access frame " + std::to_string(first) + " of", name_,
                     std::to_string(count) + " frames have " + std::to_string(elements(block)) +
                         " values, not " + std::to_string(values));
  Shape start(block.size(), 0);
  start[0] = first;
  const Check check(*file_, "access", name_);
  Handle space(check(H5Dget_space(handle_.id())));
  check(H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, sizes(start), nullptr, sizes(block),
                            nullptr));
  // Both spaces have the same shape, because HDF5 copies element by element between different ranks.
  return {std::move(space), create_space(check, block)};
}

template <class T>
void Dataset::write_frames(std::uint64_t first, std::uint64_t count, std::span<const T> values) {
  const FrameSpaces spaces = frame_spaces(first, count, values.size());
  const Check check(*file_, "write", name_);
  check(H5Dwrite(handle_.id(), type_names<T>().native, spaces.memory.id(), spaces.file.id(),
                 H5P_DEFAULT, values.data()));
}

template <class T>
std::vector<T> Dataset::read_frames(std::uint64_t first, std::uint64_t count,
                                    std::uint64_t numbers) const {
  const FrameSpaces spaces = frame_spaces(first, count, count * numbers);
  std::vector<T> values(count * numbers);
  if (values.empty()) return values;
  require_checksums(*file_, handle_, name_, shape(), first, first + count - 1);
  const Check check(*file_, "read", name_);
  check(H5Dread(handle_.id(), type_names<T>().native, spaces.memory.id(), spaces.file.id(),
                H5P_DEFAULT, values.data()));
  return values;
}

std::vector<std::string> Dataset::enumeration() const {
  const Check check(*file_, "inspect", name_);
  const Handle type(check(H5Dget_type(handle_.id())));
  if (check(H5Tget_class(type.id())) != H5T_ENUM) return {};
  const Handle base(check(H5Tget_super(type.id())));
  std::vector<std::string> names;
  const int members = check(H5Tget_nmembers(type.id()));
  for (int member = 0; member < members; ++member) {
    std::int64_t value = 0;  // holds a member of any integer size before the conversion
    check(H5Tget_member_value(type.id(), member, &value));
    check(H5Tconvert(base.id(), H5T_NATIVE_INT64, 1, &value, nullptr, H5P_DEFAULT));
    if (value < 0 || value > 1'000'000)
      throw_file_error(file_->path(), "read", name_, "its enumerated values do not count from 0");
    if (names.size() <= static_cast<std::size_t>(value)) names.resize(value + 1);
    char* name = check(H5Tget_member_name(type.id(), member));
    names[value] = name;
    check(H5free_memory(name));
  }
  return names;
}

std::string Group::path_of(const std::string& name) const {
  return name_.empty() ? name : name_ + '/' + name;
}

bool Group::has(const std::string& path) const {
  return has_link(*file_, handle_, name_, path);
}

bool Group::has_object(const std::string& path, int type) const {
  if (!has(path)) return false;
  const Check check(*file_, "open", path_of(path));
  const Handle object(check(H5Oopen(handle_.id(), path.c_str(), H5P_DEFAULT)));
  return check(H5Iget_type(object.id())) == type;
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
  const Check check(*file_, "list", name_);
  check(H5Literate(handle_.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names));
  return names;
}

Group Group::group(const std::string& path) const {
  const Check check(*file_, "open group", path_of(path));
  static_cast<void>(has(path));  // refuses links that are not hard; HDF5 says what is missing
  Handle opened(check(H5Gopen2(handle_.id(), path.c_str(), H5P_DEFAULT)));
  return {file_, std::move(opened), path_of(path)};
}

Dataset Group::dataset(const std::string& path) const {
  const Check check(*file_, "open dataset", path_of(path));
  static_cast<void>(has(path));  // refuses links that are not hard; HDF5 says what is missing
  Handle opened(check(H5Dopen2(handle_.id(), path.c_str(), H5P_DEFAULT)));
  require_plain_storage(*file_, opened, path_of(path));
  return {file_, std::move(opened), path_of(path)};
}

Group Group::create_group(const std::string& name) {
  const Check check(*file_, "create group", path_of(name));
  Handle created(
      check(H5Gcreate2(handle_.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)));
  return {file_, std::move(created), path_of(name)};
}

Dataset Group::create(const Check& check, const std::string& name, Id type, const Handle& space,
                      const Handle& properties) {
  Handle created(check(H5Dcreate2(handle_.id(), name.c_str(), type, space.id(), H5P_DEFAULT,
                                  properties.id(), H5P_DEFAULT)));
  return {file_, std::move(created), path_of(name)};
}

namespace {

/// HDF5 has checksums for chunks only, so an array that is not huge is stored as one chunk.
template <class T>
Handle with_checksum(const Check& check, const Shape& shape, Id type = type_names<T>().native) {
  Handle properties(check(H5Pcreate(H5P_DATASET_CREATE)));
  constexpr std::uint64_t largest = std::uint64_t{1} << 30;  // bytes; HDF5 allows 4 GiB
  const std::uint64_t bytes = elements(shape) * sizeof(T);
  if (shape.empty() || bytes == 0) return properties;
  Shape chunk = shape;
  chunk[0] = std::max<std::uint64_t>(1, chunk[0] / (1 + bytes / largest));
  check(H5Pset_chunk(properties.id(), static_cast<int>(chunk.size()), sizes(chunk)));
  check(H5Pset_fletcher32(properties.id()));
  mark_missing<T>(check, properties, type);
  return properties;
}

}  // namespace

template <class T>
Dataset Group::create_array(const std::string& name, const Shape& shape,
                            std::span<const T> values) {
  const Check check(*file_, "create dataset", path_of(name));
  Dataset dataset = create(check, name, type_names<T>().stored, create_space(check, shape),
                           with_checksum<T>(check, shape));
  dataset.write(values);
  return dataset;
}

Dataset Group::create_text(const std::string& name, const std::string& text) {
  const Check check(*file_, "create dataset", path_of(name));
  const Handle type = text_type(check, std::max<std::size_t>(1, text.size()));
  Dataset dataset = create(check, name, type.id(), create_space(check, {}), Handle(H5P_DEFAULT));
  check(H5Dwrite(dataset.handle_.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()));
  return dataset;
}

Dataset Group::create_enumeration(const std::string& name, std::span<const std::string> names,
                                  std::span<const std::int32_t> values) {
  const Check check(*file_, "create dataset", path_of(name));
  const Handle type(check(H5Tenum_create(H5T_NATIVE_INT32)));
  for (std::int32_t value = 0; value < static_cast<std::int32_t>(names.size()); ++value)
    check(H5Tenum_insert(type.id(), names[value].c_str(), &value));
  const Shape shape{values.size()};
  const Handle properties = with_checksum<std::int32_t>(check, shape, type.id());
  // The checksum of zeros is zero. Compression keeps lost bytes, which are read as zeros, from being taken for the
  // first of the names.
  if (!values.empty()) check(H5Pset_deflate(properties.id(), 1));
  Dataset dataset = create(check, name, type.id(), create_space(check, shape), properties);
  check(H5Dwrite(dataset.handle_.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  return dataset;
}

template <class T>
Dataset Group::create_series(const std::string& name, const Shape& frame_shape,
                             std::uint64_t frames_per_chunk) {
  Shape extent{0};
  extent.insert(extent.end(), frame_shape.begin(), frame_shape.end());
  Shape limit = extent, chunk = extent;
  limit[0] = H5S_UNLIMITED;
  chunk[0] = frames_per_chunk;
  if (chunk.size() > 1) chunk[1] = std::min(chunk[1], rows_per_chunk);

  const Check check(*file_, "create dataset", path_of(name));
  const int rank = static_cast<int>(extent.size());
  const Handle space(check(H5Screate_simple(rank, sizes(extent), sizes(limit))));
  const Handle properties(check(H5Pcreate(H5P_DATASET_CREATE)));
  check(H5Pset_chunk(properties.id(), rank, sizes(chunk)));
  check(H5Pset_fletcher32(properties.id()));
  mark_missing<T>(check, properties, type_names<T>().native);
  return create(check, name, type_names<T>().stored, space, properties);
}

void Group::remove(const std::string& name) {
  const Check check(*file_, "remove", path_of(name));
  check(H5Ldelete(handle_.id(), name.c_str(), H5P_DEFAULT));
}

void Group::link(const std::string& name, const std::string& target) {
  const Check check(*file_, "link", path_of(name));
  check(H5Lcreate_hard(handle_.id(), ('/' + target).c_str(), handle_.id(), name.c_str(),
                       H5P_DEFAULT, H5P_DEFAULT));
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
  const Check check(*file_, "open", "the root group");
  return {file_, Handle(check(H5Gopen2(file_->id(), "/", H5P_DEFAULT))), ""};
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

void File::set_path(const std::filesystem::path& path) {
  file_->set_path(path);
}

bool File::is_being_written() const {
  return file_->is_being_written();
}

void File::reopen() {
  file_->reopen();
}

#define VITREL_H5_INSTANTIATE(T)                                                                 \
  template void Object::set_attribute<T>(const std::string&, std::span<const T>);                \
  template T Object::number_attribute<T>(const std::string&) const;                              \
  template std::vector<T> Dataset::read<T>() const;                                              \
  template void Dataset::write<T>(std::span<const T>);                                           \
  template void Dataset::write_frames<T>(std::uint64_t, std::uint64_t, std::span<const T>);      \
  template std::vector<T> Dataset::read_frames<T>(std::uint64_t, std::uint64_t, std::uint64_t)   \
      const;                                                                                     \
  template Dataset Group::create_array<T>(const std::string&, const Shape&, std::span<const T>); \
  template Dataset Group::create_series<T>(const std::string&, const Shape&, std::uint64_t);

VITREL_H5_INSTANTIATE(double)
VITREL_H5_INSTANTIATE(float)
VITREL_H5_INSTANTIATE(std::int16_t)
VITREL_H5_INSTANTIATE(std::int32_t)
VITREL_H5_INSTANTIATE(std::int64_t)
VITREL_H5_INSTANTIATE(std::uint64_t)
VITREL_H5_INSTANTIATE(std::uint8_t)
#undef VITREL_H5_INSTANTIATE

}  // namespace vitrel::h5
