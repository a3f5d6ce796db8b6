#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "core/random/stream.h"

namespace vitrel {
namespace {

TEST(Stream, EqualKeysGiveEqualNumbers) {
  Stream one(42, Purpose::tests, 3, 5);
  Stream two(42, Purpose::tests, 3, 5);
  for (int draw = 0; draw < 100; ++draw) EXPECT_EQ(one.bits(), two.bits());
}

TEST(Stream, AnyDifferenceInTheKeyGivesAnotherStream) {
  std::set<std::uint64_t> first_words;
  for (std::uint64_t seed : {0, 1})
    for (auto purpose : {Purpose::velocities, Purpose::brownian_step})
      for (std::uint64_t step : {0, 1})
        for (std::uint64_t particle : {0, 1})
          first_words.insert(Stream(seed, purpose, step, particle).bits());
  EXPECT_EQ(first_words.size(), 16u);
}

TEST(Stream, BlocksAreItsWordsFourByFour) {
  Stream one(42, Purpose::tests, 3, 5), two = one;
  std::array<Stream::Block, 3> blocks{};
  one.fill(blocks);
  for (const Stream::Block& block : blocks)
    for (const std::uint64_t word : block) EXPECT_EQ(word, two.bits());
  EXPECT_EQ(one.bits(), two.bits());
  one.fill(blocks);  // skips three words
  for (int skipped = 0; skipped < 3; ++skipped) two.bits();
  EXPECT_EQ(blocks[0][0], two.bits());
}

// Sample moments of n draws: each has a standard error of (its own deviation)/√n; five of them are a
// false alarm of 6e-7 per moment.
TEST(Stream, UniformAndNormalHaveTheirMoments) {
  Stream draw(11, Purpose::tests);
  const int n = 400'000;
  double u1 = 0, u2 = 0, z1 = 0, z2 = 0, z4 = 0;
  for (int k = 0; k < n; ++k) {
    const double u = draw.uniform();
    const double z = draw.normal();
    u1 += u, u2 += u * u, z1 += z, z2 += z * z, z4 += z * z * z * z;
  }
  const double root = std::sqrt(n);
  EXPECT_NEAR(u1 / n, 0.5, 5 * std::sqrt(1.0 / 12) / root);
  EXPECT_NEAR(u2 / n, 1.0 / 3, 5 * std::sqrt(4.0 / 45) / root);
  EXPECT_NEAR(z1 / n, 0, 5 / root);
  EXPECT_NEAR(z2 / n, 1, 5 * std::sqrt(2) / root);
  EXPECT_NEAR(z4 / n, 3, 5 * std::sqrt(96) / root);
}

TEST(Stream, BelowIsUniform) {
  Stream draw(12, Purpose::tests);
  const int n = 120'000;
  int counts[6] = {};
  for (int k = 0; k < n; ++k) ++counts[draw.below(6)];
  double chi_squared = 0;
  for (int count : counts) chi_squared += std::pow(count - n / 6.0, 2) / (n / 6.0);
  EXPECT_LT(chi_squared, 25.7);  // 5 degrees of freedom, false alarm 1e-4
}

}  // namespace
}  // namespace vitrel
