// At the pressure P = ρZ of the tables the packing fraction is the table's.

#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <tuple>
#include <vector>

#include "mc/compression.h"
#include "tests/support/fluids.h"
#include "tests/support/statistics.h"

namespace vitrel {
namespace {

struct TableEntry {
  double aspect_ratio, packing_fraction, compressibility;
  double table_error;  // relative, of φ
};

Estimate mean_packing_fraction(Configuration2& c, double pressure, BoxChange change) {
  PressureSampler sampler(c, pressure, change, 3);
  for (int sweep = 0; sweep < 2000; ++sweep) {
    sampler.sweep();
    if (sweep % 20 == 19) sampler.tune();
  }
  std::vector<double> means;
  for (int block = 0; block < 24; ++block) {
    double sum = 0;
    constexpr int sweeps = 8000;  // in which volumes forget each other
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      sampler.sweep();
      sum += packing_fraction(c);
    }
    means.push_back(sum / sweeps);
  }
  return estimate(means);
}

using Case = std::tuple<TableEntry, BoxChange>;
class ConstantPressure : public testing::TestWithParam<Case> {};

TEST_P(ConstantPressure, GivesThePackingFractionOfTheTable) {
  const auto& [entry, change] = GetParam();
  Configuration2 c = swollen_fluid(100, entry.aspect_ratio, entry.packing_fraction);
  const double density = entry.packing_fraction / c.shape[0].volume();
  const Estimate found = mean_packing_fraction(c, density * entry.compressibility, change);
  std::printf("kappa %g: phi %.5f(%.5f), table %g\n", entry.aspect_ratio, found.mean, found.error,
              entry.packing_fraction);
  EXPECT_NEAR(found.mean, entry.packing_fraction,
              3 * found.error + entry.table_error * entry.packing_fraction);
  EXPECT_LT(found.error, 0.003 * entry.packing_fraction);
}

std::string name_of(const testing::TestParamInfo<Case>& at) {
  const auto& [entry, change] = at.param;
  return "kappa_" + std::to_string(static_cast<int>(entry.aspect_ratio)) +
         (change == BoxChange::isotropic ? "_isotropic" : "_anisotropic");
}

// Disks: Kolafa & Rottner (2006); ellipses: Monte Carlo at constant volume, N ≈ 400, good to 0.1 %.
INSTANTIATE_TEST_SUITE_P(Tables, ConstantPressure,
                         testing::Combine(testing::Values(TableEntry{1, 0.5, 4.106364, 0.001},
                                                          TableEntry{2, 0.5, 4.492, 0.001},
                                                          TableEntry{4, 0.4, 3.757, 0.001},
                                                          TableEntry{6, 0.3, 3.0335, 0.001}),
                                          testing::Values(BoxChange::isotropic,
                                                          BoxChange::anisotropic)),
                         name_of);

}  // namespace
}  // namespace vitrel
