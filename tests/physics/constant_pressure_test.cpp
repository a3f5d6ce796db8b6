// At the pressure P = ρZ of the tables the packing fraction is the table's.

#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <tuple>
#include <vector>

#include "bench/reference/literature.h"
#include "mc/pressure_sampler.h"
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

TableEntry entry(double aspect_ratio, double packing_fraction) {
  return {aspect_ratio, packing_fraction, fluid_pressure(aspect_ratio, packing_fraction).z, 0.001};
}

INSTANTIATE_TEST_SUITE_P(
    Tables, ConstantPressure,
    testing::Combine(testing::Values(entry(1, 0.5), entry(2, 0.5), entry(4, 0.4), entry(6, 0.3)),
                     testing::Values(BoxChange::isotropic, BoxChange::anisotropic)),
    name_of);

}  // namespace
}  // namespace vitrel
