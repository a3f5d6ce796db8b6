// Random sequential insertion slows down by a known power law; extrapolated to infinite time it gives
// the saturation of the literature.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "mc/insertion.h"
#include "tests/support/equal_bodies.h"

namespace vitrel {
namespace {

/// The time τ at which insertion reaches this packing fraction.
double time_to(double aspect_ratio, double packing_fraction) {
  Configuration2 c = equal_bodies<2>(40'000, of_aspect_ratio(aspect_ratio));
  const InsertionReport report = insert_particles(c, {packing_fraction, 100'000'000}, 1, {});
  EXPECT_EQ(report.end, StageEnd::reached);
  return static_cast<double>(report.trials) * c.shape[0].volume() / c.box.volume();
}

/// φ∞ from the least-squares line φ = φ∞ − c τ^(−power).
double saturation(double aspect_ratio, double power, const std::vector<double>& fractions) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const double y : fractions) {
    const double x = std::pow(time_to(aspect_ratio, y), -power);
    std::printf("kappa %g: phi %.4f at tau %.4g\n", aspect_ratio, y, std::pow(x, -1 / power));
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const auto n = static_cast<double>(fractions.size());
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  return (sy - slope * sx) / n;
}

// Disks: φ∞ = 0.54707.
TEST(InsertionKinetics, DisksSaturateWhereTheLiteratureSays) {
  const double found = saturation(1, 0.5, {0.525, 0.53, 0.535});
  std::printf("saturation of disks: %.4f\n", found);
  EXPECT_NEAR(found, 0.54707, 0.01 * 0.54707);
}

}  // namespace
}  // namespace vitrel
