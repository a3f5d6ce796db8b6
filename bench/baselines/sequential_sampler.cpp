#include "bench/baselines/sequential_sampler.h"

#include "core/contact/ellipse_gap.h"
#include "core/neighbors/pairs.h"
#include "mc/hard_core.h"

namespace vitrel::bench {

SequentialSampler::SequentialSampler(Configuration2& configuration, std::uint64_t seed)
    : configuration_(configuration),
      cells_(make_cells(configuration)),
      largest_(largest_circumradius(configuration)),
      margin_(hard_margin(configuration)),
      seed_(seed) {
  for (const double angle : configuration.angle) axis_.push_back(direction(angle));
}

void SequentialSampler::set_steps(double translation, double rotation) {
  translation_ = translation;
  rotation_ = rotation;
}

void SequentialSampler::sweep() {
  const std::size_t n = configuration_.size();
  for (std::size_t trial = 0; trial < n; ++trial) {
    Stream draw(seed_, Purpose::trial_moves, sweep_, trial);
    const std::size_t i = draw.below(n);
    if (!configuration_.shape[i].is_round() && draw.below(2) == 1)
      rotate(i, draw);
    else
      translate(i, draw);
  }
  ++sweep_;
}

void SequentialSampler::translate(std::size_t i, Stream& draw) {
  const double y = draw.uniform(-1, 1), x = draw.uniform(-1, 1);
  Vec2 position = configuration_.position[i] + translation_ * Vec2(x, y);
  Shift<2> crossed = Shift<2>::Zero();
  configuration_.box.wrap(position, crossed);
  ++counts_.translations_tried;
  if (!clear_of_others(i, position, axis_[i])) return;
  ++counts_.translations_accepted;
  configuration_.position[i] = position;
  configuration_.image[i] += crossed;
  cells_.move(i, position);
}

void SequentialSampler::rotate(std::size_t i, Stream& draw) {
  const double angle = configuration_.angle[i] + rotation_ * draw.uniform(-1, 1);
  const Vec2 axis = direction(angle);
  ++counts_.rotations_tried;
  if (!clear_of_others(i, configuration_.position[i], axis) ||
      !clear_of_periodic_images(configuration_.box, configuration_.shape[i], axis, margin_))
    return;
  ++counts_.rotations_accepted;
  configuration_.angle[i] = angle;
  axis_[i] = axis;
}

bool SequentialSampler::clear_of_others(std::size_t i, const Vec2& position, const Vec2& axis) {
  const Ellipse& shape = configuration_.shape[i];
  const double reach = shape.circumradius() + largest_ + margin_;
  return cells_.for_each_near(position, reach, [&](std::size_t j, const Shift<2>&, const Vec2& d) {
    if (j == i) return true;
    ++decisions_;
    return separated(shape, axis, configuration_.shape[j], axis_[j], d, margin_);
  });
}

}  // namespace vitrel::bench
