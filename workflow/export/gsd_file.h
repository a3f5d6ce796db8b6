#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/io/foreign/gsd_layout.h"
#include "workflow/export/frame_sink.h"

namespace vitrel {

/// Writes a file of GSD, the general simulation data of HOOMD-blue, file layer 2.0
/// (https://gsd.readthedocs.io/en/stable/file-layer.html): frames of named arrays, "chunks".
///
///     header    256 bytes: what the file is, and where the two blocks below lie
///     chunks    the bare numbers, row by row, one after the other
///     names     of the chunks, each ended by a zero byte, in units of 64 bytes
///     index     32 bytes per chunk, by frame and then by name: place, shape and type
///
/// Names and index come last, so that nothing needs to be known beforehand; memory grows by an
/// index entry per chunk.
class GsdFile {
 public:
  /// The version of the schema is major · 2¹⁶ + minor.
  GsdFile(const std::filesystem::path& path, const std::string& application,
          const std::string& schema, std::uint32_t schema_version);

  /// Adds an array of `columns` numbers per row to the frame; T is one of uint8_t, uint32_t,
  /// uint64_t, int8_t, int32_t, float, double. Every frame writes its names in the same order, each at
  /// most once; some may be left out.
  template <class T>
  void write(const std::string& name, std::span<const T> values, std::uint32_t columns = 1);
  void end_frame() { ++frame_; }
  void close();

 private:
  std::uint16_t number_of(const std::string& name);
  void write_names();
  void write_index();

  OutputFile file_;
  gsd::Header header_{};
  std::vector<std::string> names_;
  std::vector<gsd::Entry> index_;
  std::uint64_t frame_ = 0;
};

}  // namespace vitrel
