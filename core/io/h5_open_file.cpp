#include "core/io/h5_open_file.h"

#include <hdf5.h>

#include <utility>

#include "core/error.h"

namespace vitrel::h5 {
namespace {

/// Returns why HDF5 failed, for a person: for known causes, which HDF5 numbers, it also says what to do about them;
/// otherwise it is the note of HDF5 from where the error arose.
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
  // HDF5 cannot close at the end of the process while any thread holds the note of an error.
  static_cast<void>(H5Eclear2(H5E_DEFAULT));
  return is_known && !reason.empty() ? reason : "unknown reason";
}

}  // namespace

void silence_hdf5() {
  thread_local const herr_t silenced = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  static_cast<void>(silenced);
}

std::string file_error_text(const std::string& path, std::string_view action,
                            std::string_view object, const std::string& reason) {
  std::string message = path + ": cannot " + std::string(action);
  if (!object.empty()) message += ' ' + std::string(object);
  return message + ": " + reason;
}

void throw_file_error(const std::string& path, std::string_view action, std::string_view object,
                      const std::string& reason) {
  throw FileError(file_error_text(path, action, object, reason));
}

OpenFile::OpenFile(const std::filesystem::path& path, TransactionalFile::Mode mode)
    : path_(path.string()), content_(std::in_place, path, mode) {
  if (mode == TransactionalFile::Mode::create)
    create();
  else
    open();
}

Handle OpenFile::access() {
  const Check check(*this, "open the file", "");
  Handle access(access_through(*content_));
  // Format version 1.8: every reader in use understands it.
  check(H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_V18));
  check(H5Pset_fclose_degree(access.id(), H5F_CLOSE_STRONG));
  return access;
}

void OpenFile::set_path(const std::filesystem::path& path) {
  path_ = path.string();
  if (content_) content_->set_path(path);
}

void OpenFile::create() {
  const Check check(*this, "create the file", "");
  const Handle creation(check(H5Pcreate(H5P_FILE_CREATE)));
  check(H5Pset_userblock(creation.id(), commit_record_block));
  id_ = check(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, creation.id(), access().id()));
}

/// Another process may change the file before HDF5 has read what it needs; the file is then opened again.
void OpenFile::open() {
  const unsigned flags = content_->writable() ? H5F_ACC_RDWR : H5F_ACC_RDONLY;
  for (int reading = 1;; ++reading) {
    const Handle opening = access();
    id_ = H5Fopen(path_.c_str(), flags, opening.id());
    if (id_ >= 0) return;
    if (!content_->has_changed() || reading == max_readings) fail("open the file", "");
    content_->refresh();
  }
}

void OpenFile::reopen() {
  if (id_ >= 0) static_cast<void>(H5Fclose(std::exchange(id_, -1)));  // a failure loses nothing
  content_->refresh();
  open();
}

OpenFile::~OpenFile() {
  silence_hdf5();
  try {
    if (id_ >= 0 && content_->writable()) flush();
  } catch (const FileError&) {  // what was flushed before is safe
  }
  if (id_ >= 0) static_cast<void>(H5Fclose(id_));  // nobody is left to report a failure to
}

void OpenFile::prepare(std::string_view action, std::string_view object) const {
  silence_hdf5();
  if (!content_) throw_file_error(path_, action, object, "it is closed");
  if (content_->has_changed())
    throw ChangedFile(file_error_text(path_, action, object, content_->failure()));
  if (content_->failure().empty()) return;
  if (content_->writable()) throw_file_error(path_, "write", "", content_->failure());
  throw_file_error(path_, action, object, content_->failure());
}

void OpenFile::fail(std::string_view action, std::string_view object) {
  fail(action, object, explained_failure());
}

void OpenFile::fail(std::string_view action, std::string_view object, const std::string& reason) {
  if (content_ && content_->writable()) content_->give_up(reason);
  prepare(action, object);  // throws what failed first, if something did
  throw_file_error(path_, action, object, reason);
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
