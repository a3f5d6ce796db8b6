#include "tests/fuzz/mutations.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/error.h"
#include "core/io/h5.h"
#include "core/random/stream.h"

namespace vitrel::fuzz {
namespace {

template <class Range>
const auto& any_of(const Range& range, Stream& stream) {
  return *(std::begin(range) + static_cast<std::ptrdiff_t>(stream.below(std::size(range))));
}

/// A part of the text, mostly short.
struct Part {
  std::size_t begin, length;
};
Part any_part(const std::string& text, Stream& stream) {
  const std::size_t begin = stream.below(text.size() + 1);
  const std::size_t longest = stream.below(4) == 0 ? text.size() : 16;
  return {begin, std::min(text.size() - begin, stream.below(longest + 1))};
}

std::string copy_of(const std::string& text, const Part& part) {
  return text.substr(part.begin, part.length);
}

void flip_bit(std::string& text, Stream& stream) {
  if (text.empty()) return;
  char& byte = text[stream.below(text.size())];
  byte = static_cast<char>(byte ^ (1 << stream.below(8)));
}

void overwrite(std::string& text, Stream& stream) {
  constexpr std::array<std::uint64_t, 8> extremes = {0,
                                                     1,
                                                     0x7f,
                                                     0x80,
                                                     0x7fff'ffff,
                                                     0xffff'ffff,
                                                     0x7fff'ffff'ffff'ffff,
                                                     std::numeric_limits<std::uint64_t>::max()};
  const std::uint64_t value = any_of(extremes, stream);
  const std::size_t width = std::size_t{1} << stream.below(4),
                    begin = stream.below(text.size() + 1);
  for (std::size_t k = 0; k < width && begin + k < text.size(); ++k)
    text[begin + k] = static_cast<char>(value >> 8 * k);
}

void remove_part(std::string& text, Stream& stream) {
  const Part part = any_part(text, stream);
  text.erase(part.begin, part.length);
}

void repeat_part(std::string& text, Stream& stream) {
  const std::string part = copy_of(text, any_part(text, stream));
  const std::size_t times = 1 + stream.below(3), at = stream.below(text.size() + 1);
  for (std::size_t k = 0; k < times; ++k) text.insert(at, part);
}

void cut_off(std::string& text, Stream& stream) {
  text.resize(stream.below(text.size() + 1));
}

void splice(std::string& text, std::span<const std::string> others, Stream& stream) {
  const std::string& other = any_of(others, stream);
  const std::size_t at = stream.below(text.size() + 1);
  text.insert(at, copy_of(other, any_part(other, stream)));
}

constexpr const char* extreme_numbers[] = {
    "0",    "-1",    "1e-300", "1e300", "-1e300", "nan",  "inf",   "-inf",         "1e999",
    "1e-9", "1e9",   "0x10",   "1_0",   "+5",     ".5",   "5.",    "2147483648",   "1e18",
    "-0",   "1e-12", "3",      "0.5",   "1000",   "\"\"", "false", "[1, 2]",       "{}",
    "''",   "7",     "1,5",    "1 2",   "2",      "1e3",  "99999", "4294967296000"};
constexpr std::string_view number_characters = "0123456789.+-eE";

void replace_number(std::string& text, Stream& stream) {
  std::size_t begin = text.find_first_of("0123456789", stream.below(text.size() + 1));
  if (begin == std::string::npos) return;
  while (begin > 0 && number_characters.find(text[begin - 1]) != std::string::npos) --begin;
  const std::size_t end = std::min(text.find_first_not_of(number_characters, begin), text.size());
  text.replace(begin, end - begin, any_of(extreme_numbers, stream));
}

Part any_line(const std::string& text, Stream& stream) {
  const std::size_t inside = stream.below(text.size() + 1);
  const std::size_t before = inside > 0 ? text.rfind('\n', inside - 1) : std::string::npos;
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  const std::size_t end = std::min(text.find('\n', inside), text.size());
  return {begin, std::min(end + 1, text.size()) - begin};
}

void remove_line(std::string& text, Stream& stream) {
  const Part line = any_line(text, stream);
  text.erase(line.begin, line.length);
}

void move_line(std::string& text, std::span<const std::string> others, Stream& stream) {
  const std::string& from = stream.below(2) ? text : any_of(others, stream);
  const std::string line = copy_of(from, any_line(from, stream));
  text.insert(any_line(text, stream).begin, line);
}

/// Few changes leave more of the file to be read.
std::size_t number_of_changes(Stream& stream) {
  const std::uint64_t most = 1 + stream.below(6);
  return 1 + stream.below(most);
}

void damage_bytes(std::string& text, std::span<const std::string> others, Stream& stream) {
  switch (stream.below(8)) {
    case 0:
      return remove_part(text, stream);
    case 1:
      return repeat_part(text, stream);
    case 2:
      return splice(text, others, stream);
    case 3:
      return stream.below(4) ? overwrite(text, stream) : cut_off(text, stream);
    case 4:
    case 5:
      return overwrite(text, stream);
    default:
      return flip_bit(text, stream);
  }
}

void damage_line(std::string& text, std::span<const std::string> others, Stream& stream) {
  switch (stream.below(8)) {
    case 0:
      return damage_bytes(text, others, stream);
    case 1:
      return remove_line(text, stream);
    case 2:
      return move_line(text, others, stream);
    default:
      return replace_number(text, stream);
  }
}

using Path = std::string;

void collect(const h5::Group& group, const Path& path, std::vector<Path>& members) {
  for (const std::string& name : group.members()) {
    members.push_back(path + name);
    if (group.has_group(name)) collect(group.group(name), path + name + "/", members);
  }
}

h5::Group parent_of(const h5::File& file, const Path& path) {
  const std::size_t slash = path.rfind('/');
  return slash == Path::npos ? file.root() : file.root().group(path.substr(0, slash));
}

Path name_of(const Path& path) {
  return path.substr(path.rfind('/') + 1);
}

constexpr double extreme_values[] = {0,
                                     -1,
                                     1,
                                     2,
                                     0.5,
                                     1e-300,
                                     1e300,
                                     1e9,
                                     -1e18,
                                     2147483648.,
                                     std::numeric_limits<double>::quiet_NaN(),
                                     std::numeric_limits<double>::infinity()};

template <class T>
void create(h5::Group& group, const std::string& name, const h5::Shape& shape,
            const std::vector<double>& values) {
  std::vector<T> converted;
  for (const double value : values) {
    constexpr auto limit = static_cast<double>(std::numeric_limits<T>::max() / 2);
    converted.push_back(std::is_floating_point_v<T>
                            ? static_cast<T>(value)
                            : static_cast<T>(value >= 0 && value < limit ? value : limit));
  }
  group.create_array<T>(name, shape, converted);
}

void replace_values(h5::Group& group, const std::string& name, Stream& stream) {
  const h5::Dataset dataset = group.dataset(name);
  h5::Shape shape = dataset.shape();
  std::vector<double> values = dataset.read<double>();
  if (!values.empty()) values[stream.below(values.size())] = any_of(extreme_values, stream);
  if (stream.below(3) == 0) {
    values.resize(stream.below(2 * values.size() + 2));
    shape = {values.size()};
  } else if (shape.empty()) {
    values.resize(1);
  } else {
    std::uint64_t count = 1;
    for (const std::uint64_t extent : shape) count *= extent;
    if (count != values.size()) shape = {values.size()};
  }
  group.remove(name);
  if (stream.below(3))
    create<double>(group, name, shape, values);
  else
    create<std::int32_t>(group, name, shape, values);
}

void damage_object(const h5::File& file, const Path& path, Stream& stream) {
  h5::Group group = parent_of(file, path);
  const std::string name = name_of(path);
  const std::uint64_t choice = stream.below(10);
  if (choice < 6 && group.has_dataset(name)) return replace_values(group, name, stream);
  group.remove(name);
  if (choice == 6) group.create_group(name);
  if (choice == 7) group.create_text(name, any_of(extreme_numbers, stream));
  if (choice == 8) group.create_array<double>(name, {0}, {});
}

}  // namespace

std::string damaged_bytes(const std::string& original, std::span<const std::string> others,
                          Stream& stream) {
  std::string text = original;
  for (std::size_t k = number_of_changes(stream); k > 0; --k) damage_bytes(text, others, stream);
  return text;
}

std::string damaged_text(const std::string& original, std::span<const std::string> others,
                         Stream& stream) {
  std::string text = original;
  for (std::size_t k = number_of_changes(stream); k > 0; --k) damage_line(text, others, stream);
  return text;
}

bool damage_hdf5(const std::filesystem::path& path, Stream& stream) try {
  h5::File file = h5::File::open(path, h5::Access::write);
  for (std::size_t k = number_of_changes(stream); k > 0; --k) {
    std::vector<Path> members;
    collect(file.root(), "", members);
    if (members.empty()) break;
    const Path& member = any_of(members, stream);
    damage_object(file, member, stream);
  }
  file.close();
  return true;
} catch (const FileError&) {
  return false;
}

}  // namespace vitrel::fuzz
