#include "bench/surveys/ellipsoid_suite.h"

#include <algorithm>
#include <array>
#include <functional>

#include "bench/methods/opening.h"
#include "bench/surveys/drawn_class.h"
#include "bench/surveys/verdict.h"

namespace vitrel::bench {
namespace {

using Solid = Flight<GrowingEllipsoid>;

Vec3 thermal_turning(Stream& draw, const Ellipsoid& shape, const Quaternion& orientation) {
  return orientation * thermal_vector(draw).cwiseQuotient(shape.inertia_per_mass().cwiseSqrt());
}

Solid thermal(Stream& draw, const Ellipsoid& shape) {
  const Quaternion q = any_orientation(draw);
  const Vec3 velocity = thermal_vector(draw);
  return {{shape, 1, 0}, {Vec3::Zero(), q}, {velocity, thermal_turning(draw, shape, q)}};
}

Solid any_body(Stream& draw, double kappa) {
  const Ellipsoid shape = any_shape(draw, kappa);
  return thermal(draw, shape);
}

EllipsoidCase thermal_pair(Stream& draw, double kappa) {
  return {any_body(draw, kappa), any_body(draw, kappa), usual_horizon};
}

/// Only the rotation of scalene bodies differs.
template <EllipsoidCase (*draw_pair)(Stream&, double)>
EllipsoidCase tumbling(Stream& draw, double kappa) {
  EllipsoidCase pair = draw_pair(draw, kappa);
  let_tumble(pair);
  return pair;
}

bool disjoint_at(const EllipsoidCase& pair, double time) {
  return perram_wertheim_at(pair, time).disjoint();
}

/// Puts the second body around the first until the two are disjoint, as in two dimensions.
EllipsoidCase placed_apart(Stream& draw, EllipsoidCase pair, double nearest, double farthest) {
  do {
    const double distance = draw.uniform(nearest, farthest) * pair.reach();
    pair.two.pose.position = pair.one.pose.position + distance * any_direction(draw);
  } while (!disjoint_at(pair, 0));
  return pair;
}

/// The support function of a body of size 1 along n: surface point and rate.
struct Support {
  Vec3 point;
  double rate;
};
Support support(const Solid& flight, const Vec3& n) {
  const Vec3 along = shape_matrix(flight.body.shape, flight.pose.orientation) * n;
  const Vec3 point = along / std::sqrt(n.dot(along));
  return {point, -point.dot(flight.motion.angular_velocity.cross(n))};
}

/// How two bodies stand and move when their surfaces are closest, `gap` apart along n, with this approach
/// speed: shifts the second body and corrects its velocity along n.
void bring_together(EllipsoidCase& pair, const Vec3& n, double gap, double approach) {
  const Support s1 = support(pair.one, n), s2 = support(pair.two, n);
  pair.two.pose.position = pair.one.pose.position + s1.point + s2.point + gap * n;
  const double relative = (pair.two.motion.velocity - pair.one.motion.velocity).dot(n);
  pair.two.motion.velocity += (s1.rate + s2.rate - approach - relative) * n;
}

/// d²/dt² of the gap by its second difference.
double gap_acceleration(const EllipsoidCase& pair) {
  constexpr double step = 1e-3;
  const auto gap = [&](double time) { return gap_at(pair, time); };
  return static_cast<double>((gap(step) - 2 * gap(0) + gap(-step)) / (step * step));
}

/// The same as happen_at, also of pairs that tumble.
void delay(EllipsoidCase& pair, double time) {
  if (!pair.tumbles()) return happen_at(pair, time);
  for (const int body : {0, 1}) {
    Solid& flight = body == 0 ? pair.one : pair.two;
    flight.pose = pose_at(pair, body, -time);
    flight.motion.angular_velocity = pair.tumbling[body].top.at(-time).angular_velocity;
  }
  let_tumble(pair);
}

EllipsoidCase generic(Stream& draw, double kappa) {
  const EllipsoidCase pair = thermal_pair(draw, kappa);
  return placed_apart(draw, pair, 0.2, 1.2);
}

template <bool tumble>
EllipsoidCase grazing(Stream& draw, double kappa) {
  constexpr double widest = 1e-3;
  constexpr int samples = 64;
  const double wanted = signed_log_uniform(draw, 1e-12, widest);
  while (true) {
    EllipsoidCase pair = thermal_pair(draw, kappa);
    const Vec3 n = any_direction(draw);
    const double when = draw.uniform(0.1, 0.9) * usual_horizon;
    bring_together(pair, n, widest * pair.gap_unit(), 0);
    if (tumble) let_tumble(pair);
    if (gap_acceleration(pair) < 0.1 * pair.gap_unit()) continue;
    EllipsoidCase probe = pair;
    delay(probe, when);
    bool disjoint = true;
    for (int k = 0; k < samples && disjoint; ++k)
      disjoint = disjoint_at(probe, k * usual_horizon / samples);
    if (!disjoint) continue;
    bring_together(pair, n, wanted * pair.gap_unit(), 0);
    if (tumble) let_tumble(pair);
    delay(pair, when);
    return pair;
  }
}

EllipsoidCase fast_rotation(Stream& draw, double kappa) {
  EllipsoidCase pair = thermal_pair(draw, kappa);
  for (Solid* flight : {&pair.one, &pair.two}) {
    const Vec3 axis = any_direction(draw);
    flight->motion.angular_velocity = draw.uniform(10, 60) * axis;
  }
  return placed_apart(draw, pair, 0.5, 1.4);
}

EllipsoidCase drawn_aspect_ratios(Stream& draw, double largest) {
  const auto body = [&] {
    const double kappa = log_uniform(draw, 1, largest);
    return any_body(draw, kappa);
  };
  return {body(), body(), usual_horizon};
}

EllipsoidCase aspect_ratios(Stream& draw, double largest) {
  const EllipsoidCase pair = drawn_aspect_ratios(draw, largest);
  return placed_apart(draw, pair, 0.2, 1.2);
}

EllipsoidCase sizes(Stream& draw, double largest) {
  EllipsoidCase pair = drawn_aspect_ratios(draw, largest);
  Ellipsoid& small = pair.two.body.shape;
  small = scaled(small, log_uniform(draw, 1e-3, 1));
  return placed_apart(draw, pair, 0.2, 1.2);
}

EllipsoidCase touching_leaving(Stream& draw, double kappa) {
  while (true) {
    EllipsoidCase pair = thermal_pair(draw, kappa);
    const double wanted = draw.uniform(0.25, 1.25) * pair.contact_gap();
    const double speed = std::abs(std::sqrt(2.0) * draw.normal());
    bring_together(pair, any_direction(draw), wanted, -speed);
    // What the stored doubles say.
    const auto gap = static_cast<double>(gap_at(pair, 0));
    if (gap >= 0.25 * pair.contact_gap() && gap <= 1.25 * pair.contact_gap()) return pair;
  }
}

EllipsoidCase parallel_congruent(Stream& draw, double kappa) {
  EllipsoidCase pair = thermal_pair(draw, kappa);
  pair.two.body = pair.one.body;
  pair.two.pose.orientation = pair.one.pose.orientation;
  pair.two.motion.angular_velocity = pair.one.motion.angular_velocity;
  return placed_apart(draw, pair, 0.2, 1.2);
}

EllipsoidCase growth(Stream& draw, double kappa) {
  EllipsoidCase pair = thermal_pair(draw, kappa);
  let_grow(draw, pair);
  return placed_apart(draw, pair, 0.2, 1.4);
}

/// The axes in the order of their moments.
std::array<int, 3> by_moment(const Ellipsoid& shape) {
  std::array<int, 3> axes{0, 1, 2};
  std::ranges::sort(axes, std::greater<>{}, [&](int k) { return shape.semi_axes[k]; });
  return axes;
}

/// Both bodies scalene, with angular velocities along their own axes as drawn by `spin`.
template <class Spin>
EllipsoidCase scalene_pair(Stream& draw, double kappa, const Spin& spin) {
  EllipsoidCase pair = thermal_pair(draw, kappa);
  for (Solid* flight : {&pair.one, &pair.two}) {
    const double middle = std::pow(kappa, draw.uniform(0.1, 0.9));
    Ellipsoid& shape = flight->body.shape;
    shape = {Vec3(kappa, middle, 1) / std::cbrt(kappa * middle)};
    flight->motion.angular_velocity = flight->pose.orientation * spin(shape);
  }
  return placed_apart(draw, pair, 0.2, 1.2);
}

/// How far from the uniform rotation or the separatrix, relative to the angular velocity.
double small_deviation(Stream& draw) {
  return signed_log_uniform(draw, 1e-12, 1e-1);
}

EllipsoidCase nearly_uniform(Stream& draw, double kappa) {
  return scalene_pair(draw, kappa, [&](const Ellipsoid& shape) -> Vec3 {
    const auto axis = static_cast<int>(draw.below(3));
    const double speed = draw.normal() / std::sqrt(shape.inertia_per_mass()[axis]);
    Vec3 omega = any_direction(draw);
    omega *= speed * small_deviation(draw);
    omega[axis] = speed;
    return omega;
  });
}

/// L² = 2EI₂: I₃(I₃ − I₂) ω₃² = I₁(I₂ − I₁) ω₁², whatever ω₂.
EllipsoidCase near_separatrix(Stream& draw, double kappa) {
  return scalene_pair(draw, kappa, [&](const Ellipsoid& shape) -> Vec3 {
    const auto [one, two, three] = by_moment(shape);
    const Vec3 moments = shape.inertia_per_mass();
    Vec3 omega = thermal_vector(draw).cwiseQuotient(moments.cwiseSqrt());
    const double ratio = moments[one] * (moments[two] - moments[one]) /
                         (moments[three] * (moments[three] - moments[two]));
    omega[three] = sign(draw) * std::sqrt(ratio) * omega[one];
    omega[three] *= 1 + small_deviation(draw);
    return omega;
  });
}

}  // namespace

std::vector<CaseClassOf<3>> ellipsoid_suite() {
  DrawnClasses<3> classes;
  classes.add("generic", "random close pairs with thermal velocities", generic, {2, 10});
  classes.add("grazing",
              "the minimum gap within the horizon is between ±1e-12 and ±1e-3 shortest semi-axes; "
              "if negative, there are two close roots",
              grazing<false>, {2, 10});
  classes.add("fast_rotation",
              "angular velocities of 10 to 60, so that the gap has many minima within the horizon",
              fast_rotation, {2, 10});
  classes.add("aspect_ratios", "aspect ratios log-uniform from 1 to 100, drawn for each body",
              aspect_ratios, {100});
  classes.add("sizes", "size ratios log-uniform from 1 to 1000, aspect ratios from 1 to 100", sizes,
              {100});
  classes.add("growth", "bodies grow or shrink while they rotate, some from a point", growth,
              {2, 10});
  classes.add("touching_leaving",
              "initial gap 1/4 to 5/4 of that of a declared contact, separating", touching_leaving,
              {2, 10});
  classes.add("parallel_congruent",
              "bodies of the same shape, parallel and rotating alike, as a body and its image: η₁ "
              "= 0 at all times",
              parallel_congruent, {2, 10});
  classes.add("tumbling", "random close pairs that tumble by Euler's equations", tumbling<generic>,
              {2, 20});
  classes.add("tumbling_grazing", "as grazing, of pairs that tumble", grazing<true>, {2, 20});
  classes.add("tumbling_fast", "as fast_rotation, of pairs that tumble", tumbling<fast_rotation>,
              {2, 20});
  classes.add("tumbling_leaving", "as touching_leaving, of pairs that tumble",
              tumbling<touching_leaving>, {2, 20});
  classes.add("tumbling_nearly_uniform",
              "angular velocities along a principal axis up to a relative deviation between 1e-12 "
              "and 0.1, the unstable axis as often as the others",
              tumbling<nearly_uniform>, {2, 20});
  classes.add("tumbling_near_separatrix",
              "L² = 2EI₂ up to a relative deviation of ω₃ between 1e-12 and 0.1",
              tumbling<near_separatrix>, {2, 20});
  return classes.list();
}

EllipsoidCase passing_pair(double depth) {
  const auto solid = [](const Vec3& semi_axes, const Vec3& position,
                        const Vec3& velocity) -> Solid {
    return {{{semi_axes}, 1, 0}, {position, Quaternion::Identity()}, {velocity, Vec3::Zero()}};
  };
  return {solid({2, 1, 1.2}, {0, 0, 0}, {0, 0, 0}),
          solid({1.5, 1, 0.8}, {3, 2 - depth, 0}, {-1, 0, 0}), 5.12};
}

}  // namespace vitrel::bench
