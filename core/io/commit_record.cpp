#include "core/io/commit_record.h"

#include "core/io/word_checksum.h"

namespace vitrel {
namespace {

constexpr std::uint64_t mark_magic = std::uint64_t{0x76746d6b} << 32;
constexpr std::uint64_t low_half = 0xffffffff;

std::uint64_t checksum_of(const CommitRecord& record) {
  WordChecksum checksum;
  for (const std::uint64_t word : {record.begun, record.done, record.end, record.is_written})
    checksum.add(word);
  return checksum.value();
}

bool is_later_than(std::uint64_t commit, std::uint64_t mark) {
  return (mark & ~low_half) == mark_magic && (mark & low_half) > (commit & low_half);
}

}  // namespace

bool has_magic(const CommitRecord& record) {
  return record.magic == CommitRecord().magic;
}

bool is_whole(const CommitRecord& record) {
  return has_magic(record) && record.checksum == checksum_of(record);
}

CommitRecord with_checksum(CommitRecord record) {
  record.checksum = checksum_of(record);
  return record;
}

CommitMark mark_behind(std::uint64_t end) {
  constexpr std::uint64_t size = sizeof(std::uint64_t);  // aligned, so that no page ends inside it
  const std::uint64_t place = (end + size - 1) / size * size;
  return {place, place + size};
}

std::uint64_t mark_of(std::uint64_t commit) {
  return mark_magic | (commit & low_half);
}

std::uint64_t state_of(const FoundCommits& found) {
  const auto& [record, journal, mark] = found;
  // A process that is killed while it writes the record leaves the journal.
  if (!is_whole(record)) return journal.value_or(0);
  // The journal was written before the record, and it has all that its commit changes.
  if (journal == record.begun) return record.begun;
  const bool is_at_rest = record.begun == record.done;
  return is_at_rest && !is_later_than(record.done, mark) ? record.done : 0;
}

}  // namespace vitrel
