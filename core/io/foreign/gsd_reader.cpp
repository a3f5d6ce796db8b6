#include "core/io/foreign/gsd_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace vitrel {
namespace {

/// Bytes of a number of this type; 0 if there is no such type.
std::uint64_t width_of(std::uint8_t type) {
  constexpr std::array<std::uint64_t, 11> widths = {0, 1, 2, 4, 8, 1, 2, 4, 8, 4, 8};
  return type < widths.size() ? widths[type] : type == 11 ? 1 : 0;
}

template <class T>
void append_as(std::vector<double>& values, const std::vector<std::byte>& bytes) {
  for (std::size_t k = 0; k < bytes.size(); k += sizeof(T)) {
    T number;
    std::memcpy(&number, &bytes[k], sizeof(T));
    values.push_back(static_cast<double>(number));
  }
}

std::vector<double> numbers(std::uint8_t type, const std::vector<std::byte>& bytes) {
  std::vector<double> values;
  if (type == 1 || type == 11) append_as<std::uint8_t>(values, bytes);
  if (type == 2) append_as<std::uint16_t>(values, bytes);
  if (type == 3) append_as<std::uint32_t>(values, bytes);
  if (type == 4) append_as<std::uint64_t>(values, bytes);
  if (type == 5) append_as<std::int8_t>(values, bytes);
  if (type == 6) append_as<std::int16_t>(values, bytes);
  if (type == 7) append_as<std::int32_t>(values, bytes);
  if (type == 8) append_as<std::int64_t>(values, bytes);
  if (type == 9) append_as<float>(values, bytes);
  if (type == 10) append_as<double>(values, bytes);
  return values;
}

/// The text before the first zero byte.
std::string text_of(const char* bytes, std::size_t most) {
  return {bytes, std::find(bytes, bytes + most, '\0')};
}

}  // namespace

GsdReader::GsdReader(const std::filesystem::path& path)
    : path_(path.string()), stream_(path, std::ios::binary | std::ios::ate) {
  if (!stream_)
    throw FileError(fmt::format("{}: cannot open the file: {}", path_, std::strerror(errno)));
  size_ = static_cast<std::uint64_t>(stream_.tellg());
  gsd::Header header;
  read_bytes(0, sizeof(header), &header);
  if (header.magic != gsd::magic) fail("is no GSD file");
  const std::uint32_t layer = header.version >> 16;
  if (layer != 1 && layer != 2)
    fail(fmt::format("has the file layer {}, but 1 and 2 can be read", layer));
  schema_ = text_of(header.schema.data(), header.schema.size());
  if (header.names_units > size_ / gsd::names_unit)
    fail("is damaged: its names do not fit into it");
  read_names(header.names_location, header.names_units * gsd::names_unit, layer == 1);
  read_index(header.index_location, header.index_entries);
}

void GsdReader::fail(const std::string& what) const {
  throw FileError(path_ + ": " + what);
}

void GsdReader::read_bytes(std::uint64_t offset, std::uint64_t count, void* out) {
  if (count > size_ || offset > size_ - count) fail("is truncated or damaged");
  if (count == 0) return;
  stream_.seekg(static_cast<std::streamoff>(offset));
  stream_.read(static_cast<char*>(out), static_cast<std::streamsize>(count));
  if (!stream_) fail("cannot be read");
}

/// Each in a place of its own, or one behind the other, up to an empty one.
void GsdReader::read_names(std::uint64_t location, std::uint64_t bytes, bool fixed_width) {
  std::string block(bytes, '\0');
  read_bytes(location, bytes, block.data());
  for (std::size_t k = 0; k < block.size();) {
    const std::string name =
        text_of(&block[k], fixed_width ? std::size_t{gsd::names_unit} : block.size() - k);
    if (name.empty()) break;
    names_.push_back(name);
    k += fixed_width ? gsd::names_unit : name.size() + 1;
  }
}

/// Up to an entry without a place.
void GsdReader::read_index(std::uint64_t location, std::uint64_t entries) {
  if (entries > size_ / sizeof(gsd::Entry)) fail("is damaged: its index does not fit into it");
  std::vector<gsd::Entry> index(entries);
  read_bytes(location, entries * sizeof(gsd::Entry), index.data());
  for (const gsd::Entry& entry : index) {
    if (entry.location == 0) break;
    if (entry.name >= names_.size() || entry.frame > entries)
      fail("is damaged: its index has an impossible entry");
    frames_ = std::max(frames_, entry.frame + 1);
    index_[{names_[entry.name], entry.frame}] = entry;
  }
}

const gsd::Entry* GsdReader::find(const std::string& name, std::uint64_t frame) const {
  for (const std::uint64_t place : {frame, std::uint64_t{0}})
    if (const auto found = index_.find({name, place}); found != index_.end()) return &found->second;
  return nullptr;
}

bool GsdReader::is_in_later_frames(const std::string& name) const {
  const auto after_first = index_.upper_bound({name, 0});
  return after_first != index_.end() && after_first->first.first == name;
}

std::vector<std::byte> GsdReader::bytes_of(const gsd::Entry& entry) {
  const std::uint64_t width = width_of(entry.type);
  const bool is_impossible = width == 0 || entry.columns == 0 || entry.location < 0 ||
                             entry.rows > size_ / width / entry.columns;
  if (is_impossible) fail(fmt::format("frame {}, {}: is damaged", entry.frame, names_[entry.name]));
  std::vector<std::byte> bytes(entry.rows * entry.columns * width);
  read_bytes(static_cast<std::uint64_t>(entry.location), bytes.size(), bytes.data());
  return bytes;
}

GsdReader::Chunk GsdReader::read(const std::string& name, std::uint64_t frame) {
  const gsd::Entry* entry = find(name, frame);
  if (!entry) return {};
  return {entry->rows, entry->columns, numbers(entry->type, bytes_of(*entry))};
}

std::vector<std::string> GsdReader::read_texts(const std::string& name, std::uint64_t frame) {
  const gsd::Entry* entry = find(name, frame);
  if (!entry) return {};
  const std::vector<std::byte> bytes = bytes_of(*entry);
  const std::size_t width = entry->columns * width_of(entry->type);
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < bytes.size(); k += width)
    texts.push_back(text_of(reinterpret_cast<const char*>(&bytes[k]), width));
  return texts;
}

}  // namespace vitrel
