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
/// What the objects of h5.h have in common: the open file, and one way to report a failure.
namespace vitrel::h5 {

/// HDF5 keeps one error handler per thread.
void silence_hdf5();

/// "path: cannot action object: reason".
[[noreturn]] void throw_file_error(const std::string& path, std::string_view action,
                                   std::string_view object, const std::string& reason);

/// Whether HDF5 says by this result that it failed: a number below 0, no size or no memory.
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

  /// Throws FileError with `reason`, or the earlier one after which nothing was written any more.
  [[noreturn]] void fail(std::string_view action, std::string_view object,
                         const std::string& reason);

  bool is_being_written() const { return content_ && content_->is_being_written(); }
  /// Closes all objects of a file that is open for reading, and goes on to its present content.
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
  /// With the reason that HDF5 gives.
  [[noreturn]] void fail(std::string_view action, std::string_view object);

  std::string path_;
  std::optional<TransactionalFile> content_;  ///< none once closed
  Id id_ = -1;
};

/// An operation on the file. Every result of HDF5 in it goes through this: what failed becomes a FileError.
class Check {
 public:
  /// Throws FileError if the file is closed, or something failed before. `action` outlives the operation.
  Check(OpenFile& file, std::string_view action, std::string object)
      : file_(file), action_(action), object_(std::move(object)) {
    file.prepare(action_, object_);
  }

  template <class Result>
  Result operator()(Result result) const {
    if (is_failure(result)) file_.fail(action_, object_);
    return result;
  }

 private:
  OpenFile& file_;
  std::string_view action_;
  std::string object_;
};

}  // namespace vitrel::h5
