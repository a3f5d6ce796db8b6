#include "core/io/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <boost/crc.hpp>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/io/atomic_file.h"
#include "core/io/h5.h"
#include "core/whole_number.h"

namespace vitrel {
namespace fs = std::filesystem;
namespace {

/// This number is raised whenever the layout changes; a checkpoint serves to continue a run, not to keep data.
constexpr std::int32_t layout = 4;
constexpr std::int32_t layout_without_checksum = 3;  // layout of version 0.1.0, without a checksum

/// This text follows the HDF5 content of the file, which HDF5 ignores. Behind it is the CRC-32 of all bytes up to
/// there.
constexpr std::string_view trailer = "vitrel checkpoint CRC-32";
using Checksum = std::array<char, sizeof(std::uint32_t)>;

/// Returns the checksum of the first `bytes` bytes.
Checksum checksum_of(const fs::path& path, std::uintmax_t bytes) {
  std::ifstream file(path, std::ios::binary);
  boost::crc_32_type crc;
  std::vector<char> block(1 << 20);
  while (bytes > 0) {
    const auto size = std::min<std::uintmax_t>(bytes, block.size());
    if (!file.read(block.data(), static_cast<std::streamsize>(size)))
      throw FileError(path.string() + ": cannot be read");
    crc.process_bytes(block.data(), size);
    bytes -= size;
  }
  return std::bit_cast<Checksum>(static_cast<std::uint32_t>(crc.checksum()));
}

void append(const fs::path& path, std::string_view bytes) {
  std::ofstream file(path, std::ios::binary | std::ios::app);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw FileError(path.string() + ": cannot be written: " + std::strerror(errno));
}

void add_checksum(const fs::path& path) {
  append(path, trailer);
  const Checksum checksum = checksum_of(path, fs::file_size(path));
  append(path, {checksum.data(), checksum.size()});
}

bool has_checksum(const fs::path& path) {
  const std::uintmax_t size = fs::file_size(path), end = trailer.size() + sizeof(Checksum);
  if (size < end) return false;
  std::string last(end, '\0');
  std::ifstream(path, std::ios::binary)
      .seekg(static_cast<std::streamoff>(size - end))
      .read(last.data(), static_cast<std::streamsize>(end));
  const Checksum checksum = checksum_of(path, size - sizeof(Checksum));
  return last == std::string(trailer) + std::string(checksum.data(), checksum.size());
}

fs::path previous_of(const fs::path& path) {
  fs::path previous = path;
  return previous += ".previous";
}

std::vector<std::uint8_t> bytes(const std::string& text) {
  return {text.begin(), text.end()};
}

void write_text(h5::Group& group, const std::string& name, const std::string& text) {
  group.create_array<std::uint8_t>(name, {text.size()}, bytes(text));
}

std::string read_text(const h5::Group& group, const std::string& name) {
  const auto stored = group.dataset(name).read<std::uint8_t>();
  return {stored.begin(), stored.end()};
}

/// Returns the names as one text, each ended by a zero byte.
std::string joined(const auto& names) {
  std::string text;
  for (const std::string& name : names) text += name + '\0';
  return text;
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin < text.size(); begin += names.back().size() + 1)
    names.emplace_back(text.c_str() + begin);
  return names;
}

template <class T>
void write_map(h5::Group& root, const std::string& name, const std::map<std::string, T>& map) {
  std::vector<std::string> names;
  std::vector<T> values;
  for (const auto& [key, value] : map) names.push_back(key), values.push_back(value);
  h5::Group group = root.create_group(name);
  write_text(group, "names", joined(names));
  group.create_array<T>("values", {values.size()}, values);
}

template <class T>
std::map<std::string, T> read_map(const h5::File& file, const std::string& name) {
  const h5::Group group = file.root().group(name);
  const std::vector<std::string> names = split(read_text(group, "names"));
  const std::vector<T> values = group.dataset("values").read<T>();
  if (names.size() != values.size())
    throw FileError(fmt::format("{}: the group {} has {} names, but {} values", file.path(), name,
                                names.size(), values.size()));
  std::map<std::string, T> map;
  for (std::size_t k = 0; k < names.size(); ++k) map[names[k]] = values[k];
  return map;
}

void write_texts(h5::Group& root, const std::map<std::string, std::string>& texts) {
  std::vector<std::string> words;
  for (const auto& [key, text] : texts) words.push_back(key), words.push_back(text);
  write_text(root, "texts", joined(words));
}

std::map<std::string, std::string> read_texts(const h5::Group& root) {
  const std::vector<std::string> words = split(read_text(root, "texts"));
  std::map<std::string, std::string> texts;
  for (std::size_t k = 0; k + 1 < words.size(); k += 2) texts[words[k]] = words[k + 1];
  return texts;
}

void write_series(h5::Group& root, const std::map<std::string, std::vector<double>>& series) {
  std::vector<std::string> names;
  for (const auto& [name, values] : series) names.push_back(name);
  h5::Group group = root.create_group("series");
  write_text(group, "names", joined(names));
  for (std::size_t k = 0; k < names.size(); ++k) {
    const std::vector<double>& values = series.at(names[k]);
    group.create_array<double>(std::to_string(k), {values.size()}, values);
  }
}

std::map<std::string, std::vector<double>> read_series(const h5::Group& root) {
  const h5::Group group = root.group("series");
  const std::vector<std::string> names = split(read_text(group, "names"));
  std::map<std::string, std::vector<double>> series;
  for (std::size_t k = 0; k < names.size(); ++k)
    series[names[k]] = group.dataset(std::to_string(k)).read<double>();
  return series;
}

/// Writes an array of small structures of numbers as a table with one row per particle.
template <class T, class Item>
void write_rows(h5::Group& group, const std::string& name, const std::vector<Item>& items) {
  constexpr std::size_t columns = sizeof(Item) / sizeof(T);
  std::vector<T> values(items.size() * columns);
  if (!items.empty())
    std::memcpy(values.data(), static_cast<const void*>(items.data()), items.size() * sizeof(Item));
  group.create_array<T>(name, {items.size(), columns}, values);
}

template <class T, class Item>
void read_rows(const h5::Group& group, const std::string& name, std::vector<Item>& items) {
  const std::vector<T> values = group.dataset(name).read<T>();
  items.resize(values.size() * sizeof(T) / sizeof(Item));
  if (!items.empty())
    std::memcpy(static_cast<void*>(items.data()), values.data(), items.size() * sizeof(Item));
}

/// Calls visit(type of number, name, items) for every array with one entry per particle.
template <int Dim>
void each_array(auto& configuration, auto visit) {
  visit(double(), "position", configuration.position);
  visit(std::int32_t(), "image", configuration.image);
  if constexpr (Dim == 2)
    visit(double(), "angle", configuration.angle);
  else
    visit(double(), "orientation", configuration.orientation);
  visit(double(), "velocity", configuration.velocity);
  visit(double(), "angular_velocity", configuration.angular_velocity);
  visit(double(), "semiaxes", configuration.shape);
  visit(double(), "mass", configuration.mass);
  visit(std::int32_t(), "species", configuration.species);
}

/// Writes the contacts of soft particles as rows of doubles, which represent all particle numbers exactly.
template <int Dim>
void write_contacts(h5::Group& group, const Configuration<Dim>& configuration) {
  std::vector<std::array<double, 3 + Dim>> releases, close_pairs;
  for (const auto& [particle, partner, time, velocity] : configuration.releases) {
    auto& row = releases.emplace_back();
    row = {static_cast<double>(particle), static_cast<double>(partner), time};
    std::ranges::copy(velocity, row.begin() + 3);
  }
  for (const auto& [pair, distance] : configuration.close_pairs) {
    auto& row = close_pairs.emplace_back();
    row = {static_cast<double>(pair.i), static_cast<double>(pair.j), distance};
    std::ranges::copy(pair.shift, row.begin() + 3);
  }
  write_rows<double>(group, "releases", releases);
  write_rows<double>(group, "close_pairs", close_pairs);
}

/// Returns the whole number that x holds, which must be below `end`. A damaged checkpoint of the layout without a
/// checksum may hold any number.
template <std::integral Integer>
Integer stored_number(const fs::path& path, double x, Integer end) {
  const auto number = whole_number<Integer>(x);
  if (!number || *number >= end)
    throw FileError(path.string() +
                    ": is damaged: it has contacts of particles that are not there");
  return *number;
}

template <int Dim>
void read_contacts(const fs::path& path, const h5::Group& group,
                   Configuration<Dim>& configuration) {
  std::vector<std::array<double, 3 + Dim>> releases, close_pairs;
  read_rows<double>(group, "releases", releases);
  read_rows<double>(group, "close_pairs", close_pairs);
  const auto particle = [&](double x) { return stored_number(path, x, configuration.size()); };
  constexpr auto most_boxes = std::numeric_limits<std::int32_t>::max();
  for (const auto& row : releases)
    configuration.releases.push_back(
        {particle(row[0]), particle(row[1]), row[2], Vec<Dim>(row.data() + 3)});
  for (const auto& row : close_pairs) {
    Shift<Dim> shift;
    for (int k = 0; k < Dim; ++k) shift[k] = stored_number(path, row[3 + k], most_boxes);
    configuration.close_pairs.push_back({{particle(row[0]), particle(row[1]), shift}, row[2]});
  }
}

template <int Dim>
void write_configuration(h5::Group group, const Configuration<Dim>& configuration) {
  const Vec<Dim>& lengths = configuration.box.lengths();
  group.create_array<double>("box", {Dim}, {lengths.data(), Dim});
  group.create_array<double>("time", {}, {&configuration.time, 1});
  each_array<Dim>(configuration, [&](auto number, const char* name, const auto& items) {
    write_rows<decltype(number)>(group, name, items);
  });
  write_text(group, "species_names", joined(configuration.species_names));
  write_contacts(group, configuration);
}

template <int Dim>
Configuration<Dim> read_configuration(const fs::path& path, const h5::Group& group,
                                      const std::vector<double>& lengths) {
  Configuration<Dim> configuration;
  configuration.box = PeriodicBox<Dim>(Vec<Dim>(lengths.data()));
  configuration.time = group.dataset("time").read<double>().at(0);
  each_array<Dim>(configuration, [&](auto number, const char* name, auto& items) {
    read_rows<decltype(number)>(group, name, items);
  });
  configuration.species_names = split(read_text(group, "species_names"));
  read_contacts(path, group, configuration);
  return configuration;
}

std::variant<Configuration2, Configuration3> read_configuration(const fs::path& path,
                                                                const h5::Group& group) {
  const std::vector<double> lengths = group.dataset("box").read<double>();
  if (lengths.size() == 3) return read_configuration<3>(path, group, lengths);
  return read_configuration<2>(path, group, lengths);
}

Checkpoint read_checkpoint(const fs::path& path) {
  const h5::File file = h5::File::open(path, h5::Access::read);
  const h5::Group root = file.root();
  if (!root.has_attribute("checkpoint_layout"))
    throw FileError(path.string() + ": is not a checkpoint of vitrel");
  const auto found = root.number_attribute<std::int32_t>("checkpoint_layout");
  if (found == layout && !has_checksum(path))
    throw FileError(path.string() + ": is damaged: its checksum is missing or wrong");
  if (found != layout && found != layout_without_checksum)
    throw FileError(path.string() +
                    ": was written by another version of vitrel: finish the run with "
                    "that version, or start it again");
  return {read_configuration(path, root.group("configuration")),
          read_map<double>(file, "reals"),
          read_map<std::uint64_t>(file, "counters"),
          read_series(root),
          read_texts(root),
          read_text(root, "parameters")};
}

}  // namespace

