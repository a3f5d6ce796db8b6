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
  // Its own images move along: their distance stays a whole number of box lengths.
  if (!clear_of_others(i, configuration_.shape[i], position, axis_[i], margin_)) return;
  ++counts_.translations_accepted;
  configuration_.box.wrap(position, configuration_.image[i]);
  configuration_.position[i] = position;
  cells_.move(i, {position});
}

void Sampler::rotate(std::size_t i, Stream& draw) {
  const double angle = configuration_.angle[i] + rotation_ * draw.uniform(-1, 1);
  const Vec2 axis = direction(angle);
  ++counts_.rotations_tried;
  const Ellipse& shape = configuration_.shape[i];
  if (!clear_of_others(i, shape, configuration_.position[i], axis, margin_) ||
      !clear_of_own_images(configuration_.box, shape, axis, margin_))
    return;
  ++counts_.rotations_accepted;
  configuration_.angle[i] = angle;
  axis_[i] = axis;
}

bool Sampler::reshape(std::size_t i, const Ellipse& shape) {
  const double margin = 2 * margin_;
  if (!clear_of_others(i, shape, configuration_.position[i], axis_[i], margin) ||
      !clear_of_own_images(configuration_.box, shape, axis_[i], margin))
    return false;
  configuration_.shape[i] = shape;
  largest_ = std::max(largest_, shape.circumradius());
  return true;
}

bool Sampler::clear_of_others(std::size_t i, const Ellipse& shape, const Vec2& position,
                              const Vec2& axis, double margin) const {
  const double reach = shape.circumradius() + largest_ + margin;
  return cells_.for_each_near(position, reach, [&](std::size_t j, const Shift<2>&, const Vec2& d) {
    return j == i || separated(shape, axis, configuration_.shape[j], axis_[j], d, margin);
  });
}

namespace {

/// Trials of one kind that tell its acceptance to about 0.05.
constexpr std::uint64_t trials_to_tune = 100;

double adapted(double step, double largest, std::uint64_t tried, std::uint64_t accepted) {
  const double acceptance = static_cast<double>(accepted) / static_cast<double>(tried);
  constexpr double wanted = 0.35, strongest = 2;
  return std::min(largest, step * std::clamp(acceptance / wanted, 1 / strongest, strongest));
}

}  // namespace

void Sampler::tune() {
  const std::uint64_t translations = counts_.translations_tried - tuned_at_.translations_tried;
  if (translations >= trials_to_tune) {
    translation_ =
        adapted(translation_, 0.5 * configuration_.box.lengths().minCoeff(), translations,
                counts_.translations_accepted - tuned_at_.translations_accepted);
    tuned_at_.translations_tried = counts_.translations_tried;
    tuned_at_.translations_accepted = counts_.translations_accepted;
  }
  const std::uint64_t rotations = counts_.rotations_tried - tuned_at_.rotations_tried;
  if (rotations >= trials_to_tune) {
    rotation_ = adapted(rotation_, std::numbers::pi / 2, rotations,
                        counts_.rotations_accepted - tuned_at_.rotations_accepted);
    tuned_at_.rotations_tried = counts_.rotations_tried;
    tuned_at_.rotations_accepted = counts_.rotations_accepted;
  }
}

}  // namespace vitrel
