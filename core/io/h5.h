#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/error.h"

/// @file
/// A thin, owning layer over the HDF5 C library: files, groups, datasets and attributes that close
/// themselves. HDF5's own messages are silenced; every failure becomes one FileError that names the
/// file, the operation and the reason the operating system gave.
///
/// `flush` brings what was written into the file, whole or not at all (see TransactionalFile): a killed process or a
/// full disk leaves the file as it was at the last flush. After a failure nothing more is written, and later operations
/// on that file throw again. A file may be read while another process writes it: every operation sees the content of
/// the same commit, or throws ChangedFile.
///
/// T is one of double, float, int16_t, int32_t, int64_t, uint64_t, uint8_t. Numbers are stored little-endian and
/// converted to the type of the array.
namespace vitrel::h5 {

using Id = std::int64_t;
using Shape = std::vector<std::uint64_t>;

class OpenFile;
class Check;

/// Thrown if another process has changed the file since it was opened; File::reopen continues with its present content.
class ChangedFile : public FileError {
 public:
  using FileError::FileError;
};

/// An HDF5 identifier that closes itself.
class Handle {
 public:
  explicit Handle(Id id = -1) : id_(id) {}
  ~Handle();
  Handle(Handle&& other) noexcept : id_(other.id_) { other.id_ = -1; }
  Handle& operator=(Handle&& other) noexcept;
  Id id() const { return id_; }

 private:
  Id id_;
};

/// An HDF5 object that belongs to an open file; the file stays open as long as one of them lives.
class Object {
 public:
  /// The path of the object inside the file, for messages: "particles/all/box".
  const std::string& name() const { return name_; }

  bool has_attribute(const std::string& name) const;
  void set_attribute(const std::string& name, const std::string& text);
  /// Stores strings of `width` bytes each, padded with zeros.
  void set_attribute(const std::string& name, std::span<const std::string> texts,
                     std::size_t width);
  template <class T>
  void set_attribute(const std::string& name, std::span<const T> values);
  template <class T>
  void set_attribute(const std::string& name, T value) {
    set_attribute(name, std::span<const T>(&value, 1));
  }
  std::string text_attribute(const std::string& name) const;
  /// Reads one string, or an array of several.
  std::vector<std::string> texts_attribute(const std::string& name) const;
  template <class T>
  T number_attribute(const std::string& name) const;

 protected:
  Object(std::shared_ptr<OpenFile> file, Handle handle, std::string name);

  std::shared_ptr<OpenFile> file_;  // before handle_, so that the object closes first
  Handle handle_;
  std::string name_;

 private:
  void write_attribute(const std::string& name, Id stored, Id memory, std::size_t count,
                       const void* data);
};

/// An array of numbers or strings. A series is an array that grows along its first direction, one entry ("frame") at a
/// time.
class Dataset : public Object {
 public:
  /// The shape is empty for a scalar.
  Shape shape() const;

  /// Reads the whole array, last direction fastest; numbers are converted to T.
  template <class T>
  std::vector<T> read() const;
  /// Replaces the whole array, whose number of elements must be that of `values`.
  template <class T>
  void write(std::span<const T> values);
  std::string read_text() const;

  /// Cuts or extends a series to `frames` frames; new frames count as missing until they are written.
  void resize(std::uint64_t frames);
  /// Writes or reads `count` frames of the series from `first` on. `values` must have their size, and frames that are
  /// read must have `numbers` numbers each. Access to whole chunks is fastest.
  template <class T>
  void write_frames(std::uint64_t first, std::uint64_t count, std::span<const T> values);
  template <class T>
  std::vector<T> read_frames(std::uint64_t first, std::uint64_t count, std::uint64_t numbers) const;
  /// Returns the number of frames per chunk of a series; 1 for an array that is not stored in chunks.
  std::uint64_t frames_per_chunk() const;
  /// The size of a number in the file.
  std::size_t bytes_per_number() const;

  /// Returns the names of an enumerated type indexed by value 0, 1, 2 …; empty if the array holds plain numbers. Values
  /// without a name get an empty one.
  std::vector<std::string> enumeration() const;