void save_checkpoint(const fs::path& path, const Checkpoint& checkpoint) {
  AtomicFile pending(path);
  h5::File file = h5::File::create(pending.partial());
  {
    h5::Group root = file.root();
    root.set_attribute("checkpoint_layout", layout);
    std::visit(
        [&](const auto& configuration) {
          write_configuration(root.create_group("configuration"), configuration);
        },
        checkpoint.configuration);
    write_map(root, "reals", checkpoint.reals);
    write_map(root, "counters", checkpoint.counters);
    write_series(root, checkpoint.series);
    write_texts(root, checkpoint.texts);
    write_text(root, "parameters", checkpoint.parameters);
  }
  file.close();
  add_checksum(pending.partial());
  pending.commit(previous_of(path));
}

LoadedCheckpoint load_checkpoint(const fs::path& path) {
  std::string reason;
  try {
    return {read_checkpoint(path), ""};
  } catch (const FileError& error) {
    reason = error.what();
  }
  const fs::path previous = previous_of(path);
  if (!fs::exists(previous))
    throw FileError(reason + " (and there is no earlier checkpoint " + previous.string() + ")");
  try {
    return {read_checkpoint(previous), reason + "; taking the one before it, " + previous.string()};
  } catch (const FileError& error) {
    throw FileError(reason + "; the one before it is unreadable too: " + error.what());
  }
}

Checkpoint load_previous_checkpoint(const fs::path& path) {
  return read_checkpoint(previous_of(path));
}

bool checkpoint_exists(const fs::path& path) {
  return fs::exists(path) || fs::exists(previous_of(path));
}

void remove_checkpoint(const fs::path& path) {
  for (const fs::path& file : {path, previous_of(path)}) {
    std::error_code error;
    fs::remove(file, error);
    if (error) throw FileError(file.string() + ": cannot be removed: " + error.message());
  }
}

}  // namespace vitrel
