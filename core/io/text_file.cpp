#include "core/io/text_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.h"
#include "core/io/atomic_file.h"
#include "core/io/json.h"

namespace vitrel {

std::string read_text(const std::filesystem::path& path) {
  require_regular_file(path);
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file && file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
  if (!file.is_open() || file.bad())
    throw FileError(fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno)));
  return text.str();
}

void write_text(const std::filesystem::path& path, std::string_view text) {
  AtomicFile pending(path);
  errno = 0;
  std::ofstream file(pending.partial(), std::ios::binary);
  file << text;
  file.close();
  if (!file)
    throw FileError(fmt::format("{}: cannot be written: {}", path.string(), std::strerror(errno)));
  pending.commit();
}

Json read_json(const std::filesystem::path& path) {
  return parse_json(read_text(path), path.string());
}

void read_json_as(const std::string& what, const std::filesystem::path& file,
                  const std::function<void(const Json&)>& read) {
  const Json json = read_json(file);
  try {
    read(json);
  } catch (const Json::exception&) {
    throw FileError(
        fmt::format("{}: is JSON, but not {}, as vitrel writes it", file.string(), what));
  }
}

void require_regular_file(const std::filesystem::path& file) {
  std::error_code none;
  const auto kind = std::filesystem::status(file, none).type();
  using Type = std::filesystem::file_type;
  if (kind == Type::fifo || kind == Type::character || kind == Type::block || kind == Type::socket)
    throw FileError(file.string() + ": is not a regular file");
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw FileError(
        fmt::format("{}: the folder cannot be made: {}", folder.string(), error.message()));
}

}  // namespace vitrel
