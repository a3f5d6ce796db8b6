#include <gtest/gtest.h>

#include <numbers>

#include "tests/manual/local_alignment_observable.h"

namespace vitrel {
namespace {

/// 4 × 4 ellipses, 2 apart.
Configuration2 alternating_columns() {
  constexpr std::size_t side = 4;
  Configuration2 c;
  c.resize(side * side);
  c.species_names = {"A"};
  c.box = PeriodicBox<2>(Vec2::Constant(2 * side));
  for (std::size_t i = 0; i < c.size(); ++i) {
    c.shape[i] = {0.9, 0.5};
    c.position[i] =
        Vec2(2. * static_cast<double>(i % side) - 3, 2. * static_cast<double>(i / side) - 3);
    c.angle[i] = i % 2 ? std::numbers::pi / 3 : 0;
  }
  return c;
}

std::vector<Table> measured(const Configuration2& frame) {
  const auto observable = local_alignment_observable().make(frame, {});
  observable->measure(frame)();
  return observable->tables(true);
}

// Every other column is turned by 60 degrees: of its four neighbours, a particle is parallel to the two
// in its column, and at 60 degrees to the two beside it, cos 120° = −1/2.
TEST(LocalAlignment, OfAlternatingColumns) {
  const std::vector<Table> tables = measured(alternating_columns());
  EXPECT_NEAR(tables.front().find("alignment")->value.front(), (2 - 2 * 0.5) / 4, 1e-12);
}

TEST(LocalAlignment, IsDescribed) {
  const FrameObservableType<2> type = local_alignment_observable();
  ASSERT_EQ(type.tables.size(), 1u);
  EXPECT_EQ(type.tables.front().table, measured(alternating_columns()).front().name);
}

}  // namespace
}  // namespace vitrel
