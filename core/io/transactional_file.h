#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>

namespace vitrel {

/// A file that changes all at once: what is written since the last commit shows up in the file only
/// by the next `commit`, whole or not at all, even if the process is killed in the middle of it or
/// the disk is full. (A loss of power is survived as far as `synchronize` was called.)
///
/// Bytes beyond the committed end are written at once, since nothing refers to them yet; changed
/// pages before it stay in memory. `commit`
///   1. extends the file to its new size,
///   2. appends a journal: the changed pages, their places, and last a checksum,
///   3. writes the pages to their places,
///   4. cuts the journal off.
/// A process killed in 1 or 2 leaves the old content (and bytes beyond its end, which nothing
/// refers to); killed in 3 or 4 it leaves a whole journal, and opening the file does 3 and 4 again
/// (in memory only, if it is opened for reading). The journal is part of the file, so that a copy
/// has it too.
///
/// Writing never fails towards the caller: the first failure is noted, everything after it is kept
/// in memory, and `commit` reports it. One process at a time may write, by an advisory lock; where
/// the file system has no locks, or HDF5_USE_FILE_LOCKING is FALSE, there is none.
class TransactionalFile {
 public:
  enum class Mode { read, write, create };
  /// `create` starts an empty file, in place of one of the same name. Throws FileError.
  TransactionalFile(std::filesystem::path path, Mode mode);
  /// Gives up what was not committed.
  ~TransactionalFile();
  TransactionalFile(const TransactionalFile&) = delete;
  TransactionalFile& operator=(const TransactionalFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  bool writable() const { return mode_ != Mode::read; }
  std::uint64_t size() const { return size_; }
  /// Why reading or writing failed first; empty if it did not.
  const std::string& failure() const { return failure_; }

  /// Bytes beyond the end are 0. False on failure.
  bool read(std::uint64_t offset, std::span<std::byte> bytes);
  void write(std::uint64_t offset, std::span<const std::byte> bytes);
  void resize(std::uint64_t size) { size_ = size; }
  /// Throws FileError; the file then has the content of the last commit (or, if step 3 failed, is
  /// completed by the next opening), and every later commit throws.
  void commit();
  /// From now on nothing is written; every later commit throws.
  void give_up(const std::string& reason);
  /// Waits until the disk has what was committed. Throws FileError.
  void synchronize();

 private:
  static constexpr std::uint64_t page_size = 4096;
  using Page = std::array<std::byte, page_size>;

  void lock();
  bool read_file(std::uint64_t offset, std::span<std::byte> bytes);
  bool write_file(std::uint64_t offset, std::span<const std::byte> bytes);
  bool set_file_size(std::uint64_t size);
  Page& page(std::uint64_t index);
  /// Number of pages that the committed content touches.
  std::uint64_t committed_pages() const { return (committed_ + page_size - 1) / page_size; }
  bool append_journal();
  bool apply_pages();
  void recover();
  bool load_journal(std::uint64_t file_size);

  std::filesystem::path path_;
  Mode mode_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;               ///< as the caller sees it
  std::uint64_t committed_ = 0;          ///< size at the last commit
  std::map<std::uint64_t, Page> pages_;  ///< content that differs from the file's, by page number
  std::string failure_;
  bool journal_is_whole_ = false;
};

}  // namespace vitrel
