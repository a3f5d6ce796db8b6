#include "core/io/h5_open_file.h"

#include <hdf5.h>

#include <utility>

#include "core/error.h"
#include "core/io/h5_driver.h"

namespace vitrel::h5 {
namespace {

/// Why HDF5 failed, for a person: known causes, which it numbers, with what to do about them, or else what it noted
/// where the error arose.
std::string explained_failure() {
  std::string reason;
  const auto explain = [](unsigned depth, const H5E_error2_t* error, void* out) -> herr_t {
    auto& text = *static_cast<std::string*>(out);
    if (depth == 0 && error->desc) text = error->desc;
    if (error->min_num == H5E_TRUNCATED)
      text = "the file is truncated: its end is missing, restore it from a copy";
    if (error->min_num == H5E_NOTHDF5) text = "it is not an HDF5 file, or its beginning is damaged";
    return 0;
  };
  const bool is_known = H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, explain, &reason) >= 0;
  return is_known && !reason.empty() ? reason : "unknown reason";
}

}  // namespace

void silence_hdf5() {
  thread_local const herr_t silenced = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  static_cast<void>(silenced);
}

void throw_file_error(const std::string& path, std::string_view action, std::string_view object,
                      const std::string& reason) {
  std::string message = path + ": cannot " + std::string(action);
  if (!object.empty()) message += ' ' + std::string(object);
  throw FileError(message + ": " + reason);
}

OpenFile::OpenFile(const std::filesystem::path& path, TransactionalFile::Mode mode)
    : path_(path.string()), content_(std::in_place, path, mode) {
  const bool create = mode == TransactionalFile::Mode::create;
  const Check check(*this, create ? "create the file" : "open the file", "");
  const Handle access(access_through(*content_));
  // Format version 1.8: every reader in use understands it.
  check(H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_V18));
  check(H5Pset_fclose_degree(access.id(), H5F_CLOSE_STRONG));
  const unsigned flags = content_->writable() ? H5F_ACC_RDWR : H5F_ACC_RDONLY;
  id_ = check(create ? H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id())
                     : H5Fopen(path.c_str(), flags, access.id()));
}

OpenFile::~OpenFile() {
  silence_hdf5();
  try {
    if (id_ >= 0 && content_->writable()) flush();
  } catch (const FileError&) {  // what was flushed before is safe
  }
  if (id_ >= 0) static_cast<void>(H5Fclose(id_));  // nobody is left to be told
}

void OpenFile::prepare(std::string_view action, std::string_view object) const {
  silence_hdf5();
  if (!content_) throw_file_error(path_, action, object, "it is closed");
  if (!content_->failure().empty()) throw_file_error(path_, action, object, content_->failure());
}

void OpenFile::fail(std::string_view action, std::string_view object) {
  fail(action, object, explained_failure());
}

void OpenFile::fail(std::string_view action, std::string_view object, const std::string& reason) {
  if (content_ && content_->writable()) content_->give_up(reason);
  const bool known = content_ && !content_->failure().empty();
  throw_file_error(path_, action, object, known ? content_->failure() : reason);
}

void OpenFile::flush() {
  const Check check(*this, "write", "");
  check(H5Fflush(id_, H5F_SCOPE_GLOBAL));
  content_->commit();
}

void OpenFile::synchronize() {
  flush();
  content_->synchronize();
}

void OpenFile::close() {
  flush();
  const Check check(*this, "close", "");
  check(H5Fclose(std::exchange(id_, -1)));
  content_->commit();
  content_->synchronize();
  content_.reset();
}

}  // namespace vitrel::h5
