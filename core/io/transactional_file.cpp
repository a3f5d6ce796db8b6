#include "core/io/transactional_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <system_error>
#include <thread>
#include <vector>

#include "core/error.h"
#include "core/io/word_checksum.h"

namespace vitrel {
namespace {

/// The last bytes of a file with a journal.
struct Trailer {
  std::uint64_t begin;     ///< start of the journal, a sequence of page numbers and pages
  std::uint64_t size;      ///< size of the file once the journal is cut off
  std::uint64_t checksum;  ///< checksum of the journal, begin and size
  std::array<char, 8> magic;
};
constexpr std::array<char, 8> journal_magic{'v', 't', 'r', 'l', 'j', 'r', 'n', '1'};

/// A journal consists of whole words.
std::uint64_t checksum_of(std::span<const std::byte> journal, const Trailer& trailer) {
  WordChecksum checksum;
  for (std::size_t k = 0; k + 8 <= journal.size(); k += 8) {
    std::uint64_t word;
    std::memcpy(&word, journal.data() + k, 8);
    checksum.add(word);
  }
  checksum.add(trailer.begin);
  checksum.add(trailer.size);
  return checksum.value();
}

std::string system_message() {
  return std::generic_category().message(errno);
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& action,
                       const std::string& reason) {
  throw FileError(path.string() + ": cannot " + action + ": " + reason);
}

std::string opening(TransactionalFile::Mode mode) {
  return mode == TransactionalFile::Mode::create ? "create the file" : "open the file";
}

constexpr const char* in_use =
    "another program has it open for writing; wait until that one has ended";

constexpr const char* truncated =
    "the file is truncated: its end is missing, restore it from a copy";

bool locking_is_off() {
  const char* setting = std::getenv("HDF5_USE_FILE_LOCKING");
  return setting && (std::string(setting) == "FALSE" || std::string(setting) == "0");
}

/// Returns whether `succeeds` returns true within some milliseconds: another process may be between two of its system
/// calls.
bool succeeds_soon(const std::function<bool()>& succeeds) {
  constexpr int attempts = 10;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    if (succeeds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

}  // namespace

TransactionalFile::TransactionalFile(std::filesystem::path path, Mode mode)
    : path_(std::move(path)), mode_(mode) {
  const int flags = mode == Mode::read ? O_RDONLY : mode == Mode::write ? O_RDWR : O_RDWR | O_CREAT;
  descriptor_ = ::open(path_.c_str(), flags | O_NONBLOCK | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail(path_, opening(mode), system_message());
  try {
    open();
  } catch (...) {
    static_cast<void>(::close(descriptor_));
    throw;
  }
}

void TransactionalFile::open() {
  struct stat status;
  if (::fstat(descriptor_, &status) != 0) fail(path_, opening(mode_), system_message());
  if (!S_ISREG(status.st_mode)) fail(path_, opening(mode_), "it is not a regular file");
  if (mode_ == Mode::read) {
    lock_for_reading();
    return take_state();
  }
  lock_for_writing();
  if (mode_ == Mode::write) return recover();
  if (!set_file_size(0)) fail(path_, opening(mode_), failure_);
  record_ = CommitRecord{.is_written = 1};
}

TransactionalFile::~TransactionalFile() {
  // The space of what was not committed is given back.
  if (writable() && !journal_is_whole_) set_file_size(committed_);
  if (writable() && record_ && committed_ > 0 && failure_.empty()) {
    record_->is_written = 0;
    write_record();
  }
  static_cast<void>(::close(descriptor_));  // everything that must be on disk was synchronized
}

/// Where the file system has no locks, reading is allowed, but writing is refused.
bool TransactionalFile::try_lock(int kind) {
  if (locking_is_off() || ::flock(descriptor_, kind | LOCK_NB) == 0) return true;
  if (errno == EWOULDBLOCK || errno == EINTR) return false;
  if (kind == LOCK_EX)
    fail(path_, opening(mode_),
         "the file system has no locks (" + system_message() +
             "), so another program could write it at the same time; if none does, set "
             "HDF5_USE_FILE_LOCKING=FALSE");
  return true;
}

/// Readers hold the lock for a moment only, to find out whether another process writes, so the writer tries again.
void TransactionalFile::lock_for_writing() {
  if (!succeeds_soon([this] { return try_lock(LOCK_EX); })) fail(path_, opening(mode_), in_use);
}

void TransactionalFile::lock_for_reading() {
  bool has_commits = false;
  const auto is_readable = [&] {
    const CommitRecord record = stored_record();
    has_commits = has_magic(record);
    is_being_written_ = !try_lock(LOCK_SH);
    return !is_being_written_ || (has_commits && record.is_written);
  };
  if (!succeeds_soon(is_readable)) fail(path_, opening(mode_), in_use);
  if (has_commits)
    static_cast<void>(::flock(descriptor_, LOCK_UN));  // the lock ends with the reader anyway
}

bool TransactionalFile::read_file(std::uint64_t offset, std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count =
        ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      if (failure_.empty()) failure_ = system_message();
      return false;
    }
    if (count == 0) break;
    bytes = bytes.subspan(count);
    offset += count;
  }
  std::fill(bytes.begin(), bytes.end(), std::byte{0});
  return true;
}

bool TransactionalFile::write_file(std::uint64_t offset, std::span<const std::byte> bytes) {
  while (failure_.empty() && !bytes.empty()) {
    const ssize_t count =
        ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno != EINTR) failure_ = system_message();
    if (count < 0) continue;
    bytes = bytes.subspan(count);
    offset += count;
  }
  return failure_.empty();
}

bool TransactionalFile::set_file_size(std::uint64_t size) {
  if (::ftruncate(descriptor_, static_cast<off_t>(size)) != 0 && failure_.empty())
    failure_ = system_message();
  return failure_.empty();
}

TransactionalFile::Page& TransactionalFile::page(std::uint64_t index) {
  const auto found = pages_.find(index);
  if (found != pages_.end()) return found->second;
  Page content;
  read_file(index * page_size, content);
  return pages_[index] = content;
}

bool TransactionalFile::read(std::uint64_t offset, std::span<std::byte> bytes) {
  if (!read_file(offset, bytes)) return false;
  if (!writable() && record_ && !is_unchanged()) return false;
  if (bytes.empty()) return true;
  const std::uint64_t end = offset + bytes.size();
  const auto last = pages_.upper_bound((end - 1) / page_size);
  for (auto it = pages_.lower_bound(offset / page_size); it != last; ++it) {
    const std::uint64_t start = it->first * page_size;
    const std::uint64_t from = std::max(start, offset), to = std::min(start + page_size, end);
    std::memcpy(&bytes[from - offset], &it->second[from - start], to - from);
  }
  return true;
}

void TransactionalFile::write(std::uint64_t offset, std::span<const std::byte> bytes) {
  const std::uint64_t end = offset + bytes.size();
  size_ = std::max(size_, end);
  is_dirty_ = true;
  while (offset < end) {
    const std::uint64_t index = offset / page_size;
    const bool beyond = index >= committed_pages() && failure_.empty();
    if (beyond && write_file(offset, bytes)) return;
    const std::uint64_t count = std::min(end, (index + 1) * page_size) - offset;
    std::memcpy(&page(index)[offset % page_size], bytes.data(), count);
    bytes = bytes.subspan(count);
    offset += count;
  }
}

std::uint64_t TransactionalFile::free_from() const {
  return writable() && record_ && committed_ > 0 ? mark_behind(committed_).end : 0;
}

void TransactionalFile::resize(std::uint64_t size) {
  is_dirty_ = is_dirty_ || size > size_;
  size_ = size;
}

void TransactionalFile::commit() {
  if (!failure_.empty()) fail(path_, "write", failure_);
  if (!is_dirty_) return;
  if (record_) prepare_record();
  if (!failure_.empty() || !set_file_size(std::max(size_, committed_)) || !append_journal())
    fail(path_, "write", failure_);
  // If the next step fails, the next opening repeats it.
  journal_is_whole_ = true;
  if (!apply_pages()) fail(path_, "write", failure_);
  journal_is_whole_ = false;
  is_dirty_ = false;
}

/// Prepares the record and the mark, which are part of the journal.
void TransactionalFile::prepare_record() {
  ++record_->begun;
  size_ = std::max(size_, free_from());
  const std::uint64_t mark = mark_of(record_->begun), place = mark_behind(committed_).place;
  if (committed_ > 0 && place / page_size < committed_pages())
    std::memcpy(&page(place / page_size)[place % page_size], &mark, sizeof(mark));
  record_ = with_checksum(*record_);
  std::memcpy(page(0).data(), &*record_, sizeof(CommitRecord));
}

bool TransactionalFile::write_record() {
  record_ = with_checksum(*record_);
  return write_file(0, std::as_bytes(std::span(&*record_, 1)));
}

bool TransactionalFile::append_journal() {
  if (pages_.empty()) return true;
  const std::uint64_t end = std::max(size_, committed_pages() * page_size);
  Trailer trailer{(end + page_size - 1) / page_size * page_size, size_, 0, journal_magic};
  std::vector<std::byte> journal(pages_.size() * (8 + page_size) + sizeof(Trailer));
  std::byte* out = journal.data();
  for (const auto& [index, content] : pages_) {
    std::memcpy(out, &index, 8);
    std::memcpy(out + 8, content.data(), page_size);
    out += 8 + page_size;
  }
  trailer.checksum = checksum_of(std::span(journal).first(out - journal.data()), trailer);
  std::memcpy(out, &trailer, sizeof(Trailer));
  return write_file(trailer.begin, journal);
}

bool TransactionalFile::apply_pages() {
  if (record_ && !begin_changes()) return false;
  for (const auto& [index, content] : pages_)
    if (!write_file(index * page_size, content)) return false;
  if (record_) {
    record_->done = record_->begun;
    record_->end = size_;
    if (!write_record()) return false;
  }
  if (!set_file_size(size_)) return false;
  committed_ = size_;
  pages_.clear();
  return true;
}

bool TransactionalFile::begin_changes() {
  if (!write_record()) return false;
  if (record_->end == 0) return true;
  const std::uint64_t mark = mark_of(record_->begun);
  return write_file(mark_behind(record_->end).place, std::as_bytes(std::span(&mark, 1)));
}

void TransactionalFile::give_up(const std::string& reason) {
  if (failure_.empty()) failure_ = reason;
}

void TransactionalFile::synchronize() {
  // EINVAL means that the file system has nothing to wait for.
  if (::fsync(descriptor_) != 0 && errno != EINVAL)
    fail(path_, "save to the disk", system_message());
}

void TransactionalFile::recover() {
  take_state();
  if (record_) {
    record_->begun = state_;
    record_->is_written = 1;
    if (!is_whole(*record_)) record_->end = 0;
  }
  if (!pages_.empty() && !apply_pages())
    fail(path_, "repair the file after an interrupted write", failure_);
  if (!record_) return;
  record_->done = state_;
  record_->end = committed_;  // other programs may have added something
  if (!write_record()) fail(path_, "write", failure_);
}

void TransactionalFile::refresh() {
  failure_.clear();
  has_changed_ = false;
  take_state();
}

/// Tries again, as a commit that is under way ends soon or leaves a journal.
void TransactionalFile::take_state() {
  const bool has_state = succeeds_soon([this] {
    state_ = look_for_state();
    return state_ > 0;
  });
  if (!has_state)
    fail(path_, opening(mode_),
         is_whole(*record_) ? "it was copied while another process wrote it, and has parts of "
                              "several states; copy it again, or read the original, which may be "
                              "read at any time"
                            : "its first bytes are damaged; restore it from a copy");
}

/// Returns the number of the commit; 0 if the content may belong to several; 1 for a file that does not count commits.
std::uint64_t TransactionalFile::look_for_state() {
  pages_.clear();
  FoundCommits found{stored_record(), {}, 0};
  const std::uint64_t found_size = file_size();
  size_ = committed_ = found_size;
  record_.reset();
  const bool has_journal = load_journal();
  if (!has_magic(found.record)) return 1;
  if (found_size < commit_record_block) fail(path_, opening(mode_), truncated);
  record_ = found.record;
  if (has_journal) {
    CommitRecord written;
    std::memcpy(&written, page(0).data(), sizeof(written));
    found.journal = is_whole(written) ? written.begun : 0;
  }
  const CommitMark mark = mark_behind(found.record.end);
  if (mark.end <= found_size)
    read_file(mark.place, std::as_writable_bytes(std::span(&found.mark, 1)));
  const std::uint64_t state = state_of(found);
  if (found.journal != state) {  // the commit of the journal did not begin
    pages_.clear();
    size_ = found_size;
  }
  return state;
}

std::uint64_t TransactionalFile::file_size() {
  struct stat status;
  if (::fstat(descriptor_, &status) != 0) fail(path_, opening(mode_), system_message());
  return static_cast<std::uint64_t>(status.st_size);
}

CommitRecord TransactionalFile::stored_record() {
  CommitRecord record;
  if (!read_file(0, std::as_writable_bytes(std::span(&record, 1))))
    fail(path_, opening(mode_), failure_);
  return record;
}

/// HDF5 calls this function, so it must not throw.
bool TransactionalFile::is_unchanged() {
  CommitRecord now;
  if (!read_file(0, std::as_writable_bytes(std::span(&now, 1)))) return false;
  if (now == *record_ || (is_whole(now) && now.begun == state_)) return true;
  has_changed_ = true;
  failure_ = "another process changed the file meanwhile";
  return false;
}

bool TransactionalFile::load_journal() {
  const std::uint64_t file_size = size_;
  Trailer trailer;
  if (file_size < sizeof(trailer)) return false;
  const std::uint64_t end = file_size - sizeof(trailer);
  read_file(end, std::as_writable_bytes(std::span(&trailer, 1)));
  if (trailer.magic != journal_magic || trailer.begin >= end) return false;
  std::vector<std::byte> journal(end - trailer.begin);
  read_file(trailer.begin, journal);
  if (checksum_of(journal, trailer) != trailer.checksum) return false;
  for (std::size_t at = 0; at + 8 + page_size <= journal.size(); at += 8 + page_size) {
    std::uint64_t index;
    std::memcpy(&index, &journal[at], 8);
    std::memcpy(pages_[index].data(), &journal[at + 8], page_size);
  }
  size_ = trailer.size;
  return true;
}

}  // namespace vitrel
