// The sampler and its plain baseline: two orders of trials and two ways to decide, one distribution.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "bench/baselines/sequential_sampler.h"
#include "core/state/check.h"
#include "mc/contact_pressure.h"
#include "mc/sampler.h"
#include "tests/support/fluids.h"
#include "tests/support/statistics.h"

namespace vitrel::bench {
namespace {

Configuration2 fluid(double aspect_ratio, double packing_fraction) {
  Configuration2 c = swollen_fluid(256, aspect_ratio, packing_fraction);
  Sampler sampler(c, 2);
  for (int k = 0; k < 1000; ++k) sampler.sweep();
  return c;
}

template <class AnySampler>
Estimate compressibility(Configuration2 c) {
  AnySampler sampler(c, 11);
  sampler.set_steps(0.6, 0.8);
  std::vector<double> values;
  ContactPressure pressure;
  for (int block = 0; block < 30; ++block) {
    for (int sample = 0; sample < 100; ++sample) {
      for (int sweep = 0; sweep < 4; ++sweep) sampler.sweep();
      pressure.add(c);
    }
    values.push_back(pressure.compressibility());
    pressure.clear();
  }
  EXPECT_TRUE(exact_check(c).clean());
  return estimate(values);
}

// κ = 2, φ = 0.5: Z = 4.492(3), another 0.1 % allowed (oracle: NVT Monte Carlo). 3 standard errors, as
// between the two.
TEST(SamplerBaseline, HasTheSamePressure) {
  const Configuration2 start = fluid(2, 0.5);
  const Estimate ours = compressibility<Sampler<2>>(start);
  const Estimate plain = compressibility<SequentialSampler>(start);
  for (const Estimate& z : {ours, plain}) {
    EXPECT_LT(z.error, 0.02);
    EXPECT_NEAR(z.mean, 4.492, 3 * std::hypot(z.error, 0.003) + 0.0045);
  }
  EXPECT_NEAR(ours.mean, plain.mean, 3 * std::hypot(ours.error, plain.error));
}

}  // namespace
}  // namespace vitrel::bench
