#include "workflow/export/gsd_file.h"

#include <algorithm>
#include <cassert>
#include <type_traits>

namespace vitrel {
namespace {

template <class T>
std::string_view bytes_of(std::span<const T> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

template <class T>
constexpr std::uint8_t type_number() {
  if constexpr (std::is_same_v<T, std::uint8_t>) return 1;
  if constexpr (std::is_same_v<T, std::uint32_t>) return 3;
  if constexpr (std::is_same_v<T, std::uint64_t>) return 4;
  if constexpr (std::is_same_v<T, std::int8_t>) return 5;
  if constexpr (std::is_same_v<T, std::int32_t>) return 7;
  if constexpr (std::is_same_v<T, float>) return 9;
  if constexpr (std::is_same_v<T, double>) return 10;
}

}  // namespace

GsdFile::GsdFile(const std::filesystem::path& path, const std::string& application,
                 const std::string& schema, std::uint32_t schema_version)
    : file_(path) {
  header_.magic = gsd::magic;
  header_.version = 2u << 16;
  header_.schema_version = schema_version;
  application.copy(header_.application.data(), header_.application.size() - 1);
  schema.copy(header_.schema.data(), header_.schema.size() - 1);
  file_.write(bytes_of(std::span<const gsd::Header>(&header_, 1)));  // its place; the rest by close
}

template <class T>
void GsdFile::write(const std::string& name, std::span<const T> values, std::uint32_t columns) {
  const std::uint16_t number = number_of(name);
  assert(index_.empty() || index_.back().frame < frame_ || index_.back().name < number);
  index_.push_back({frame_, values.size() / columns, static_cast<std::int64_t>(file_.size()),
                    columns, number, type_number<T>(), 0});
  file_.write(bytes_of(values));
}

std::uint16_t GsdFile::number_of(const std::string& name) {
  const auto found = std::find(names_.begin(), names_.end(), name);
  const auto number = static_cast<std::uint16_t>(found - names_.begin());
  if (found == names_.end()) names_.push_back(name);
  return number;
}

void GsdFile::write_names() {
  std::string block;
  for (const std::string& name : names_) block += name + '\0';
  // One zero byte more ends the list.
  header_.names_units = block.size() / gsd::names_unit + 1;
  header_.names_location = file_.size();
  block.resize(header_.names_units * gsd::names_unit);
  file_.write(block);
}

void GsdFile::write_index() {
  index_.push_back({});  // ends the list
  header_.index_entries = index_.size();
  header_.index_location = file_.size();
  file_.write(bytes_of(std::span<const gsd::Entry>(index_)));
}

void GsdFile::close() {
  write_names();
  write_index();
  file_.write_at_start(bytes_of(std::span<const gsd::Header>(&header_, 1)));
  file_.close();
}

template void GsdFile::write(const std::string&, std::span<const std::uint8_t>, std::uint32_t);
template void GsdFile::write(const std::string&, std::span<const std::uint32_t>, std::uint32_t);
template void GsdFile::write(const std::string&, std::span<const std::uint64_t>, std::uint32_t);
template void GsdFile::write(const std::string&, std::span<const std::int8_t>, std::uint32_t);
template void GsdFile::write(const std::string&, std::span<const std::int32_t>, std::uint32_t);
template void GsdFile::write(const std::string&, std::span<const float>, std::uint32_t);
template void GsdFile::write(const std::string&, std::span<const double>, std::uint32_t);

}  // namespace vitrel
