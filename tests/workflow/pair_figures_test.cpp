// The tables of `vitrel pair path` and of `vitrel pair restitution --scaled-table` and `--paths`.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/special_values.h"
#include "edmd/soft/linear_dashpot.h"
#include "edmd/soft/viscoelastic.h"
#include "workflow/report/pair_figures.h"

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

const std::vector<double>& values(const FigurePage& page, const std::string& column) {
  return page.results.tables.front().find(column)->value;
}

// --- the path of a pair -----------------------------------------------------------------------------------

/// Appendix B.1 of the thesis.
const Pair<2> thesis{{{1, 0.5}, {{0, 0}, 0}, {{0, 0}, 0}},
                     {{1, 0.5}, {{1, 1}, 0}, {{-1, 0}, pi}},
                     std::nullopt,
                     100};
constexpr double first_touch = 0.08472238582199765;

// Centres meet within the sum of the semi-major axes, 2, until (1 − t)² + 1 = 4.
TEST(PathOfPair, OfTheThesisTouchesWherePsiChangesItsSign) {
  EXPECT_NEAR(usual_end(thesis), 1 + std::sqrt(3), 1e-14);
  const FigurePage page = path_of_pair(thesis, 2, 2001);
  ASSERT_EQ(page.results.tables[1].rows(), 1u);
  EXPECT_NEAR(page.results.tables[1].columns[0].value[0], first_touch, 1e-13);
  EXPECT_EQ(page.figures[0].mark->second, "first contact, t = 0.084722");
  for (std::size_t k = 0; k < 900; ++k) {
    const bool apart = values(page, "time")[k] < first_touch;
    for (const char* name : {"psi", "gap", "d"}) EXPECT_EQ(values(page, name)[k] > 0, apart) << k;
  }
  const PairGap<2> at = gap_at(thesis, first_touch);
  EXPECT_NEAR(at.criterion.psi, 0, 1e-11);
  EXPECT_LT(at.criterion.g1, 0);
  EXPECT_NEAR(unit_circle_distance(thesis, first_touch), 0, 1e-14);
}

// At t = 1 both touch again from inside the overlap: d = −c (t − 1)² + O((t − 1)³), and the same of Ψ.
TEST(PathOfPair, OfTheThesisOsculatesAtOne) {
  const auto psi = [](double time) { return gap_at(thesis, time).criterion.psi; };
  const auto d = [](double time) { return unit_circle_distance(thesis, time); };
  EXPECT_NEAR(d(1), 0, 1e-14);
  EXPECT_NEAR(psi(1), 0, 1e-12);
  for (const double h : {1e-3, -1e-3}) {
    EXPECT_LT(d(1 + h), -1e-7);
    EXPECT_NEAR(d(1 + 2 * h) / d(1 + h), 4, 0.01);
    EXPECT_NEAR(psi(1 + 2 * h) / psi(1 + h), 4, 0.01);
  }
}

// Equal circles at the distance D = √x R: Ψ = G⁴ − 8G³ + 18G² − 27 with G = 3 − x, that is x³ (x − 4).
TEST(PathOfPair, OfCirclesIsTheClosedForm) {
  const double radius = 0.7;
  const Pair<2> circles{{{radius, radius}, {{0, 0}, 0.3}, {{0.5, 0}, 2}},
                        {{radius, radius}, {{3, 1}, 0}, {{-0.5, 0}, 0}},
                        std::nullopt,
                        100};
  EXPECT_NEAR(usual_end(circles), 3 + std::sqrt(4 * radius * radius - 1), 1e-14);
  const FigurePage page = path_of_pair(circles, 6, 61);
  for (std::size_t k = 0; k < 61; ++k) {
    const double time = 0.1 * static_cast<double>(k), distance = std::hypot(3 - time, 1);
    const double x = distance * distance / (radius * radius);
    EXPECT_NEAR(values(page, "time")[k], time, 1e-14);
    EXPECT_NEAR(values(page, "gap")[k], distance - 2 * radius, 1e-14);
    EXPECT_NEAR(values(page, "psi")[k], x * x * x * (x - 4), 1e-12 * x * x * x * x + 1e-12);
    EXPECT_NEAR(values(page, "g_1")[k], 3 - x, 1e-13 * x);
    EXPECT_NEAR(values(page, "d")[k], distance / radius - 2, 1e-14 * x);
    EXPECT_NEAR(values(page, "touching_scale")[k], distance / (2 * radius), 1e-14 * x);
  }
}

