#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "core/io/commit_record.h"

namespace vitrel {

/// A file that changes all at once: what is written since the last commit reaches the file by the next `commit`, whole
/// or not at all, even if the process is killed in the middle of it or the disk is full. (A loss of power is survived
/// as far as `synchronize` was called.)
///
/// Bytes beyond the committed end are written at once, since nothing refers to them yet; changed pages before it stay
/// in memory. `commit`
///   1. extends the file to its new size,
///   2. appends a journal: the changed pages, their places, and last a checksum,
///   3. notes in the CommitRecord, and behind the old end, that it begins,
///   4. writes the pages to their places,
///   5. notes in the record that it is done, and cuts the journal off.
///
/// A process killed in step 1 or 2 leaves the old content (and bytes beyond its end, which nothing refers to). A
/// process killed later leaves a whole journal, and opening the file repeats steps 4 and 5 (in memory only, if it is
/// opened for reading). The journal is part of the file, so a copy has it, too.
///
/// A file may be read while another process writes it. A reader sees the content of one commit: after every access it
/// compares the record, and reading fails if a later commit has begun (`has_changed`) until `refresh` continues with
/// that commit. A copy that was made during a commit and mixes its pages with earlier ones is refused. Both rely on
/// readers seeing writes in the order in which they were made, as processes of one machine do; machines that share a
/// folder by NFS need not. A file without a record, which another program or vitrel up to 0.2 wrote, can be read only
/// while no process writes it.
///
/// Writing never reports a failure to the caller: the first failure is noted, everything after it is kept in memory,
/// and `commit` reports it. An advisory lock lets one process at a time write. Where the file system has no locks,
/// writing is refused, unless HDF5_USE_FILE_LOCKING is FALSE: then the user must make sure that only one process
/// writes.
class TransactionalFile {
 public:
  enum class Mode { read, write, create };
  /// `create` starts an empty file, which replaces one of the same name; its first commit_record_block bytes do not
  /// belong to the caller. Throws FileError.
  TransactionalFile(std::filesystem::path path, Mode mode);
  /// Discards what was not committed.
  ~TransactionalFile();
  TransactionalFile(const TransactionalFile&) = delete;
  TransactionalFile& operator=(const TransactionalFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Makes messages name this path, after the file was renamed.
  void set_path(std::filesystem::path path) { path_ = std::move(path); }
  bool writable() const { return mode_ != Mode::read; }
  std::uint64_t size() const { return size_; }
  /// The reason why reading or writing failed first; empty if it did not.
  const std::string& failure() const { return failure_; }
  /// Returns the first byte that the caller may use for new content.
  std::uint64_t free_from() const;
  /// Whether another process had the file open for writing when this one opened it.
  bool is_being_written() const { return is_being_written_; }
  /// Whether reading failed because another process has changed the file since it was opened, or refreshed.
  bool has_changed() const { return has_changed_; }
  /// Continues with the present state of a file that is read. Throws FileError.
  void refresh();

  /// Reads bytes; those beyond the end are 0. Returns false on failure.
  bool read(std::uint64_t offset, std::span<std::byte> bytes);
  void write(std::uint64_t offset, std::span<const std::byte> bytes);
  void resize(std::uint64_t size);
  /// Commits what was written. Throws FileError. The file then has the content of the last commit (or, if the commit
  /// failed after step 2, the next opening may complete it), and every later commit throws.
  void commit();
  /// Makes sure that nothing is written from now on; every later commit throws.
  void give_up(const std::string& reason);
  /// Waits until what was committed is on disk. Throws FileError.
  void synchronize();

 private:
  static constexpr std::uint64_t page_size = 4096;
  using Page = std::array<std::byte, page_size>;

  void open();
  void lock_for_writing();
  void lock_for_reading();
  bool try_lock(int kind);
  bool read_file(std::uint64_t offset, std::span<std::byte> bytes);
  bool write_file(std::uint64_t offset, std::span<const std::byte> bytes);
  bool set_file_size(std::uint64_t size);
  Page& page(std::uint64_t index);
  /// Returns the number of pages that the committed content touches.
  std::uint64_t committed_pages() const { return (committed_ + page_size - 1) / page_size; }
  bool append_journal();
  bool apply_pages();
  void recover();
  void take_state();
  std::uint64_t look_for_state();
  std::uint64_t file_size();
  bool load_journal();
  CommitRecord stored_record();
  void prepare_record();
  bool write_record();
  bool begin_changes();
  bool is_unchanged();

  std::filesystem::path path_;
  Mode mode_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;               ///< size as the caller sees it
  std::uint64_t committed_ = 0;          ///< size at the last commit
  std::map<std::uint64_t, Page> pages_;  ///< content that differs from the file's, by page number
  std::string failure_;
  bool journal_is_whole_ = false;
  bool is_dirty_ = false;  ///< something was written since the last commit
  std::optional<CommitRecord> record_;
  std::uint64_t state_ = 0;  ///< the commit whose content is read
  bool is_being_written_ = false, has_changed_ = false;
};

}  // namespace vitrel
