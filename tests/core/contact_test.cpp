// Three criteria of overlap of ellipses agree with one another and with closed forms.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <string>

#include "core/random/stream.h"
#include "tests/support/overlap_criteria.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

Vec2 unit(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

/// κ of both 1…50, ratio of their sizes √(ab) 1…100 either way round, any orientation.
PosedPair random_bodies(Stream& draw) {
  const auto ellipse = [&](double size) -> Ellipse {
    const double root = std::sqrt(log_uniform(draw, 1, 50));
    return {size * root, size / root};
  };
  const double ratio = log_uniform(draw, 1, 100);
  const bool larger_first = draw.uniform() < 0.5;
  return {ellipse(larger_first ? ratio : 1), ellipse(larger_first ? 1 : ratio),
          draw.uniform(-pi, pi), draw.uniform(-pi, pi), Vec2::Zero()};
}

/// Gives each placement to a third of the pairs.
PosedPair random_pair(Stream& draw) {
  const PosedPair bodies = random_bodies(draw);
  const Vec2 e = unit(draw.uniform(-pi, pi));
  const Placement placement = random_placement(draw);
  return placed(bodies, placement, e, draw);
}

// A verdict may differ only if the surfaces are closer than 1e-9 b, both by the support gap and by Perram
// and Wertheim's function.
TEST(OverlapCriteria, ThreeCriteriaAgreeOnRandomPairs) {
  Stream draw(1, Purpose::tests);
  const std::uint64_t pairs = pairs_to_compare(1'000'000);
  std::uint64_t overlapping = 0, close = 0, blurred = 0;
  double largest_blurred = 0;
  for (std::uint64_t k = 0; k < pairs; ++k) {
    const PosedPair pair = random_pair(draw);
    const PerramWertheim<2> f = f_of(pair);
    const bool disjoint = gap_of(pair).gap > 0;
    const double b = std::min(pair.one.b, pair.two.b);
    const double distance = std::abs(distance_by(f, pair));
    overlapping += !disjoint;
    close += distance < 1e-6 * b;
    if (disjoint == f.disjoint() && disjoint == psi_of(pair).disjoint()) continue;
    ++blurred;
    largest_blurred = std::max(largest_blurred, distance / b);
    ASSERT_TRUE(closer_than(1e-9 * b, pair, f.normal)) << pair;
    ASSERT_LT(distance, 1e-9 * b) << pair;
  }
  RecordProperty("blurred", std::to_string(blurred));
  RecordProperty("largest_blurred_gap_over_1e-12_b", std::to_string(largest_blurred * 1e12));
  // The comparison means something: both verdicts are frequent, and many pairs nearly touch.
  EXPECT_GT(overlapping, pairs * 2 / 5);
  EXPECT_LT(overlapping, pairs * 4 / 5);
  EXPECT_GT(close, pairs / 20);
}

// The same with sizes and shapes as they are in one system, where nearly all rounding is gone.
TEST(OverlapCriteria, OrdinaryPairsAgreeDownToRounding) {
  Stream draw(2, Purpose::tests);
  for (int k = 0; k < 100'000; ++k) {
    const double kappa = draw.uniform(1, 6);
    const PosedPair pair{
        {kappa, 1}, {kappa, 1}, draw.uniform(-pi, pi), draw.uniform(-pi, pi), Vec2::Zero()};
    const Vec2 e = unit(draw.uniform(-pi, pi));
    const double offset = std::pow(10, -draw.uniform(1, 13));
    const double contact = contact_distance_of(pair.with(e));
    for (double sign : {-1, 1})
      expect_verdict(pair.with(contact * (1 + sign * offset) * e), sign > 0);
  }
}

TEST(VieillardBaron, PositivePsiAloneIsWrongForCrossedAndContainedEllipses) {
  const PosedPair pairs[] = {{{2, 1}, {2, 1}, 0, pi / 2, {0, 0}},
                             {{6, 1}, {6, 1}, 0.3, 1.6, {0.5, 0.4}},
                             {{50, 1}, {3, 0.1}, 0, 1.2, {30, 0.5}},
                             {{4, 3}, {1, 0.5}, 0.2, 1.4, {1, 0.3}},
                             {{1, 0.5}, {40, 30}, 0.2, 1.4, {3, -5}}};
  for (const PosedPair& pair : pairs) {
    EXPECT_GT(psi_of(pair).psi, 0) << pair;
    expect_verdict(pair, false);
  }
}

// The source of the complete criterion: of random pairs of equal ellipses closer than 2a, Ψ > 0
// alone is wrong for 5 % at κ = 2 and 13 % at κ = 6, quoted to half a per cent (d uniform in the
// disk of radius 2a; 10⁵ pairs: a standard error of 0.001, so four of them are within 0.5 %).
TEST(VieillardBaron, FrequencyOfWrongVerdictsWithoutTheSigns) {
  for (const auto& [kappa, expected] : {std::pair{2.0, 0.05}, std::pair{6.0, 0.13}}) {
    Stream draw(3, Purpose::tests);
    const int pairs = 100'000;
    int wrong = 0;
    for (int k = 0; k < pairs; ++k) {
      const double distance = 2 * kappa * std::sqrt(draw.uniform());
      const PosedPair pair{
          {kappa, 1}, {kappa, 1}, 0, draw.uniform(0, pi), distance * unit(draw.uniform(-pi, pi))};
      const VieillardBaron<double> contact = psi_of(pair);
      wrong += (contact.psi > 0) != contact.disjoint();
    }
    EXPECT_NEAR(wrong / static_cast<double>(pairs), expected, 0.005 + 0.004) << "κ = " << kappa;
  }
}

// G₁ = G₂ = 1 + tr(Σ₁A₂) at d = 0, with tr(Σ₁A₂) = 2 + (a/b − b/a)² sin²(θ₁ − θ₂).
TEST(VieillardBaron, TraceOfEqualEllipses) {
  Stream draw(4, Purpose::tests);
  for (int k = 0; k < 1000; ++k) {
    const double a = draw.uniform(1, 50);
    const double angle1 = draw.uniform(-pi, pi), angle2 = draw.uniform(-pi, pi);
    const double sine = std::sin(angle1 - angle2);
    const double trace = 2 + (a - 1 / a) * (a - 1 / a) * sine * sine;
    const VieillardBaron<double> contact = psi_of({{a, 1}, {a, 1}, angle1, angle2, {0, 0}});
    EXPECT_NEAR(contact.g1, 1 + trace, 1e-12 * a * a);
    EXPECT_NEAR(contact.g2, 1 + trace, 1e-12 * a * a);
  }
}

// tr(Σ₁A₂), dᵀAd and q from the matrices themselves.
TEST(VieillardBaron, EqualsTheMatrixFormula) {
  Stream draw(5, Purpose::tests);
  for (int k = 0; k < 1000; ++k) {
    const PosedPair pair{{draw.uniform(1, 3), draw.uniform(0.5, 1)},
                         {draw.uniform(1, 3), draw.uniform(0.5, 1)},
                         draw.uniform(-pi, pi),
                         draw.uniform(-pi, pi),
                         {draw.uniform(-3, 3), draw.uniform(-3, 3)}};
    const Mat2 sigma1 = shape_matrix(pair.one, pair.turn1);
    const Mat2 sigma2 = shape_matrix(pair.two, pair.turn2);
    const Mat2 a1 = sigma1.inverse(), a2 = sigma2.inverse();
    const double g1 = 1 + (sigma1 * a2).trace() - pair.d.dot(a2 * pair.d);
    const double g2 = 1 + (sigma2 * a1).trace() - pair.d.dot(a1 * pair.d);
    const double q = sigma2.determinant() / sigma1.determinant();
    const double psi =
        g1 * g1 * g2 * g2 + 18 * g1 * g2 - 4 * q * std::pow(g1, 3) - 4 * std::pow(g2, 3) / q - 27;
    const double scale = 1 + g1 * g1 * g2 * g2 + std::abs(4 * q * std::pow(g1, 3)) +
                         std::abs(4 * std::pow(g2, 3) / q);
    EXPECT_NEAR(psi_of(pair).psi, psi, 1e-11 * scale) << pair;
    EXPECT_NEAR(psi_of(pair).g1, g1, 1e-11 * (1 + std::abs(g1) + (sigma1 * a2).trace()));
    EXPECT_NEAR(psi_of(pair).g2, g2, 1e-11 * (1 + std::abs(g2) + (sigma2 * a1).trace()));
  }
}

// Equal disks: with s = (d/R)², G = 3 − s and Ψ = s³(s − 4); touching is exactly Ψ = 0.
TEST(VieillardBaron, EqualDisksInClosedForm) {
  for (double d : {0.5, 1.0, 1.5, 2.0, 2.5, 4.0}) {
    const double s = d * d;
    const auto contact = psi_of({{1, 1}, {1, 1}, 0, 0, {d, 0}});
    EXPECT_DOUBLE_EQ(contact.psi, s * s * s * (s - 4));
    EXPECT_EQ(contact.disjoint(), d > 2);
    EXPECT_EQ(contact.disjoint_or_touching(), d >= 2);
  }
}

TEST(PerramWertheim, ValueIsTheMaximumOfTheDefinition) {
  Stream draw(6, Purpose::tests);
  for (int k = 0; k < 2000; ++k) {
    const PosedPair pair{{draw.uniform(1, 5), draw.uniform(0.5, 1)},
                         {draw.uniform(1, 5), draw.uniform(0.5, 1)},
                         draw.uniform(-pi, pi),
                         draw.uniform(-pi, pi),
                         {draw.uniform(-8, 8), draw.uniform(-8, 8)}};
    const PerramWertheim<2> found = f_of(pair);
    const double best = lambda_by_golden_section(pair);
    EXPECT_NEAR(found.value, f_by_definition(pair, best), 1e-12 * found.value) << pair;
    EXPECT_NEAR(found.lambda, best, 1e-6) << pair;
    EXPECT_NEAR(f_by_definition(pair, found.lambda), found.value, 1e-12 * found.value) << pair;
  }
}

TEST(PerramWertheim, NormalAndPointBelongToBothScaledEllipses) {
  Stream draw(7, Purpose::tests);
  for (int k = 0; k < 100'000; ++k) {
    const PosedPair pair = random_pair(draw);
    if (pair.d.norm() < 1e-3) continue;
    const double extent = std::max(pair.one.a, pair.two.a);
    expect_touch_of_scaled_bodies(pair, 1e-13 * extent, 2e-11 * extent);
  }
}

TEST(PerramWertheim, ScalesWithTheSquareOfTheSeparation) {
  expect_f_scales_with_the_square_of(PosedPair{{3, 1}, {2, 0.5}, 0.4, 2, {1.5, -2.5}});
}

TEST(PerramWertheim, CoincidingCentresOverlap) {
  const PerramWertheim<2> f = f_of(PosedPair{{3, 1}, {2, 0.5}, 0.4, 2, {0, 0}});
  EXPECT_EQ(f.value, 0);
  EXPECT_FALSE(f.disjoint());
}

TEST(OverlapCriteria, ExchangingTheEllipsesChangesNothing) {
  Stream draw(8, Purpose::tests);
  for (int k = 0; k < 100'000; ++k) {
    const PosedPair pair = random_pair(draw);
    const VieillardBaron<double> psi = psi_of(pair), psi_swapped = psi_of(pair.swapped());
    EXPECT_EQ(psi.g1, psi_swapped.g2) << pair;
    EXPECT_EQ(psi.g2, psi_swapped.g1) << pair;
    const PerramWertheim<2> f = f_of(pair), f_swapped = f_of(pair.swapped());
    EXPECT_NEAR(f.value, f_swapped.value, 1e-13 * f.value) << pair;
    const double gap = gap_of(pair).gap;
    if (gap > 0) {
      EXPECT_NEAR(gap, gap_of(pair.swapped()).gap, 1e-13 * pair.extent()) << pair;
    }
  }
}

// F determines λ and the normal only as far as it is curved, so this holds for ordinary shapes.
TEST(PerramWertheim, ExchangingTheEllipsesTurnsTheNormal) {
  Stream draw(9, Purpose::tests);
  for (int k = 0; k < 10'000; ++k) {
    const PosedPair pair{{draw.uniform(1, 3), 1},
                         {draw.uniform(1, 3), 1},
                         draw.uniform(-pi, pi),
                         draw.uniform(-pi, pi),
                         {draw.uniform(2, 6), draw.uniform(-6, 6)}};
    const PerramWertheim<2> f = f_of(pair), swapped = f_of(pair.swapped());
    EXPECT_NEAR(f.lambda + swapped.lambda, 1, 1e-12) << pair;
    EXPECT_LT((f.normal + swapped.normal).norm(), 1e-12) << pair;
    EXPECT_LT((f.point - pair.d - swapped.point).norm(), 1e-11) << pair;
  }
}

// Two ellipses with (a, b) = (2, 1); independent computation, the second and third in closed form.
TEST(ContactDistance, ReferenceValuesByAllThreeCriteria) {
  const struct {
    double angle1, angle2, direction, distance;
  } cases[] = {{0, 0, 30, 3.023715784073818},
               {0, 90, 0, 3},
               {0, 90, 45, std::sqrt(10)},
               {0, 45, 0, 3.335855487022610},
               {30, 100, 20, 2.955140520703047}};
  for (const auto& c : cases) {
    const PosedPair pair{
        {2, 1}, {2, 1}, c.angle1 * pi / 180, c.angle2 * pi / 180, unit(c.direction * pi / 180)};
    expect_contact_at(c.distance, pair, 1e-12);
  }
}

// At contact: the point lies on both ellipses xᵀ Σ⁻¹ x = 1, and there the gradients of both sides point along ±n.
TEST(ContactDistance, NormalAndPointAtContact) {
  Stream draw(10, Purpose::tests);
  for (int k = 0; k < 10'000; ++k) {
    PosedPair pair{{draw.uniform(1, 6), 1},
                   {draw.uniform(0.5, 3), 0.5},
                   draw.uniform(-pi, pi),
                   draw.uniform(-pi, pi),
                   unit(draw.uniform(-pi, pi))};
    pair.d *= contact_distance_of(pair);
    const PerramWertheim<2> f = f_of(pair);
    EXPECT_NEAR(f.value, 1, 1e-13) << pair;
    const Vec2 other = f.point - pair.d;
    const Vec2 first = shape_matrix(pair.one, pair.turn1).inverse() * f.point;
    const Vec2 second = shape_matrix(pair.two, pair.turn2).inverse() * other;
    EXPECT_NEAR(f.point.dot(first), 1, 1e-12) << pair;
    EXPECT_NEAR(other.dot(second), 1, 1e-11) << pair;
    EXPECT_LT((first.normalized() - f.normal).norm(), 1e-12) << pair;
    EXPECT_LT((second.normalized() + f.normal).norm(), 1e-10) << pair;
    // The support gap has a normal only where it is positive.
    const SupportGap apart = gap_of(pair.with(pair.d * (1 + 1e-12)));
    EXPECT_LT((apart.normal - f.normal).norm(), 1e-9) << pair;
  }
}

}  // namespace
}  // namespace vitrel
