#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/io/h5.h"
#include "core/io/transactional_file.h"

/// @file
/// The parts that the objects of h5.h share: the open file, and one way to report a failure.
namespace vitrel::h5 {

/// Silences the messages of HDF5 in this thread: HDF5 keeps one error handler per thread.
void silence_hdf5();

/// Throws FileError with the message "path: cannot action object: reason".
[[noreturn]] void throw_file_error(const std::string& path, std::string_view action,
                                   std::string_view object, const std::string& reason);

/// Returns whether the result of an HDF5 function means failure: a number below 0, a size of 0 or a null pointer.
template <class Result>
bool is_failure(Result result) {
  if constexpr (std::is_pointer_v<Result> || std::is_unsigned_v<Result>)
    return !result;
  else
    return result < 0;
}

/// The file identifier, shared by all objects of the file.
class OpenFile {
 public:
  OpenFile(const std::filesystem::path& path, TransactionalFile::Mode mode);
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile();

  Id id() const { return id_; }
  const std::string& path() const { return path_; }
  void set_path(const std::filesystem::path& path);

  /// Throws FileError with `reason`, or the earlier error after which nothing was written any more.
  [[noreturn]] void fail(std::string_view action, std::string_view object,
                         const std::string& reason);

  bool is_being_written() const { return content_ && content_->is_being_written(); }
  /// Closes all objects of a file that is open for reading, and continues with its present content.
  void reopen();
  void flush();
  void synchronize();
  void close();

 private:
  friend class Check;
  Handle access();
  void create();
  void open();
  void prepare(std::string_view action, std::string_view object) const;
  /// Throws FileError with the reason that HDF5 gives.
  [[noreturn]] void fail(std::string_view action, std::string_view object);

  std::string path_;
  std::optional<TransactionalFile> content_;  ///< none after `close`
  Id id_ = -1;
};

/// An operation on the file. Every result of HDF5 in it passes through this object, which throws FileError if something
/// failed.
class Check {
 public:
  /// Throws FileError if the file is closed, or something failed before. `action` must outlive the operation.
  Check(OpenFile& file, std::string_view action, std::string object)
      : file_(file), action_(action), object_(std::move(object)) {
    file.prepare(action_, object_);
  }

  template <class Result>
  Result operator()(Result result) const {
    if (is_failure(result)) file_.fail(action_, object_);
    return result;
  }
  /// Throws FileError with this reason: the content of the file is of no use.
  [[noreturn]] void refuse(const std::string& reason) const {
    throw_file_error(file_.path(), action_, object_, reason);
  }

 private:
  OpenFile& file_;
  std::string_view action_;
  std::string object_;
};

// The following functions limit how HDF5 files may store what vitrel reads. HDF5 itself would follow links from a file
// to other files, and back into the file.

/// Returns whether `path` exists below the group. Every part of it must be a hard link. Throws FileError if one is
/// soft, or leads to another file. `name` is the name of the group in messages.
bool has_link(OpenFile& file, const Handle& group, const std::string& name,
              const std::string& path);

/// Returns the shape of a dataset, which is empty for a scalar.
Shape shape_of(const Check& check, const Handle& dataset);

/// The length limit of a text in bytes, since damaged files may state any length.
constexpr std::size_t largest_text = std::size_t{1} << 26;

/// Returns the number of values of an attribute. Throws FileError if it exceeds the length of the largest text.
std::size_t attribute_size(const Check& check, const Handle& attribute);

/// Throws FileError unless the data of the dataset lie in this file and not in other datasets, HDF5's own filters can
/// read them, and they are not more than the file can hold.
void require_plain_storage(OpenFile& file, const Handle& dataset, const std::string& name);

/// Throws FileError if a chunk of frames first … last is too short for the checksum that it should have, so that HDF5
/// would read beyond its memory, or longer than the file.
void require_checksums(OpenFile& file, const Handle& dataset, const std::string& name,
                       const Shape& extent, std::uint64_t first, std::uint64_t last);

/// Returns a file access property list, to be closed by the caller, that makes HDF5 read and write `file` and nothing
/// else. HDF5 never sees a failed write, which it would not survive: `file` keeps the failure for `commit`. `file` must
/// outlive the HDF5 file.
Id access_through(TransactionalFile& file);

}  // namespace vitrel::h5
