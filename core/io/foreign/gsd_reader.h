#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "core/io/foreign/gsd_layout.h"

namespace vitrel {

/// Reads the named arrays ("chunks") of a GSD file, file layers 1 and 2, of any schema. FileError, also for sizes and
/// places that do not fit into the file.
class GsdReader {
 public:
  explicit GsdReader(const std::filesystem::path& path);

  std::uint64_t frames() const { return frames_; }
  const std::string& schema() const { return schema_; }
  const std::string& path() const { return path_; }

  struct Chunk {
    std::uint64_t rows = 0;
    std::uint32_t columns = 0;
    std::vector<double> values;  ///< row by row
  };
  /// The chunk of the frame, or else of the first; without rows if neither has it.
  Chunk read(const std::string& name, std::uint64_t frame);
  /// Whether a frame after the first has the chunk.
  bool is_in_later_frames(const std::string& name) const;
  /// Whether any has.
  bool has(const std::string& name) const { return find(name, 0) || is_in_later_frames(name); }
  /// The names of all chunks.
  const std::vector<std::string>& names() const { return names_; }
  /// The rows of a chunk of texts.
  std::vector<std::string> read_texts(const std::string& name, std::uint64_t frame);

  [[noreturn]] void fail(const std::string& what) const;

 private:
  void read_bytes(std::uint64_t offset, std::uint64_t count, void* out);
  void read_names(std::uint64_t location, std::uint64_t bytes, bool fixed_width);
  void read_index(std::uint64_t location, std::uint64_t entries);
  const gsd::Entry* find(const std::string& name, std::uint64_t frame) const;
  std::vector<std::byte> bytes_of(const gsd::Entry& entry);

  std::string path_;
  std::ifstream stream_;
  std::uint64_t size_ = 0, frames_ = 0;
  std::string schema_;
  std::vector<std::string> names_;
  std::map<std::pair<std::string, std::uint64_t>, gsd::Entry> index_;
};

}  // namespace vitrel
