// At the pressure P = ρZ of the tables the packing fraction is the table's.

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>
#include <tuple>

#include "bench/reference/literature.h"
#include "mc/pressure_sampler.h"
#include "tests/support/fluids.h"
#include "tests/support/visited_states.h"

namespace vitrel {
namespace {

struct TableEntry {
  double aspect_ratio, packing_fraction, compressibility;
  double table_error;  // relative, of φ
};

Estimate mean_packing_fraction(Configuration2& c, double pressure, BoxChange change) {
  PressureSampler sampler(c, pressure, change, 3);
  sweep_and_tune(sampler, 2000, 20);
  constexpr int sweeps = 8000;  // in which volumes forget each other
  const auto measure = [&] { return std::array{packing_fraction(c)}; };
  return estimate(block_means(
      24, sweeps, [&] { sampler.sweep(); }, measure)[0]);
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
