#include "core/io/transactional_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <vector>

#include "core/error.h"

namespace vitrel {
namespace {

/// The last bytes of a file with a journal.
struct Trailer {
  std::uint64_t begin;     ///< where the journal starts: page number and page, one after another
  std::uint64_t size;      ///< of the file once the journal is cut off
  std::uint64_t checksum;  ///< of the journal, begin and size
  std::array<char, 8> magic;
};
constexpr std::array<char, 8> journal_magic{'v', 't', 'r', 'l', 'j', 'r', 'n', '1'};

/// FNV-1a over 64-bit words; journals are whole words.
std::uint64_t checksum(std::span<const std::byte> journal, const Trailer& trailer) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&hash](std::uint64_t word) { hash = (hash ^ word) * 0x100000001b3u; };
  for (std::size_t k = 0; k + 8 <= journal.size(); k += 8) {
    std::uint64_t word;
    std::memcpy(&word, journal.data() + k, 8);
    add(word);
  }
  add(trailer.begin);
  add(trailer.size);
  return hash;
}

std::string system_message() {
  return std::generic_category().message(errno);
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& action,
                       const std::string& reason) {
  throw FileError(path.string() + ": cannot " + action + ": " + reason);
}

bool locking_is_off() {
  const char* setting = std::getenv("HDF5_USE_FILE_LOCKING");
  return setting && std::string(setting) == "FALSE";
}

}  // namespace

TransactionalFile::TransactionalFile(std::filesystem::path path, Mode mode)
    : path_(std::move(path)), mode_(mode) {
  const int flags = mode == Mode::read ? O_RDONLY : mode == Mode::write ? O_RDWR : O_RDWR | O_CREAT;
  descriptor_ = ::open(path_.c_str(), flags | O_CLOEXEC, 0666);
  const std::string action = mode == Mode::create ? "create the file" : "open the file";
  if (descriptor_ < 0) fail(path_, action, system_message());
  struct stat status;
  try {
    lock();
    if (::fstat(descriptor_, &status) != 0) fail(path_, action, system_message());
    if (!S_ISREG(status.st_mode)) fail(path_, action, "it is not a regular file");
    if (mode == Mode::create && !set_file_size(0)) fail(path_, action, failure_);
    if (mode != Mode::create) recover();
  } catch (...) {
    static_cast<void>(::close(descriptor_));
    throw;
  }
}

TransactionalFile::~TransactionalFile() {
  // Gives the space of what was not committed back.
  if (writable() && !journal_is_whole_) set_file_size(committed_);
  static_cast<void>(::close(descriptor_));  // what has to be on the disk was synchronized
}

void TransactionalFile::lock() {
  if (locking_is_off()) return;
  const int kind = writable() ? LOCK_EX : LOCK_SH;
  if (::flock(descriptor_, kind | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    fail(path_, "open the file",
         "another program has it open for writing; wait until that one has ended");
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

void TransactionalFile::commit() {
  if (!failure_.empty() || !set_file_size(std::max(size_, committed_)) || !append_journal())
    fail(path_, "write", failure_);
  // Should the next step fail, the next opening repeats it.
  journal_is_whole_ = true;
  if (!apply_pages()) fail(path_, "write", failure_);
  journal_is_whole_ = false;
  committed_ = size_;
  pages_.clear();
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
  trailer.checksum = checksum(std::span(journal).first(out - journal.data()), trailer);
  std::memcpy(out, &trailer, sizeof(Trailer));
  return write_file(trailer.begin, journal);
}

bool TransactionalFile::apply_pages() {
  for (const auto& [index, content] : pages_)
    if (!write_file(index * page_size, content)) return false;
  return set_file_size(size_);
}

void TransactionalFile::give_up(const std::string& reason) {
  if (failure_.empty()) failure_ = reason;
}

void TransactionalFile::synchronize() {
  // EINVAL: a file system that has nothing to wait for.
  if (::fsync(descriptor_) != 0 && errno != EINVAL)
    fail(path_, "save to the disk", system_message());
}

void TransactionalFile::recover() {
  struct stat status;
  if (::fstat(descriptor_, &status) != 0) fail(path_, "open the file", system_message());
  size_ = committed_ = static_cast<std::uint64_t>(status.st_size);
  if (!load_journal(size_)) return;
  if (!writable()) return;
  if (!apply_pages()) fail(path_, "repair the file after an interrupted write", failure_);
  committed_ = size_;
  pages_.clear();
}

bool TransactionalFile::load_journal(std::uint64_t file_size) {
  Trailer trailer;
  if (file_size < sizeof(trailer)) return false;
  const std::uint64_t end = file_size - sizeof(trailer);
  read_file(end, std::as_writable_bytes(std::span(&trailer, 1)));
  if (trailer.magic != journal_magic || trailer.begin >= end) return false;
  std::vector<std::byte> journal(end - trailer.begin);
  read_file(trailer.begin, journal);
  if (checksum(journal, trailer) != trailer.checksum) return false;
  for (std::size_t at = 0; at + 8 + page_size <= journal.size(); at += 8 + page_size) {
    std::uint64_t index;
    std::memcpy(&index, &journal[at], 8);
    std::memcpy(pages_[index].data(), &journal[at + 8], page_size);
  }
  size_ = trailer.size;
  return true;
}

}  // namespace vitrel
