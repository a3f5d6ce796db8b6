#include "core/random/stream.h"

#include <Random123/philox.h>

#include <cmath>
#include <numbers>

#include "core/elementary.h"

namespace vitrel {

Stream::Stream(std::uint64_t seed, Purpose purpose, std::uint64_t step, std::uint64_t particle)
    : key_{seed, static_cast<std::uint64_t>(purpose)}, counter_{0, step, particle, 0} {}

Stream::Block Stream::next_block() {
  const r123::Philox4x64::ctr_type counter{{counter_[0], counter_[1], counter_[2], counter_[3]}};
  const r123::Philox4x64::key_type key{{key_[0], key_[1]}};
  const auto words = r123::Philox4x64{}(counter, key);
  ++counter_[0];
  return {words[0], words[1], words[2], words[3]};
}

std::uint64_t Stream::bits() {
  if (used_ == 4) {
    words_ = next_block();
    used_ = 0;
  }
  return words_[used_++];
}

void Stream::fill(std::span<Block> blocks) {
  for (Block& block : blocks) block = next_block();
  used_ = 4;
}

double Stream::uniform() {
  return static_cast<double>(bits() >> 11) * 0x1p-53;
}

std::uint64_t Stream::below(std::uint64_t n) {
  // The incomplete last run of n values is rejected, so that every value is equally likely.
  const std::uint64_t excess = (UINT64_MAX % n + 1) % n;
  std::uint64_t word = bits();
  while (word > UINT64_MAX - excess) word = bits();
  return word % n;
}

double Stream::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_normal_;
  }
  const double radius = std::sqrt(-2 * logarithm(1 - uniform()));
  const auto [cosine, sine] = cosine_and_sine(2 * std::numbers::pi * uniform());
  spare_normal_ = radius * sine;
  has_spare_ = true;
  return radius * cosine;
}

}  // namespace vitrel