 private:
  friend class Group;
  Dataset(std::shared_ptr<OpenFile> file, Handle handle, std::string name)
      : Object(std::move(file), std::move(handle), std::move(name)) {}
  struct FrameSpaces {
    Handle file, memory;
  };
  FrameSpaces frame_spaces(std::uint64_t first, std::uint64_t count, std::uint64_t values) const;
};

/// A chunk holds no more particles than this, so that little is read in vain when a few particles are followed through
/// all frames.
inline constexpr std::uint64_t rows_per_chunk = 1024;

class Group : public Object {
 public:
  /// `path` may lead through several groups, separated by "/".
  bool has(const std::string& path) const;
  bool has_group(const std::string& path) const;
  bool has_dataset(const std::string& path) const;
  /// Returns the names of all members in alphabetical order.
  std::vector<std::string> members() const;

  Group group(const std::string& path) const;
  Dataset dataset(const std::string& path) const;

  Group create_group(const std::string& name);
  /// Creates an array of fixed size with a checksum; an empty `shape` means a scalar, without a checksum.
  template <class T>
  Dataset create_array(const std::string& name, const Shape& shape, std::span<const T> values);
  Dataset create_text(const std::string& name, const std::string& text);
  /// Creates an array of names out of `names`, stored as the index into `names`.
  Dataset create_enumeration(const std::string& name, std::span<const std::string> names,
                             std::span<const std::int32_t> values);
  /// Creates a series without frames. A chunk holds `frames_per_chunk` frames and, along the first direction of a
  /// frame, up to rows_per_chunk entries. Chunks have checksums, and keep their size and place, so that adding a frame
  /// never moves the earlier ones.
  template <class T>
  Dataset create_series(const std::string& name, const Shape& frame_shape,
                        std::uint64_t frames_per_chunk);
  void remove(const std::string& name);
  /// Creates a second name for a member of the file; `target` is its path from the root.
  void link(const std::string& name, const std::string& target);

 private:
  friend class File;
  Group(std::shared_ptr<OpenFile> file, Handle handle, std::string name)
      : Object(std::move(file), std::move(handle), std::move(name)) {}
  std::string path_of(const std::string& name) const;
  bool has_object(const std::string& path, int type) const;
  Dataset create(const Check& check, const std::string& name, Id type, const Handle& space,
                 const Handle& properties);
};

enum class Access { read, write };

/// A reading that another process disturbs by changing the file is tried this often. The commits of a writer are much
/// farther apart than one reading takes.
inline constexpr int max_readings = 50;

class File {
 public:
  /// Creates an empty file, which replaces a file of the same name.
  static File create(const std::filesystem::path& path);
  /// Opens an existing file. Throws FileError if it is missing, truncated, no HDF5 file, or in use.
  static File open(const std::filesystem::path& path, Access access);

  /// The path as it was given, for messages.
  const std::string& path() const;
  /// Tells the object that the open file was renamed.
  void set_path(const std::filesystem::path& path);
  Group root() const;
  /// Saves everything written so far, so that it survives a kill of the process but not a loss of power.
  void flush();
  /// Flushes and waits for the disk.
  void synchronize();
  /// Flushes, waits for the disk and closes the file. Without this call the destructor saves and closes, but cannot
  /// report a failure.
  void close();

  /// Whether another process had the file open for writing when it was opened here.
  bool is_being_written() const;
  /// Continues with the present content of a file that is open for reading. Objects opened before are of no use any
  /// more.
  void reopen();

 private:
  explicit File(std::shared_ptr<OpenFile> file) : file_(std::move(file)) {}
  std::shared_ptr<OpenFile> file_;
};

/// Returns the result of `read`, which sees the content of one commit. If another process changes the file meanwhile,
/// `forget` must release the open objects, and `read` begins again. Throws ChangedFile after max_readings.
template <class Read, class Forget>
std::invoke_result_t<Read> read_consistently(File& file, Read&& read, Forget&& forget) {
  for (int reading = 1;; ++reading) try {
      return read();
    } catch (const ChangedFile&) {
      if (reading == max_readings) throw;
      forget();
      file.reopen();
    }
}

}  // namespace vitrel::h5
