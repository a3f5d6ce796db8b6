#include "mc/sampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/contact/support_gap.h"
#include "mc/disjoint.h"

namespace vitrel {

Sampler::Sampler(Configuration2& configuration, std::uint64_t seed, std::uint64_t first_sweep)
    : configuration_(configuration),
      cells_(make_cells(configuration)),
      largest_(largest_circumradius(configuration)),
      margin_(hard_margin(configuration)),
      translation_(0.1),
      rotation_(0.1),
      seed_(seed),
      sweep_(first_sweep) {
  axis_.reserve(configuration.size());
  for (double angle : configuration.angle) axis_.push_back(direction(angle));
}

void Sampler::set_steps(double translation, double rotation) {
  translation_ = translation;
  rotation_ = rotation;
}

void Sampler::sweep() {
  const std::size_t n = configuration_.size();
  for (std::size_t trial = 0; trial < n; ++trial) {
    Stream draw(seed_, Purpose::trial_moves, sweep_, trial);
    const std::size_t i = draw.below(n);
    const bool turns = !configuration_.shape[i].is_round() && draw.below(2) == 1;
    if (turns)
      rotate(i, draw);
    else
      translate(i, draw);
  }
  ++sweep_;
}

void Sampler::translate(std::size_t i, Stream& draw) {
  Vec2 position =
      configuration_.position[i] + translation_ * Vec2(draw.uniform(-1, 1), draw.uniform(-1, 1));
  ++counts_.translations_tried;
  if (!fits(i, position, axis_[i])) return;
  ++counts_.translations_accepted;
  configuration_.box.wrap(position, configuration_.image[i]);
  configuration_.position[i] = position;
  cells_.move(i, position);
}

void Sampler::rotate(std::size_t i, Stream& draw) {
  const double angle = configuration_.angle[i] + rotation_ * draw.uniform(-1, 1);
  const Vec2 axis = direction(angle);
  ++counts_.rotations_tried;
  if (!fits(i, configuration_.position[i], axis)) return;
  ++counts_.rotations_accepted;
  configuration_.angle[i] = angle;
  axis_[i] = axis;
}

bool Sampler::fits(std::size_t i, const Vec2& position, const Vec2& axis) const {
  const Ellipse& shape = configuration_.shape[i];
  // An own image sits at a whole box from the trial position, not from the cell grid's entry.
  const Vec2 moved = position - configuration_.position[i];
  bool free = true;
  for_each_candidate(configuration_, cells_, i, position, largest_, margin_ + moved.norm(),
                     [&](std::size_t j, const Shift<2>&, const Vec2& d) {
                       if (!free) return;
                       free = j == i ? separated(shape, axis, shape, axis, d + moved, margin_)
                                     : separated(shape, axis, configuration_.shape[j], axis_[j], d,
                                                 margin_);
                     });
  return free;
}

void Sampler::tune() {
  const auto adapted = [](double step, double largest, std::uint64_t tried,
                          std::uint64_t accepted) {
    if (tried == 0) return step;
    const double acceptance = static_cast<double>(accepted) / static_cast<double>(tried);
    constexpr double wanted = 0.35, strongest = 2;
    return std::min(largest, step * std::clamp(acceptance / wanted, 1 / strongest, strongest));
  };
  translation_ = adapted(translation_, 0.5 * configuration_.box.lengths().minCoeff(),
                         counts_.translations_tried - tuned_at_.translations_tried,
                         counts_.translations_accepted - tuned_at_.translations_accepted);
  rotation_ =
      adapted(rotation_, std::numbers::pi / 2, counts_.rotations_tried - tuned_at_.rotations_tried,
              counts_.rotations_accepted - tuned_at_.rotations_accepted);
  tuned_at_ = counts_;
}

}  // namespace vitrel
