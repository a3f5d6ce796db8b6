#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "core/state/configuration.h"

namespace vitrel {

/// A frame with its place in the trajectory.
template <int Dim>
struct StoredFrame {
  std::uint64_t index;  ///< counted from 0
  std::int64_t step;
  const Configuration<Dim>& configuration;
};

/// What the exported file stores besides positions and orientations.
struct StoredMotion {
  bool velocities = false;
  bool angular_velocities = false;
};

/// A file of another format to which frames are written one after the other. The file is complete only after `close`.
/// Throws FileError.
template <int Dim>
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  virtual void write(const StoredFrame<Dim>& frame) = 0;
  virtual void close() = 0;
};

/// A file that is written from start to end. Every failure throws FileError.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& path);
  void write(std::string_view bytes);
  /// Overwrites the beginning of the file.
  void write_at_start(std::string_view bytes);
  void close();
  std::uint64_t size() const { return size_; }

 private:
  void check();

  std::filesystem::path path_;
  std::ofstream stream_;
  std::uint64_t size_ = 0;
};

/// Writes a file that consists of one text. Throws FileError.
void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace vitrel
