#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

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

/// The file identifier, shared by all objects of the file.
class OpenFile {
 public:
  OpenFile(const std::filesystem::path& path, TransactionalFile::Mode mode);
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile();

  Id id() const { return id_; }
  const std::string& path() const { return path_; }

  /// Runs an HDF5 call; a negative result becomes a FileError.
  template <class Call>
  auto run(std::string_view action, std::string_view object, Call&& call) {
    prepare(action, object);
    const auto result = call();
    if (result < 0) fail(action, object);
    return result;
  }
  /// Throws FileError with `reason`, or the earlier one after which nothing was written any more.
  [[noreturn]] void fail(std::string_view action, std::string_view object,
                         const std::string& reason);

  void flush();
  void synchronize();
  void close();

 private:
  void prepare(std::string_view action, std::string_view object) const;
  /// With the reason that HDF5 gives.
  [[noreturn]] void fail(std::string_view action, std::string_view object);

  std::string path_;
  std::optional<TransactionalFile> content_;  ///< none once closed
  Id id_ = -1;
};

}  // namespace vitrel::h5
