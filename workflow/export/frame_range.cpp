#include "workflow/export/frame_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/error.h"

namespace vitrel {
namespace {

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == ':')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

}  // namespace

FrameRange::FrameRange(const std::string& text) : text_(text) {
  const std::vector<std::string> parts = split(text);
  if (text.empty() || parts.size() > 3)
    fail("should be one frame or first:end:step, such as -1 or 0:100:10");
  is_single_ = parts.size() == 1;
  first_ = number(parts[0]);
  if (parts.size() > 1) end_ = number(parts[1]);
  if (parts.size() > 2) step_ = number(parts[2]).value_or(1);
  if (step_ < 1) fail("has a step below 1, but frames are exported in the order of time");
}

void FrameRange::fail(const std::string& what) const {
  throw UserError(fmt::format("--frames {}: {}", text_, what));
}

std::optional<std::int64_t> FrameRange::number(const std::string& part) const {
  if (part.empty()) return std::nullopt;
  std::int64_t value = 0;
  const char* end = part.data() + part.size();
  const auto [stop, error] = std::from_chars(part.data(), end, value);
  if (stop != end || error != std::errc())
    fail(
        fmt::format("\"{}\" is not a whole number; what is meant is one frame or first:end:step, "
                    "such as -1 or 0:100:10",
                    part));
  return value;
}

std::vector<std::uint64_t> FrameRange::of(std::uint64_t frames, const std::string& file) const {
  const auto count = static_cast<std::int64_t>(frames);
  const auto from_start = [count](std::int64_t index) { return index < 0 ? index + count : index; };
  std::int64_t first = from_start(first_.value_or(0));
  std::int64_t end = is_single_ ? std::min(first, count) + 1 : from_start(end_.value_or(count));
  if (!is_single_) {
    first = std::max<std::int64_t>(first, 0);
    end = std::min(end, count);
  }
  if (first < 0 || end > count || first >= end)
    fail(fmt::format("selects nothing: {} has {} frame(s), counted from 0", file, frames));
  std::vector<std::uint64_t> chosen;
  for (; first < end; first += std::min(step_, count)) chosen.push_back(first);
  return chosen;
}

}  // namespace vitrel
