#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vitrel {

/// Frames of a trajectory in the notation of Python's slices, counted from 0. "7" is one frame; "first:end:step" are
/// the frames first, first + step … before `end`. Every part may be left out, and negative numbers count from the
/// end: "-1" is the last frame, ":" are all, "::10" is every tenth, and "-5:" are the last five. As in Python, a
/// range may extend beyond the existing frames, but a single frame may not. The step is at least 1.
class FrameRange {
 public:
  /// Throws UserError if the text does not have this form.
  explicit FrameRange(const std::string& text);

  /// Selects the frames among `frames` frames, in ascending order. Throws UserError, which names `file`, if there are
  /// none.
  std::vector<std::uint64_t> of(std::uint64_t frames, const std::string& file) const;

 private:
  [[noreturn]] void fail(const std::string& what) const;
  std::optional<std::int64_t> number(const std::string& part) const;

  std::string text_;
  bool is_single_ = false;
  std::optional<std::int64_t> first_, end_;
  std::int64_t step_ = 1;
};

}  // namespace vitrel