/// From the boundary of ellipse 2, sampled and refined about the nearest sample, where ellipse 1 is the unit circle.
double sampled_distance(const Flight<Ellipse>& one, const Flight<Ellipse>& two) {
  const auto turned = [](const Vec2& v, double angle) -> Vec2 {
    return {std::cos(angle) * v.x() - std::sin(angle) * v.y(),
            std::sin(angle) * v.x() + std::cos(angle) * v.y()};
  };
  const auto distance = [&](double t) {
    const Vec2 on_two =
        two.pose.position +
        turned({two.body.a * std::cos(t), two.body.b * std::sin(t)}, two.pose.angle);
    const Vec2 seen = turned(on_two - one.pose.position, -one.pose.angle);
    return std::hypot(seen.x() / one.body.a, seen.y() / one.body.b);
  };
  double nearest = 0, spacing = 2 * pi / 3600;
  for (int k = 1; k < 3600; ++k)
    if (distance(k * spacing) < distance(nearest)) nearest = k * spacing;
  for (; spacing > 1e-9; spacing *= 0.5)
    for (const double t : {nearest - spacing, nearest + spacing})
      if (distance(t) < distance(nearest)) nearest = t;
  const Vec2 centre = turned(one.pose.position - two.pose.position, -two.pose.angle);
  const bool holds_origin = std::hypot(centre.x() / two.body.a, centre.y() / two.body.b) < 1;
  return (holds_origin ? -distance(nearest) : distance(nearest)) - 1;
}

TEST(PathOfPair, DistanceFromTheUnitCircleIsThatOfTheNearestPoint) {
  std::mt19937_64 random(1);
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto ellipse = [&]() -> Flight<Ellipse> {
    const double a = number(0.3, 2), b = a * number(0.1, 1), x = number(-2, 2), y = number(-2, 2);
    return {{a, b}, {{x, y}, number(0, pi)}, {Vec2::Zero(), 0}};
  };
  for (int k = 0; k < 100; ++k) {
    const Pair<2> pair{ellipse(), ellipse(), std::nullopt, 1};
    const double d = unit_circle_distance(pair, 0);
    EXPECT_NEAR(d, sampled_distance(pair.one, pair.two), 1e-11) << k;
    EXPECT_EQ(d < 0, gap_at(pair, 0).overlap) << k;
  }
}

TEST(PathOfPair, InABoxIsOfTheClosestImage) {
  Pair<2> pair{{{1, 1}, {{0, 0}, 0}, {{0, 0}, 0}},
               {{1, 1}, {{3, 0}, 0}, {{1, 0}, 0}},
               PeriodicBox<2>(Vec2(10, 10)),
               100};
  EXPECT_NEAR(usual_end(pair), 9, 1e-9);  // the image at −7 passes
  const FigurePage page = path_of_pair(pair, 9, 10);
  for (std::size_t k = 0; k < 10; ++k) {
    const double x = 3 + static_cast<double>(k), nearest = std::min(x, std::abs(x - 10));
    EXPECT_NEAR(values(page, "gap")[k], nearest - 2, 1e-13);
    EXPECT_NEAR(values(page, "d")[k], nearest - 2, 1e-13);
  }
  EXPECT_NEAR(page.results.tables[1].columns[0].value.at(0), 5, 1e-12);
}

TEST(PathOfPair, WithoutAContactHasNoMark) {
  Pair<2> pair = thesis;
  pair.two.pose.position.y() = 5;
  EXPECT_EQ(usual_end(pair), 2);  // twice the time of the closest approach
  const FigurePage page = path_of_pair(pair, 2, 5);
  EXPECT_EQ(page.results.tables[1].rows(), 0u);
  EXPECT_FALSE(page.figures[0].mark);
  pair.two.motion.velocity = {0, 1};
  EXPECT_EQ(usual_end(pair), 2);  // a turn
  pair.two.motion.angular_velocity = 0;
  EXPECT_EQ(usual_end(pair), 1);
  pair.two.motion.velocity = {0, -1e-200};  // whose square vanishes
  EXPECT_EQ(usual_end(pair), 1);
}

