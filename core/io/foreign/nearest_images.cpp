#include "core/io/foreign/nearest_images.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace vitrel {

namespace {

constexpr double doubtful_step = 0.25;  // in box lengths

}  // namespace

template <int Dim>
void NearestImages<Dim>::set(Configuration<Dim>& next, bool knows_flight) {
  double longest = 0;
  for (std::size_t i = 0; i < next.size(); ++i) {
    Shift<Dim>& image = next.image[i] = Shift<Dim>::Zero();
    if (!last_) continue;
    // The box may have changed.
    const Vec<Dim> step = next.position[i].cwiseQuotient(next.box.lengths()) -
                          last_->position[i].cwiseQuotient(last_->box.lengths());
    for (int k = 0; k < Dim; ++k) {
      const double crossings = std::round(step[k]), length = std::abs(step[k] - crossings);
      image[k] = last_->image[i][k] - static_cast<std::int32_t>(crossings);
      longest = std::max(longest, length);
      if (length > longest_.box_lengths) longest_ = {length, i, frames_, k};
    }
    if (knows_flight) compare_with_flight(next, i);
  }
  if (longest > doubtful_step) doubtful_.push_back(frames_);
  last_ = next;
  ++frames_;
}

template <int Dim>
void NearestImages<Dim>::compare_with_flight(const Configuration<Dim>& next, std::size_t i) const {
  const Vec<Dim>& velocity = next.velocity[i];
  constexpr double rounding = 1e-6;  // of single precision
  if ((velocity - last_->velocity[i]).cwiseAbs().maxCoeff() >
      rounding * velocity.cwiseAbs().maxCoeff())
    return;
  const Vec<Dim> flight = velocity * (next.time - last_->time);
  const Vec<Dim> step = next.unwrapped(i) - last_->unwrapped(i);
  if (((flight - step).cwiseAbs() - 0.5 * next.box.lengths()).maxCoeff() > 0)
    throw UserError(fmt::format(
        "particle {} has the same velocity as in the frame before and flew by ({}), but its "
        "nearest image moved by ({}); unwrap = \"nearest\" does not hold for frames so far apart",
        i, fmt::join(flight, ", "), fmt::join(step, ", ")));
}

template <int Dim>
std::string NearestImages<Dim>::remark() const {
  std::string text = fmt::format(
      "those of the nearest images (unwrap = \"nearest\"); the longest step is "
      "{:.3g} box lengths along {}, of particle {} to frame {}",
      longest_.box_lengths, "xyz"[longest_.direction], longest_.particle, longest_.frame);
  if (!doubtful_.empty())
    text +=
        fmt::format(": above {}, longer steps that were taken for shorter ones cannot be excluded",
                    doubtful_step);
  return text;
}

template class NearestImages<2>;
template class NearestImages<3>;

}  // namespace vitrel
