// Every operation on a batch against the same on each number.

#include "core/contact/simd.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

#include "core/random/stream.h"
#include "core/special_values.h"

namespace vitrel {
namespace {

template <class Batch>
struct SimdTest : testing::Test {
  static constexpr int lanes = sizeof(Batch) / sizeof(double);

  // Pairs of numbers, among them zeros of both signs, infinities and what is not a number.
  void SetUp() override {
    std::vector<double> values = {0., -0., 1., -1., infinity, -infinity, std::nan("")};
    Stream draw(1, Purpose::tests);
    while (values.size() % lanes != 0 || values.size() < 24) values.push_back(draw.uniform(-3, 3));
    for (const double one : values)
      for (const double two : values) {
        left_.push_back(one);
        right_.push_back(two);
      }
  }

  // op(batch, batch) must give in each lane what scalar(number, number) gives, signs of zeros included.
  template <class Op, class Scalar>
  void expect_same(Op op, Scalar scalar) const {
    for (std::size_t i = 0; i < left_.size(); i += lanes) {
      const auto result = op(Batch::load(&left_[i]), Batch::load(&right_[i]));
      for (int k = 0; k < lanes; ++k) {
        const double a = left_[i + static_cast<std::size_t>(k)];
        const double b = right_[i + static_cast<std::size_t>(k)];
        const double expected = scalar(a, b), found = result[k];
        if (std::isnan(expected)) {
          ASSERT_TRUE(std::isnan(found)) << a << ' ' << b;
        } else {
          ASSERT_EQ(found, expected) << a << ' ' << b;
          ASSERT_EQ(std::signbit(found), std::signbit(expected)) << a << ' ' << b;
        }
      }
    }
  }

 private:
  std::vector<double> left_, right_;
};

using Batches = testing::Types<SimdPair, Simd<4>, Simd<8>>;
TYPED_TEST_SUITE(SimdTest, Batches);

TYPED_TEST(SimdTest, Arithmetic) {
  const auto test = [&](auto op) { this->expect_same(op, op); };
  test(std::plus<>());
  test(std::minus<>());
  test(std::multiplies<>());
  test(std::divides<>());
  test([](const auto& x, const auto& y) { return 1. - 2 * x + y * 0.5; });
  test([](const auto& x, const auto&) { return -x; });
}

TYPED_TEST(SimdTest, Functions) {
  using std::abs, std::copysign, std::sqrt;  // beside those of batches
  const auto test = [&](auto op) { this->expect_same(op, op); };
  test([](auto x, auto) { return sqrt(x); });
  test([](auto x, auto) { return abs(x); });
  test([](auto x, auto y) { return copysign(x, y); });
  this->expect_same([](auto x, auto y) { return min(x, y); },
                    [](double x, double y) { return x < y ? x : y; });
  this->expect_same([](auto x, auto y) { return max(x, y); },
                    [](double x, double y) { return x > y ? x : y; });
}

TYPED_TEST(SimdTest, Masks) {
  using Batch = TypeParam;
  const auto chosen = [](auto condition) {
    return [condition](const auto& x, const auto& y) {
      if constexpr (std::is_same_v<std::decay_t<decltype(x)>, double>)
        return condition(x, y) ? x : y;
      else
        return select(condition(x, y), x, y);
    };
  };
  const auto test = [&](auto condition) {
    this->expect_same(chosen(condition), chosen(condition));
  };
  test(std::less<>());
  test(std::less_equal<>());
  test(std::greater<>());
  test(std::greater_equal<>());
  test(std::equal_to<>());
  test([](const auto& x, const auto& y) { return !(x < y) && x > 0.; });
  test([](const auto& x, const auto& y) { return x < y || y < 0.; });

  constexpr int count = TestFixture::lanes;
  double numbers[count];
  for (int k = 0; k < count; ++k) numbers[k] = k;
  const Batch indices = Batch::load(numbers);
  EXPECT_TRUE(all_of(indices >= 0));
  EXPECT_FALSE(all_of(indices > 0));
  EXPECT_TRUE(none_of(indices > count));
  EXPECT_FALSE(none_of(indices == count - 1));
  EXPECT_TRUE(any_of(indices == count - 1));
  EXPECT_FALSE(any_of(indices < 0));
  EXPECT_TRUE(all_of(SimdMask<count>(true)));
  EXPECT_TRUE(none_of(SimdMask<count>(false)));
  for (int k = 0; k < count; ++k) {
    EXPECT_EQ((indices == k).bits(), 1u << k);
    EXPECT_EQ(find_first_set(indices >= k), k);
    EXPECT_TRUE((indices == k)[k]);
    EXPECT_FALSE((!(indices == k))[k]);
  }
}

TYPED_TEST(SimdTest, SmallestLaneSumAndStore) {
  constexpr int count = TestFixture::lanes;
  for (int smallest = 0; smallest < count; ++smallest) {
    double numbers[count], copy[count];
    for (int k = 0; k < count; ++k) numbers[k] = 1 + std::abs(k - smallest);
    const TypeParam batch = TypeParam::load(numbers);
    EXPECT_EQ(hmin(batch), 1);
    EXPECT_EQ(reduce(batch), std::accumulate(numbers, numbers + count, 0.));
    batch.store(copy);
    EXPECT_TRUE(std::ranges::equal(numbers, copy));
  }
}

TEST(SimdPair, HoldsItsTwoNumbers) {
  const SimdPair pair(2, -3);
  EXPECT_EQ(pair[0], 2);
  EXPECT_EQ(pair[1], -3);
}

// At all sizes, also where multiples of π are subtracted, and beyond.
TYPED_TEST(SimdTest, Directions) {
  constexpr int count = TestFixture::lanes;
  constexpr double close = 4 * std::numeric_limits<double>::epsilon();
  Stream draw(2, Purpose::tests);
  for (int trial = 0; trial < 100'000; ++trial) {
    const double size = std::pow(10, draw.uniform(-3, 7));
    double angle[count], small[count];
    for (double& one : angle) one = draw.uniform(-size, size);
    for (double& one : small) one = draw.uniform(-max_small_angle, max_small_angle);
    TypeParam x, y, small_x, small_y;
    directions<TypeParam>(TypeParam::load(angle), x, y);
    small_angle_directions<TypeParam>(TypeParam::load(small), small_x, small_y);
    for (int k = 0; k < count; ++k) {
      ASSERT_NEAR(x[k], std::cos(angle[k]), close) << angle[k];
      ASSERT_NEAR(y[k], std::sin(angle[k]), close) << angle[k];
      ASSERT_NEAR(small_x[k], std::cos(small[k]), close) << small[k];
      ASSERT_NEAR(small_y[k], std::sin(small[k]), close) << small[k];
    }
  }
}

}  // namespace
}  // namespace vitrel
