#include "core/whole_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace vitrel {
namespace {

TEST(WholeNumber, IsOneThatTheTypeRepresents) {
  EXPECT_EQ(whole_number<std::int64_t>(-3), -3);
  EXPECT_EQ(whole_number<std::int64_t>(-0x1p63), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(whole_number<std::int64_t>(0x1p63), std::nullopt);
  EXPECT_EQ(whole_number<std::uint64_t>(0x1p63), std::uint64_t{1} << 63);
  EXPECT_EQ(whole_number<std::uint64_t>(0x1p64), std::nullopt);
  EXPECT_EQ(whole_number<std::uint64_t>(-1), std::nullopt);
  EXPECT_EQ(whole_number<std::int32_t>(0x1p31 - 1), std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(whole_number<std::int32_t>(0x1p31), std::nullopt);
}

TEST(WholeNumber, IsNeitherAFractionNorInfiniteNorNan) {
  for (const double x : {0.5, -1.5, std::nextafter(1., 2.), HUGE_VAL, -HUGE_VAL, std::nan("")})
    EXPECT_EQ(whole_number<std::int64_t>(x), std::nullopt) << x;
}

}  // namespace
}  // namespace vitrel
