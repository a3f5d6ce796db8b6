// Steps of Brownian dynamics are compared with the size of the particles.
#include "workflow/run/run_cost.h"

#include <gmock/gmock.h>

#include "core/state/species.h"
#include "core/state/typical_scales.h"

namespace vitrel {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// Ellipses of this size.
Configuration2 particles(double size) {
  Species species;
  species.name = std::string("A");
  species.aspect_ratio = Distribution{.mean = 2};
  species.size = Distribution{.mean = size};
  return draw_particles<2>({species}, 10, 0.3, Vec2::Ones(), 1);
}

TEST(BrownianStep, IsInSizesOfATypicalParticle) {
  EXPECT_NEAR(0.3 / typical_time(particles(1)), 0.3, 1e-12);
  // The density is the same, so that the mass grows with the area: √(m a b/kT) = 4.
  EXPECT_NEAR(0.3 / typical_time(particles(2)), 0.075, 1e-12);
}

TEST(BrownianStep, IsWarnedOfWhereItIsLong) {
  EXPECT_THAT(long_step_text(0.1, typical_time(particles(1))), IsEmpty());
  EXPECT_THAT(long_step_text(0.3, typical_time(particles(1))), HasSubstr("flies 0.3 of its size"));
  EXPECT_THAT(long_step_text(0.3, typical_time(particles(2))), IsEmpty());
  EXPECT_THAT(long_step_text(0.03, typical_time(particles(0.3))),
              HasSubstr("0.009 is right within 3 %"));
}

}  // namespace
}  // namespace vitrel
