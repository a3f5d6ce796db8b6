#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace vitrel {

/// A file that changes by commits (TransactionalFile) begins with this record, in a block that HDF5 leaves to its user.
/// A reader compares it with the record that it found before, and so knows that everything it has read belongs to the
/// same commit. Commits are counted from 1.
struct CommitRecord {
  std::array<char, 8> magic{'v', 't', 'r', 'l', 'c', 'm', 't', '1'};
  std::uint64_t begun = 0;       ///< the last commit that began to change earlier content
  std::uint64_t done = 0;        ///< the last commit that ended
  std::uint64_t end = 0;         ///< the size of the file after the commit `done`
  std::uint64_t is_written = 0;  ///< 1 while a writer has the file open, and after one was killed
  std::uint64_t checksum = 0;    ///< checksum of the numbers above
  bool operator==(const CommitRecord&) const = default;
};

/// The number of bytes that HDF5 leaves free for the record, a power of two.
constexpr std::uint64_t commit_record_block = 512;

bool has_magic(const CommitRecord& record);
bool is_whole(const CommitRecord& record);
CommitRecord with_checksum(CommitRecord record);

/// Before a commit changes anything, it also writes a mark behind the end of the earlier content. A program that copies
/// the file from its first byte to its last reads the mark after everything that may have changed, so a torn copy can
/// be recognised.
struct CommitMark {
  std::uint64_t place;  ///< offset in the file
  std::uint64_t end;    ///< the first byte after the mark
};
CommitMark mark_behind(std::uint64_t end);
std::uint64_t mark_of(std::uint64_t commit);

/// What a reader finds in a file. It reads the members in this order.
struct FoundCommits {
  CommitRecord record;
  std::optional<std::uint64_t> journal;  ///< the commit of the journal at the end of the file
  std::uint64_t mark;                    ///< the number behind record.end
};
/// Returns the commit that the content belongs to; 0 if it may belong to several.
std::uint64_t state_of(const FoundCommits& found);

}  // namespace vitrel