// In space η₁ > 0 as long as they are apart.
TEST(PathOfPair, InSpaceHasTheDiscriminant) {
  const Pair<3> pair{
      {{{1, 0.5, 0.3}}, {}, {}},
      {{{1, 0.5, 0.7}}, {{1, 1, 0}, Quaternion::Identity()}, {{-1, 0, 0}, {0, 1, pi}}},
      std::nullopt,
      100};
  const FigurePage page = path_of_pair(pair, 0.2, 101);
  const double contact = page.results.tables[1].columns[0].value.at(0);
  for (std::size_t k = 0; k < 101; ++k) {
    EXPECT_EQ(values(page, "eta_1")[k] > 0, values(page, "time")[k] < contact) << k;
    EXPECT_EQ(values(page, "gap")[k] > 0, values(page, "time")[k] < contact) << k;
  }
}

// --- the scaled table -------------------------------------------------------------------------------------

ScaledImpact impact_in_row(const FigurePage& page, std::size_t row) {
  return {std::exp(values(page, "ln_l")[row]), std::exp(values(page, "ln_c_phi")[row]),
          values(page, "c_dis")[row]};
}

void expect_coefficients(const FigurePage& page, std::size_t row, const Restitution& expected) {
  EXPECT_NEAR(values(page, "angle")[row], expected.angle, 1e-9 * expected.angle);
  EXPECT_NEAR(values(page, "rate")[row], expected.rate, 1e-9);
  EXPECT_NEAR(values(page, "distance")[row], expected.distance, 1e-9);
  EXPECT_NEAR(values(page, "duration")[row], expected.duration, 1e-9 * expected.duration);
}

constexpr std::size_t lattice = 41 * 41;

// Equal spheres of table 1 of the source: corners of the rectangle are corners of the material.
TEST(ScaledMaps, OfTheLinearDashpotAreThoseOfTheSource) {
  const FigurePage page = scaled_maps(ContactParameters::Law::linear_dashpot);
  ASSERT_EQ(values(page, "angle").size(), 6 * lattice);
  ASSERT_EQ(page.figures.size(), 25u);
  for (std::size_t row = 0; row < 6 * lattice; row += 173) {
    expect_coefficients(page, row, integrate_contact<LinearDashpot>(impact_in_row(page, row)));
    EXPECT_EQ(values(page, "c_dis")[row] == 0, row < lattice);
  }
  const auto mass = [](double radius, double density) {
    return 4 * pi / 3 * std::pow(radius, 3) * density;
  };
  // The softest, heaviest, fastest and the hardest, lightest, slowest; the last row has e = 0.99.
  const LinearDashpot soft{1e3}, hard{1e6};
  const double large = mass(0.1, 3250), small = mass(0.001, 250);
  const ScaledImpact lowest =
      scaled_impact(soft, contact_pair(0.1, large, 0.1, large), 25 * std::sqrt(1 - 1e-4), 0.25);
  const ScaledImpact highest = scaled_impact(hard, contact_pair(0.001, small, 0.001, small),
                                             0.001 * std::sqrt(1 - 0.9801), 0.00099);
  EXPECT_NEAR(values(page, "ln_l")[0], std::log(lowest.distance), 0.05);
  EXPECT_NEAR(values(page, "ln_c_phi")[0], std::log(lowest.angular_momentum), 0.05);
  EXPECT_NEAR(values(page, "ln_l")[lattice - 1], std::log(highest.distance), 0.01);
  EXPECT_NEAR(values(page, "ln_c_phi")[lattice - 1], std::log(highest.angular_momentum), 0.01);
}

// ln c_dis/c_dis^min is 0 for the least A and v over l, whatever else the impact is.
TEST(ScaledMaps, OfViscoelasticSpheresAreThoseOfTheSource) {
  const FigurePage page = scaled_maps(ContactParameters::Law::viscoelastic);
  for (std::size_t row = 0; row < 6 * lattice; row += 173)
    expect_coefficients(page, row, integrate_contact<Viscoelastic>(impact_in_row(page, row)));
  for (std::size_t row = lattice; row < 6 * lattice; row += 173) {
    const ScaledImpact at = impact_in_row(page, row);
    const double tangent = at.angular_momentum / at.distance;
    // c_dis = 3A/(2T), T = X/(v cos), l̃ = l/X: 3Av/(2l) = c_dis/(l̃ cos).
    const double c = std::log(at.damping / at.distance * std::sqrt(1 + tangent * tangent));
    EXPECT_NEAR(values(page, "ln_c_dis_over_min")[row], c - std::log(1.5e-6 * 0.001 / 0.2), 0.01);
  }
}

