#pragma once

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <cstdlib>
#include <string>

#include "core/contact/contact_queries.h"
#include "core/contact/ellipse_vieillard_baron.h"
#include "core/contact/ellipsoid_eta.h"
#include "core/contact/perram_wertheim.h"
#include "core/random/stream.h"
#include "tests/support/posed_bodies.h"

/// This header calls and compares the three criteria of overlap in plane and space: the support gap,
/// Perram and Wertheim's function, and the signs of the characteristic polynomial.
namespace vitrel {

template <int Dim>
PerramWertheim<Dim> f_of(const PosedBodies<Dim>& p) {
  return perram_wertheim(p.one, p.turn1, p.two, p.turn2, p.d);
}
template <int Dim>
SupportGapOf<Dim> gap_of(const PosedBodies<Dim>& p) {
  return support_gap(p.one, p.pose1(), p.two, p.pose2(), p.d);
}
template <int Dim>
double contact_distance_of(const PosedBodies<Dim>& p) {
  return contact_distance(p.one, p.turn1, p.two, p.turn2, p.d);
}
inline VieillardBaron<double> psi_of(const PosedPair& p) {
  return vieillard_baron(p.one, p.turn1, p.two, p.turn2, p.d);
}
inline EllipsoidEta<double> eta_of(const PosedSolids& p) {
  return ellipsoid_eta(p.one, p.turn1, p.two, p.turn2, p.d);
}
inline bool disjoint_by_polynomial(const PosedPair& p) {
  return psi_of(p).disjoint();
}
inline bool disjoint_by_polynomial(const PosedSolids& p) {
  return eta_of(p).disjoint();
}

template <int Dim>
void expect_verdict(const PosedBodies<Dim>& pair, bool disjoint) {
  EXPECT_EQ(gap_of(pair).gap > 0, disjoint) << pair;
  EXPECT_EQ(f_of(pair).disjoint(), disjoint) << pair;
  EXPECT_EQ(disjoint_by_polynomial(pair), disjoint) << pair;
}

/// Returns the support function h(n) of a body.
inline double support_function(const Ellipse& body, double turn, const Vec2& n) {
  return support(body, direction(turn), n);
}
inline double support_function(const Ellipsoid& body, const Quaternion& turn, const Vec3& n) {
  return body.semi_axes.cwiseProduct(turn.conjugate() * n).norm();
}

/// Returns the distance of the surfaces to first order in it, (√F − 1)(h₁ + h₂).
template <int Dim>
double distance_by(const PerramWertheim<Dim>& f, const PosedBodies<Dim>& pair) {
  return (std::sqrt(f.value) - 1) * (support_function(pair.one, pair.turn1, f.normal) +
                                     support_function(pair.two, pair.turn2, f.normal));
}

/// Returns whether the support gap proves that the surfaces are closer than `margin`: as a distance
/// if they are disjoint; if they overlap, by the proof that a shift by `margin` along the normal
/// separates them.
template <int Dim>
bool closer_than(double margin, const PosedBodies<Dim>& pair, const Vec<Dim>& normal) {
  const double gap = gap_of(pair).gap;
  return gap > 0 ? gap < margin : gap_of(pair.with(pair.d + margin * normal)).gap > 0;
}

/// Returns how many pairs a test compares; the environment variable VITREL_CONTACT_PAIRS can raise
/// the number.
inline std::uint64_t pairs_to_compare(std::uint64_t otherwise) {
  const char* given = std::getenv("VITREL_CONTACT_PAIRS");
  return given ? std::stoull(given) : otherwise;
}

/// Returns F(λ) = λ(1 − λ) dᵀ((1 − λ)Σ₁ + λΣ₂)⁻¹d by its definition, with the matrices.
template <int Dim>
double f_by_definition(const PosedBodies<Dim>& pair, double lambda) {
  const auto sigma1 = shape_matrix(pair.one, pair.turn1);
  const auto sigma2 = shape_matrix(pair.two, pair.turn2);
  return lambda * (1 - lambda) *
         pair.d.dot(((1 - lambda) * sigma1 + lambda * sigma2).inverse() * pair.d);
}

/// Returns the λ at which F(λ) is largest, by 100 steps of golden section.
template <int Dim>
double lambda_by_golden_section(const PosedBodies<Dim>& pair) {
  double low = 0, high = 1;
  const double golden = (std::sqrt(5) - 1) / 2;
  for (int step = 0; step < 100; ++step) {
    const double left = high - golden * (high - low), right = low + golden * (high - low);
    f_by_definition(pair, left) < f_by_definition(pair, right) ? low = left : high = right;
  }
  return low;
}

/// Checks what F means: scaled by μ = √F about their centres the bodies touch, at `point` along
/// `normal`. The tolerances are those of the point relative to either centre, over μ.
template <int Dim>
void expect_touch_of_scaled_bodies(const PosedBodies<Dim>& pair, double from_first,
                                   double from_second) {
  const PerramWertheim<Dim> f = f_of(pair);
  const double mu = std::sqrt(f.value);
  EXPECT_NEAR(f.normal.norm(), 1, 1e-14);
  EXPECT_LT((f.point - mu * surface_point(pair.one, pair.pose1(), f.normal)).norm(),
            from_first * mu)
      << pair;
  EXPECT_LT((f.point - pair.d + mu * surface_point(pair.two, pair.pose2(), f.normal)).norm(),
            from_second * mu)
      << pair;
}

template <int Dim>
void expect_f_scales_with_the_square_of(const PosedBodies<Dim>& pair) {
  const double value = f_of(pair).value;
  for (const double factor : {1e-150, 1e-8, 0.5, 3.0, 1e8})
    EXPECT_NEAR(f_of(pair.with(factor * pair.d)).value / (factor * factor * value), 1, 1e-13);
}

/// Returns the distance along d at which `disjoint` turns from false to true, by bisection.
template <int Dim, class Disjoint>
double first_disjoint(const PosedBodies<Dim>& pair, Disjoint&& disjoint) {
  double low = 0, high = pair.extent() / pair.d.norm() + 1;
  for (int step = 0; step < 80; ++step) {
    const double middle = 0.5 * (low + high);
    (disjoint(pair.with(middle * pair.d)) ? high : low) = middle;
  }
  return high * pair.d.norm();
}

/// Checks the contact distance itself and by all three criteria.
template <int Dim>
void expect_contact_at(double distance, const PosedBodies<Dim>& pair, double tolerance) {
  EXPECT_NEAR(contact_distance_of(pair), distance, tolerance) << pair;
  const auto by_gap = [](const auto& p) { return gap_of(p).gap > 0; };
  const auto by_f = [](const auto& p) { return f_of(p).disjoint(); };
  const auto by_polynomial = [](const auto& p) { return disjoint_by_polynomial(p); };
  EXPECT_NEAR(first_disjoint(pair, by_gap), distance, tolerance) << pair;
  EXPECT_NEAR(first_disjoint(pair, by_f), distance, tolerance) << pair;
  EXPECT_NEAR(first_disjoint(pair, by_polynomial), distance, tolerance) << pair;
}

inline double log_uniform(Stream& draw, double low, double high) {
  return low * std::exp(draw.uniform() * std::log(high / low));
}

/// A pair is placed anywhere within the circumcircles (spheres), around the contact distance, or at
/// the contact distance times 1 ± 10⁻¹ … 10⁻¹⁵.
enum class Placement { anywhere, around_contact, near_contact };

inline Placement random_placement(Stream& draw) {
  return static_cast<Placement>(draw.below(3));
}

/// Places the second body in the direction e from the first.
template <int Dim>
PosedBodies<Dim> placed(const PosedBodies<Dim>& pair, Placement placement, const Vec<Dim>& e,
                        Stream& draw) {
  if (placement == Placement::anywhere) return pair.with(draw.uniform() * pair.extent() * e);
  const double contact = contact_distance_of(pair.with(e));
  if (placement == Placement::around_contact) return pair.with(draw.uniform(0, 2) * contact * e);
  const double offset = std::pow(10, -draw.uniform(1, 15));
  return pair.with(contact * (draw.uniform() < 0.5 ? 1 + offset : 1 - offset) * e);
}

}  // namespace vitrel
