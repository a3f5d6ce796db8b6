#include "core/io/h5_open_file.h"

#include <hdf5.h>

#include <utility>

#include "core/error.h"
#include "core/io/h5_driver.h"

namespace vitrel::h5 {
namespace {

/// What HDF5 noted where the error arose, the innermost entry of its error stack.
std::string innermost_note() {
  std::string note;
  const auto keep_first = [](unsigned depth, const H5E_error2_t* error, void* out) -> herr_t {
    if (depth == 0 && error->desc) *static_cast<std::string*>(out) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &note);
  return note;
}

/// Turns HDF5's note into words for a person, with what to do about it.
std::string explained(const std::string& note) {
  if (note.find("truncated file") != std::string::npos)
    return "the file is truncated: its end is missing, restore it from a copy";
  if (note.find("file signature not found") != std::string::npos)
    return "it is not an HDF5 file, or its beginning is damaged";
  return note.empty() ? "unknown reason" : note;
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
  silence_hdf5();
  const Id access = access_through(*content_);
  // Format version 1.8: every reader in use understands it.
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  const unsigned flags = content_->writable() ? H5F_ACC_RDWR : H5F_ACC_RDONLY;
  id_ = create ? H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access)
               : H5Fopen(path.c_str(), flags, access);
  const std::string reason = id_ < 0 ? explained(innermost_note()) : "";
  H5Pclose(access);
  if (id_ < 0) throw_file_error(path_, create ? "create the file" : "open the file", "", reason);
}

OpenFile::~OpenFile() {
  silence_hdf5();
  try {
    if (id_ >= 0 && content_->writable()) flush();
  } catch (const FileError&) {  // what was flushed before is safe
  }
  if (id_ >= 0) H5Fclose(id_);
}

void OpenFile::prepare(std::string_view action, std::string_view object) const {
  silence_hdf5();
  if (!content_) throw_file_error(path_, action, object, "it is closed");
  if (!content_->failure().empty()) throw_file_error(path_, action, object, content_->failure());
}

void OpenFile::fail(std::string_view action, std::string_view object) {
  fail(action, object, explained(innermost_note()));
}

void OpenFile::fail(std::string_view action, std::string_view object, const std::string& reason) {
  if (content_ && content_->writable()) content_->give_up(reason);
  const bool known = content_ && !content_->failure().empty();
  throw_file_error(path_, action, object, known ? content_->failure() : reason);
}

void OpenFile::flush() {
  run("write", "", [&] { return H5Fflush(id_, H5F_SCOPE_GLOBAL); });
  content_->commit();
}

void OpenFile::synchronize() {
  flush();
  content_->synchronize();
}

void OpenFile::close() {
  flush();
  run("close", "", [&] { return H5Fclose(std::exchange(id_, -1)); });
  content_->commit();
  content_->synchronize();
  content_.reset();
}

}  // namespace vitrel::h5