// --- paths of an impact -----------------------------------------------------------------------------------

Impact figure_6() {
  Impact impact;
  impact.contact.law = ContactParameters::Law::linear_dashpot;
  impact.contact.linear_dashpot = {2000, 0};
  impact.speed = 5;
  impact.impact_parameter = 0.3;
  impact.second_radius = 0.1;
  return impact;
}

/// The velocity between the last two rows, in units of `speed`.
double velocity(const FigurePage& page, const std::string& column, double speed) {
  const std::vector<double>&x = values(page, column), &t = values(page, "time");
  const std::size_t last = x.size() - 1;
  return (x[last] - x[last - 1]) / (t[last] - t[last - 1]) / speed;
}

/// The rule of soft spheres is exact from the end of the contact on, here to the error of the integration.
void expect_soft_is_integrated(const FigurePage& page, double tolerance) {
  for (std::size_t k = 0; k < values(page, "time").size(); ++k) {
    const double instant = values(page, "instant")[k];
    for (const char* centre : {"x_1", "y_1", "x_2", "y_2"}) {
      const std::string name = centre;
      if (instant < 0 || instant >= 7) {
        EXPECT_NEAR(values(page, "soft_" + name)[k], values(page, "integrated_" + name)[k],
                    tolerance);
      }
      if (instant < 0) {
        EXPECT_EQ(values(page, "hard_" + name)[k], values(page, "integrated_" + name)[k]);
      }
    }
  }
}

// Velocities after the contact as in params/soft_pair.toml; of hard spheres they are v/4 along x, and v/2 along y less
// v (n·v) n with n = (0.3, √0.91).
TEST(ImpactPaths, AreThoseOfTheSource) {
  const FigurePage page = impact_paths(figure_6());
  ASSERT_EQ(values(page, "time").size(), 131u);
  EXPECT_NEAR(values(page, "time").back(), 0.07318852 * 10 / 7, 1e-8);
  EXPECT_EQ(values(page, "instant")[30], 0);
  EXPECT_NEAR(values(page, "hard_x_1")[30], -0.03, 1e-16);
  EXPECT_NEAR(values(page, "hard_y_2")[30], 0.1 * std::sqrt(0.91), 1e-16);
  expect_soft_is_integrated(page, 1e-9);
  for (const std::string way : {"integrated", "soft"}) {
    EXPECT_NEAR(velocity(page, way + "_x_1", 5), -0.11139609, 1e-8);
    EXPECT_NEAR(velocity(page, way + "_y_1", 5), 0.34553273, 1e-8);
    EXPECT_NEAR(velocity(page, way + "_x_2", 5), 0.61139609, 1e-8);
    EXPECT_NEAR(velocity(page, way + "_y_2", 5), -0.34553273, 1e-8);
  }
  EXPECT_NEAR(velocity(page, "hard_x_1", 5), 0.25 - 0.3 * std::sqrt(0.91), 1e-12);
  EXPECT_NEAR(velocity(page, "hard_y_1", 5), 0.5 - 0.91, 1e-12);
}

TEST(ImpactPaths, OfDampedUnlikeSpheresKeepTheCentreOfMass) {
  Impact impact = figure_6();
  impact.second_radius = 0.15;
  impact.contact.linear_dashpot.damping = 20;
  expect_soft_is_integrated(impact_paths(impact), 1e-8);
  impact.contact.law = ContactParameters::Law::viscoelastic;
  impact.contact.viscoelastic = {1e5, 0.4, 1e-3};
  const FigurePage page = impact_paths(impact);
  expect_soft_is_integrated(page, 1e-8);
  const double mass_ratio = std::pow(1.5, 3);
  for (const std::string way : {"integrated", "hard", "soft"})
    for (std::size_t k = 0; k < values(page, "time").size(); ++k) {
      const double x = values(page, way + "_x_1")[k] + mass_ratio * values(page, way + "_x_2")[k];
      EXPECT_NEAR(x / (1 + mass_ratio), 1.25 * values(page, "time")[k], 1e-15);
      EXPECT_NEAR(values(page, way + "_y_1")[k] + mass_ratio * values(page, way + "_y_2")[k], 0,
                  1e-15);
    }
}

}  // namespace
}  // namespace vitrel
