#include "core/io/foreign/foreign_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/error.h"
#include "core/io/text_file.h"

namespace vitrel {
namespace {

constexpr std::array formats = {&h5md_format,        &gsd_format,         &xyz_format,
                                &lammps_dump_format, &lammps_data_format, &csv_format};

/// Returns the first bytes of the file.
std::string start_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    throw FileError(
        fmt::format("{}: cannot open the file: {}", path.string(), std::strerror(errno)));
  std::string start(4096, '\0');
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(stream.gcount()));
  if (start.empty() && std::filesystem::is_regular_file(path))
    throw FileError(path.string() + ": is empty");
  return start;
}

[[noreturn]] void throw_no_format(const std::filesystem::path& path, std::string_view start) {
  const bool is_text = start.find('\0') == std::string_view::npos;
  constexpr std::size_t shown = 60;
  const std::string_view line = start.substr(0, std::min(start.find_first_of("\r\n"), shown));
  throw FileError(fmt::format("{}: is not recognised as {}: {}; import.format can name the format",
                              path.string(), foreign_format_names(),
                              is_text ? fmt::format("it begins with \"{}\"", line)
                                      : "it is binary, and none of these begins so"));
}

}  // namespace

std::span<const ForeignFormat* const> foreign_formats() {
  return formats;
}

std::string foreign_format_names() {
  std::string names;
  for (std::size_t k = 0; k < formats.size(); ++k)
    names += std::string(k == 0 ? "" : k + 1 == formats.size() ? " or " : ", ") + formats[k]->name;
  return names;
}

const ForeignFormat& format_of(const std::filesystem::path& path, const ImportOptions& options) {
  require_regular_file(path);
  if (options.format) {
    const auto named = std::ranges::find(formats, *options.format, &ForeignFormat::name);
    if (named == formats.end())
      throw UserError(fmt::format("import.format is \"{}\", but should be {}", *options.format,
                                  foreign_format_names()));
    return **named;
  }
  const std::string start = start_of(path);
  const auto found = std::ranges::find_if(
      formats, [&](const ForeignFormat* format) { return format->recognises(start); });
  if (found == formats.end()) throw_no_format(path, start);
  return **found;
}

}  // namespace vitrel
