#include "workflow/storage/check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>

#include "core/error.h"
#include "core/state/contact_scale.h"

namespace vitrel {
namespace {

template <int Dim>
void note_overlaps(FileCheck<Dim>& result, const ExactCheck<Dim>& check, std::uint64_t frame,
                   double time, std::size_t named) {
  result.overlaps += check.overlaps.size();
  for (const PairImage<Dim>& pair : check.overlaps) {
    if (result.complaints.size() == named) return;
    result.complaints.push_back(fmt::format(
        "frame {} (time {:.6g}): particles {} and {}, image ({}), would touch if scaled by 1 − "
        "{:.3g}",
        frame, time, pair.i, pair.j, fmt::join(pair.shift.data(), pair.shift.data() + Dim, ", "),
        1 - contact_scale(result.last, pair)));
  }
}

}  // namespace

template <int Dim>
FileCheck<Dim> check_file(const TrajectoryReader& reader, bool last_only,
                          const RunControl& control) {
  if (reader.frames() == 0) throw FileError(reader.path().string() + ": has no frame to check");
  FileCheck<Dim> result;
  result.smallest_gap = std::numeric_limits<double>::infinity();
  // A message has at most two lines of details: two overlaps, or one overlap and its possible reason.
  const std::size_t named = reader.has_single_precision() ? 1 : 2;
  const std::uint64_t first = last_only ? reader.frames() - 1 : 0;
  for (std::uint64_t frame = first; frame < reader.frames() && !control.stop_requested(); ++frame) {
    reader.read(frame, result.last);
    const ExactCheck<Dim> check = exact_check(result.last);
    ++result.frames;
    result.close_pairs += result.last.close_pairs.size();
    note_overlaps(result, check, frame, result.last.time, named);
    if (check.smallest_gap < result.smallest_gap) {
      result.smallest_gap = check.smallest_gap;
      result.smallest_gap_frame = frame;
    }
    control.report_progress({static_cast<double>(frame + 1) / static_cast<double>(reader.frames()),
                             static_cast<double>(frame + 1), "frame"});
  }
  if (result.overlaps > 0 && reader.has_single_precision())
    result.complaints.emplace_back(
        "its positions are rounded to single precision (output.precision), so that particles that "
        "touched may overlap in it");
  return result;
}

template FileCheck<2> check_file(const TrajectoryReader&, bool, const RunControl&);
template FileCheck<3> check_file(const TrajectoryReader&, bool, const RunControl&);

}  // namespace vitrel
