#include "workflow/export/frame_sink.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace vitrel {

OutputFile::OutputFile(const std::filesystem::path& path)
    : path_(path), stream_(path, std::ios::binary) {
  check();
}

void OutputFile::write(std::string_view bytes) {
  stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  size_ += bytes.size();
  check();
}

void OutputFile::write_at_start(std::string_view bytes) {
  stream_.seekp(0);
  stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  check();
}

void OutputFile::close() {
  stream_.close();
  check();
}

void OutputFile::check() {
  if (!stream_)
    throw FileError(fmt::format("{}: cannot be written: {}", path_.string(), std::strerror(errno)));
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.close();
}

}  // namespace vitrel
