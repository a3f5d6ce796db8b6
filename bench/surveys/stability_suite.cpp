#include "bench/surveys/stability_suite.h"

#include <cmath>
#include <numbers>

#include "bench/reference/true_gap.h"
#include "bench/surveys/drawn_class.h"
#include "core/contact/ellipse_vieillard_baron.h"

namespace vitrel::bench {

namespace {

constexpr double pi = std::numbers::pi;

Vec2 unit(double angle) {
  return {std::cos(angle), std::sin(angle)};
}
double any_angle(Stream& draw) {
  return draw.uniform(-pi, pi);
}

// kT = 1 and mass 1.
Vec2 thermal_velocity(Stream& draw) {
  const double x = draw.normal();
  return {x, draw.normal()};
}
double thermal_turning(Stream& draw, const Ellipse& ellipse) {
  return draw.normal() / std::sqrt(ellipse.inertia_per_mass());
}

/// A body of constant size at the origin with thermal velocities, turned at random.
Flight<GrowingEllipse> thermal(Stream& draw, const Ellipse& ellipse) {
  const double angle = any_angle(draw);
  const Vec2 velocity = thermal_velocity(draw);
  return {{ellipse, 1, 0}, {{0, 0}, angle}, {velocity, thermal_turning(draw, ellipse)}};
}

CollisionCase thermal_pair(Stream& draw, const Ellipse& e1, const Ellipse& e2) {
  const auto one = thermal(draw, e1);
  return {one, thermal(draw, e2), usual_horizon};
}

VieillardBaron<double> contact_function(const CollisionCase& pair, double time) {
  const auto body = [&](const GrowingEllipse& of) {
    const double size = std::max(of.size_at(time), 1e-9);  // a point has none
    return Ellipse{of.shape.a * size, of.shape.b * size};
  };
  const Vec2 d = pair.two.pose.position - pair.one.pose.position +
                 (pair.two.motion.velocity - pair.one.motion.velocity) * time;
  const auto angle = [&](const Flight<GrowingEllipse>& of) {
    return of.pose.angle + of.motion.angular_velocity * time;
  };
  return vieillard_baron(body(pair.one.body), angle(pair.one), body(pair.two.body), angle(pair.two),
                         d);
}

bool disjoint_at_start(const CollisionCase& pair) {
  return contact_function(pair, 0).disjoint();
}

bool disjoint_at_samples(const CollisionCase& pair, double until, int samples) {
  for (int k = 0; k < samples; ++k)
    if (!contact_function(pair, k * until / samples).disjoint()) return false;
  return true;
}

/// Puts the second body around `origin`, where the first one goes, until the two are disjoint: the
/// distance of the centres uniform between nearest and farthest times a₁ + a₂, every direction.
CollisionCase placed_apart(Stream& draw, CollisionCase pair, double nearest, double farthest,
                           const Vec2& origin = {0, 0}) {
  const double reach = pair.one.body.shape.a + pair.two.body.shape.a;
  pair.one.pose.position = origin;
  do {
    const double distance = draw.uniform(nearest, farthest) * reach;
    pair.two.pose.position = origin + distance * unit(any_angle(draw));
  } while (!disjoint_at_start(pair));
  return pair;
}

CollisionCase close_pair(Stream& draw, const Ellipse& e1, const Ellipse& e2) {
  const CollisionCase pair = thermal_pair(draw, e1, e2);
  return placed_apart(draw, pair, 0.2, 1.2);
}

/// Support function of an ellipse of constant size and its derivatives with the angle of n.
struct Support {
  double h, slope, second, curvature;
  Vec2 point;  ///< of the surface, where n is the outward normal
};
Support support(const Flight<GrowingEllipse>& flight, double normal_angle) {
  const auto& [a, b] = flight.body.shape;
  const Vec2 u = unit(flight.pose.angle), across(-u.y(), u.x()), n = unit(normal_angle);
  const double c = n.dot(u), s = n.dot(across);
  const double h = std::hypot(a * c, b * s);
  const double curvature = a * a * b * b / (h * h * h);
  return {h, -(a - b) * (a + b) * c * s / h, curvature - h, curvature,
          (a * a * c * u + b * b * s * across) / h};
}

/// How two bodies stand and move when their surfaces are closest, `gap` apart, the normal at
/// `normal_angle` and the approach speed as given: shifts the second body and corrects its
/// velocity along the normal. Tangent surfaces at a distance along their common normal are closest
/// there, because both are convex.
void bring_together(CollisionCase& pair, double normal_angle, double gap, double approach) {
  const Support s1 = support(pair.one, normal_angle), s2 = support(pair.two, normal_angle);
  const Vec2 n = unit(normal_angle);
  pair.two.pose.position = pair.one.pose.position + s1.point + s2.point + gap * n;
  // The support advances by turning: ∂h/∂t = −ω h'.
  const double advance =
      -pair.one.motion.angular_velocity * s1.slope - pair.two.motion.angular_velocity * s2.slope;
  const double relative = (pair.two.motion.velocity - pair.one.motion.velocity).dot(n);
  pair.two.motion.velocity += (advance - approach - relative) * n;
}

double approach_speed(const CollisionCase& pair, double normal_angle) {
  return pair.one.motion.velocity.dot(unit(normal_angle)) -
         pair.two.motion.velocity.dot(unit(normal_angle)) -
         pair.one.motion.angular_velocity * support(pair.one, normal_angle).slope -
         pair.two.motion.angular_velocity * support(pair.two, normal_angle).slope;
}

/// d²/dt² of the largest support gap: g_tt + g_tφ²/(g + ρ₁ + ρ₂).
double gap_acceleration(const CollisionCase& pair, double normal_angle, double gap) {
  const Support s1 = support(pair.one, normal_angle), s2 = support(pair.two, normal_angle);
  const double w1 = pair.one.motion.angular_velocity, w2 = pair.two.motion.angular_velocity;
  const Vec2 tangent = unit(normal_angle + pi / 2);
  const double sideways = (pair.two.motion.velocity - pair.one.motion.velocity).dot(tangent) +
                          w1 * s1.second + w2 * s2.second;
  return -w1 * w1 * s1.second - w2 * w2 * s2.second +
         sideways * sideways / (gap + s1.curvature + s2.curvature);
}

CollisionCase generic(Stream& draw, double kappa) {
  return close_pair(draw, of_unit_area(kappa), of_unit_area(kappa));
}

CollisionCase grazing(Stream& draw, double kappa) {
  const double wanted = signed_log_uniform(draw, 1e-12, 1e-3);
  while (true) {
    CollisionCase pair = thermal_pair(draw, of_unit_area(kappa), of_unit_area(kappa));
    const double unit_gap = pair.gap_unit(), normal_angle = any_angle(draw);
    const double when = draw.uniform(0.1, 0.9) * usual_horizon;
    // Chosen with the widest gap of the class, so that no sample stands in the overlap that is
    // wanted; then the surfaces are brought to the gap wanted.
    constexpr double widest = 1e-3;
    bring_together(pair, normal_angle, widest * unit_gap, 0);
    if (gap_acceleration(pair, normal_angle, 0) < 0.1 * unit_gap) continue;
    CollisionCase probe = pair;
    happen_at(probe, when);
    if (!disjoint_at_samples(probe, usual_horizon, 64)) continue;
    bring_together(pair, normal_angle, wanted * unit_gap, 0);
    happen_at(pair, when);
    return pair;
  }
}

CollisionCase fast_rotation(Stream& draw, double kappa) {
  CollisionCase pair = thermal_pair(draw, of_unit_area(kappa), of_unit_area(kappa));
  for (Flight<GrowingEllipse>* flight : {&pair.one, &pair.two}) {
    const double sense = sign(draw);
    flight->motion.angular_velocity = sense * draw.uniform(10, 60);
  }
  return placed_apart(draw, pair, 0.5, 1.4);
}

CollisionCase aspect_ratios(Stream& draw, double largest) {
  const double kappa1 = log_uniform(draw, 1, largest), kappa2 = log_uniform(draw, 1, largest);
  return close_pair(draw, of_unit_area(kappa1), of_unit_area(kappa2));
}

CollisionCase sizes(Stream& draw, double largest) {
  const Ellipse one = of_unit_area(log_uniform(draw, 1, largest));
  const Ellipse shape = of_unit_area(log_uniform(draw, 1, largest));
  const double size = log_uniform(draw, 1e-3, 1);
  CollisionCase pair = thermal_pair(draw, one, {size * shape.a, size * shape.b});
  // A small body turns as one of unit size would: fast rotation is a class of its own.
  pair.two.motion.angular_velocity = thermal_turning(draw, shape);
  return placed_apart(draw, pair, 0.2, 1.2);
}

CollisionCase crossed_at_start(Stream& draw, double kappa) {
  while (true) {
    CollisionCase pair = thermal_pair(draw, of_unit_area(kappa), of_unit_area(kappa));
    const double reach = 2 * pair.one.body.shape.a;
    const Vec2 n = unit(any_angle(draw));
    pair.two.pose.position = draw.uniform(0, 0.5) * reach * n;
    const VieillardBaron<double> at = contact_function(pair, 0);
    // Ψ of exactly four intersections: ellipses of one area do not contain each other.
    if (at.psi > 1e-3 && !at.disjoint()) return pair;
  }
}

CollisionCase touching(Stream& draw, double kappa, double sense) {
  while (true) {
    CollisionCase pair = thermal_pair(draw, of_unit_area(kappa), of_unit_area(kappa));
    const double wanted = draw.uniform(0.25, 1.25) * pair.contact_gap();
    const double speed = std::abs(std::sqrt(2.0) * draw.normal());
    bring_together(pair, any_angle(draw), wanted, sense * speed);
    // What the stored doubles say.
    const auto gap = static_cast<double>(true_gap(pair.one, pair.two, 0));
    if (gap >= 0.25 * pair.contact_gap() && gap <= 1.25 * pair.contact_gap()) return pair;
  }
}
CollisionCase touching_leaving(Stream& draw, double kappa) {
  return touching(draw, kappa, -1);
}
CollisionCase touching_approaching(Stream& draw, double kappa) {
  return touching(draw, kappa, 1);
}

CollisionCase slow(Stream& draw, double kappa) {
  constexpr double slowness = 1e-8;
  CollisionCase pair = thermal_pair(draw, of_unit_area(kappa), of_unit_area(kappa));
  const Vec2 common = thermal_velocity(draw);
  for (Flight<GrowingEllipse>* flight : {&pair.one, &pair.two}) {
    flight->motion.velocity *= slowness;
    flight->motion.angular_velocity *= slowness;
  }
  const double normal_angle = any_angle(draw);
  double approach = approach_speed(pair, normal_angle);
  if (approach < 0) {  // played backwards it is the other sense
    for (Flight<GrowingEllipse>* flight : {&pair.one, &pair.two})
      flight->motion = {-flight->motion.velocity, -flight->motion.angular_velocity};
    approach = -approach;
  }
  bring_together(pair, normal_angle, draw.uniform(0.1, 1.9) * approach * pair.horizon, approach);
  pair.one.motion.velocity += common;
  pair.two.motion.velocity += common;
  return pair;
}

CollisionCase round_pair(Stream& draw, double excess) {
  const double b1 = log_uniform(draw, 0.5, 2), b2 = log_uniform(draw, 0.5, 2);
  return close_pair(draw, {b1 * (1 + excess), b1}, {b2 * (1 + excess), b2});
}
CollisionCase nearly_circular(Stream& draw, double /*kappa*/) {
  return round_pair(draw, 1e-12);
}
CollisionCase round(Stream& draw, double /*kappa*/) {
  return round_pair(draw, 0);
}

/// A contact at a time before or after the horizon, with nothing before it at the samples; or an
/// empty horizon if something is.
CollisionCase meeting(Stream& draw, CollisionCase pair, double normal_angle) {
  const double when = draw.uniform(0.05, 0.6);
  bring_together(pair, normal_angle, 0, draw.uniform(0.2, 3));
  happen_at(pair, when);
  pair.horizon = disjoint_at_samples(pair, when, 32) ? draw.uniform(0.6, 2) * when : 0;
  return pair;
}

CollisionCase parallel_sides(Stream& draw, double kappa) {
  CollisionCase pair;
  do {
    pair = thermal_pair(draw, of_unit_area(kappa), of_unit_area(kappa));
    const auto off = [&] {
      return draw.uniform() < 0.125 ? 0 : signed_log_uniform(draw, 1e-12, 1e-6);
    };
    pair.two.pose.angle = pair.one.pose.angle + off();
    pair.two.motion.angular_velocity = pair.one.motion.angular_velocity + off();
    pair.two.motion.velocity = pair.one.motion.velocity + 0.1 * thermal_velocity(draw);
    const double normal_angle = pair.one.pose.angle + pi / 2 + 0.1 * draw.normal() / kappa;
    pair = meeting(draw, pair, normal_angle);
  } while (pair.horizon == 0);
  return pair;
}

CollisionCase tip(Stream& draw, double kappa) {
  CollisionCase pair;
  do {
    pair = thermal_pair(draw, of_unit_area(kappa), of_unit_area(kappa));
    const double normal_angle = pair.one.pose.angle + 0.1 * draw.normal() / kappa;
    if (draw.uniform() < 0.25) pair.two.pose.angle = normal_angle + 0.1 * draw.normal() / kappa;
    pair = meeting(draw, pair, normal_angle);
  } while (pair.horizon == 0);
  return pair;
}

CollisionCase large_coordinates(Stream& draw, double kappa) {
  const Ellipse ellipse = of_unit_area(kappa);
  const Vec2 far = 1e6 * ellipse.a * unit(any_angle(draw));
  const CollisionCase pair = thermal_pair(draw, ellipse, ellipse);
  return placed_apart(draw, pair, 0.2, 1.2, far);
}

CollisionCase growth(Stream& draw, double kappa) {
  CollisionCase pair = thermal_pair(draw, of_unit_area(kappa), of_unit_area(kappa));
  let_grow(draw, pair);
  return placed_apart(draw, pair, 0.2, 1.4);
}

}  // namespace

std::vector<CaseClass> stability_suite() {
  DrawnClasses<2> classes;
  classes.add("generic", "random close pairs with thermal velocities", generic, {2, 6});
  classes.add("grazing",
              "the gap has a minimum between ±1e-12 and ±1e-3 semi-minor axes within the horizon",
              grazing, {2, 6});
  classes.add("fast_rotation",
              "angular velocities of 10 to 60, so that the gap has many minima within the horizon",
              fast_rotation, {2, 6});
  classes.add("aspect_ratios", "aspect ratios log-uniform from 1 to 100, drawn for each body",
              aspect_ratios, {100});
  classes.add("sizes", "size ratios log-uniform from 1 to 1000, aspect ratios from 1 to 100", sizes,
              {100});
  classes.add("crossed_at_start",
              "crossed at the start with four intersections, so Ψ > 0 despite the overlap",
              crossed_at_start, {2, 6});
  classes.add("touching_leaving", "initial gap of 1/4 to 5/4 contact gaps, separating",
              touching_leaving, {2, 6});
  classes.add("touching_approaching", "initial gap of 1/4 to 5/4 contact gaps, approaching",
              touching_approaching, {2, 6});
  classes.add("slow", "relative and angular velocities of order 1e-8, gaps scaled accordingly",
              slow, {2, 6});
  classes.add("nearly_circular", "aspect ratios 1 + 1e-12", nearly_circular, {1});
  classes.add("round", "circles represented as ellipses", round, {1});
  classes.add(
      "parallel_sides",
      "flat sides, parallel exactly or to within 1e-6, meet before or just after the horizon",
      parallel_sides, {2, 6});
  classes.add("tip", "the tip of one body meets the other before or just after the horizon", tip,
              {2, 6});
  classes.add("large_coordinates", "close pairs a million semi-major axes from the origin",
              large_coordinates, {2, 6});
  classes.add("growth", "bodies grow or shrink while they rotate; some start as a point", growth,
              {2, 6});
  return classes.list();
}

}  // namespace vitrel::bench
