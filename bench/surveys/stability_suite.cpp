#include "bench/surveys/stability_suite.h"

#include <algorithm>
#include <array>
#include <functional>

#include "bench/methods/opening.h"
#include "bench/surveys/drawn_class.h"
#include "bench/surveys/placed_pair.h"
#include "bench/surveys/verdict.h"

namespace vitrel::bench {
namespace {

/// The end of the horizon of most cases.
constexpr double usual_horizon = 2;

// ---- bodies -----------------------------------------------------------------------------------------

double thermal_turning(Stream& draw, const Ellipse& shape, double) {
  return draw.normal() / std::sqrt(shape.inertia_per_mass());
}
Vec3 thermal_turning(Stream& draw, const Ellipsoid& shape, const Quaternion& orientation) {
  return orientation * thermal_vector<3>(draw).cwiseQuotient(shape.inertia_per_mass().cwiseSqrt());
}

/// A body of constant size at the origin with thermal velocities and a random orientation.
template <class Shape>
Flight<Growing<Shape>> thermal(Stream& draw, const Shape& shape) {
  constexpr int dim = Shape::dimension;
  const auto orientation = any_orientation<dim>(draw);
  const Vec<dim> velocity = thermal_vector<dim>(draw);
  return {{shape, 1, 0},
          {Vec<dim>::Zero(), orientation},
          {velocity, thermal_turning(draw, shape, orientation)}};
}

template <int Dim>
Moving<Dim> any_body(Stream& draw, double kappa) {
  const auto shape = any_shape<Dim>(draw, kappa);
  return thermal(draw, shape);
}

template <int Dim>
CollisionCaseOf<Dim> thermal_pair(Stream& draw, double kappa) {
  const Moving<Dim> one = any_body<Dim>(draw, kappa);
  return {one, any_body<Dim>(draw, kappa), usual_horizon};
}

CollisionCase pair_of(Stream& draw, const Ellipse& e1, const Ellipse& e2) {
  const Moving<2> one = thermal(draw, e1);
  return {one, thermal(draw, e2), usual_horizon};
}

/// Lets both bodies grow or shrink. A body starts as a point with a probability of 0.3.
template <int Dim>
void let_grow(Stream& draw, CollisionCaseOf<Dim>& pair) {
  for (GrowingBody<Dim>* body : {&pair.one.body, &pair.two.body}) {
    const bool from_a_point = draw.uniform() < 0.3;
    body->size = from_a_point ? 0 : 1;
    body->growth_rate = from_a_point ? draw.uniform(0.1, 0.6) : draw.uniform(-0.4, 0.4);
  }
}

// ---- classes in the plane and in space ----------------------------------------------------------------

/// Random close pairs with thermal velocities.
template <int Dim>
CollisionCaseOf<Dim> generic(Stream& draw, double kappa) {
  const CollisionCaseOf<Dim> pair = thermal_pair<Dim>(draw, kappa);
  return close_pair(draw, pair);
}

/// The minimum gap within the horizon is between ±1e-12 and ±1e-3 shortest semi-axes. If it is negative, there are
/// two close roots. A pair is first chosen with the widest gap of the class, so that no sample lies in the wanted
/// overlap. The surfaces are then brought to the wanted gap.
template <int Dim, bool tumble = false>
CollisionCaseOf<Dim> grazing(Stream& draw, double kappa) {
  constexpr double widest = 1e-3;
  constexpr int samples = 64;
  const double wanted = signed_log_uniform(draw, 1e-12, widest);
  while (true) {
    CollisionCaseOf<Dim> pair = thermal_pair<Dim>(draw, kappa);
    const Vec<Dim> n = any_direction<Dim>(draw);
    const double when = draw.uniform(0.1, 0.9) * usual_horizon;
    const auto bring_to = [&](double gap) {
      bring_together(pair, n, gap * pair.gap_unit(), 0);
      if constexpr (tumble) let_tumble(pair);
    };
    bring_to(widest);
    if (gap_acceleration(pair, n) < 0.1 * pair.gap_unit()) continue;
    CollisionCaseOf<Dim> probe = pair;
    happen_at(probe, when);
    if (!disjoint_at_samples(probe, usual_horizon, samples)) continue;
    bring_to(wanted);
    happen_at(pair, when);
    return pair;
  }
}

/// Angular velocities are 10 to 60, so that the gap has many minima within the horizon.
template <int Dim>
CollisionCaseOf<Dim> fast_rotation(Stream& draw, double kappa) {
  CollisionCaseOf<Dim> pair = thermal_pair<Dim>(draw, kappa);
  for (Moving<Dim>* flight : {&pair.one, &pair.two}) {
    if constexpr (Dim == 2)
      flight->motion.angular_velocity = sign(draw);
    else
      flight->motion.angular_velocity = any_direction<3>(draw);
    flight->motion.angular_velocity *= draw.uniform(10, 60);
  }
  return placed_apart(draw, pair, 0.5, 1.4);
}

/// The initial gap is 1/4 to 5/4 of the gap of a declared contact. The surfaces approach (sense 1) or separate (sense
/// −1).
template <int Dim, int sense>
CollisionCaseOf<Dim> touching(Stream& draw, double kappa) {
  while (true) {
    CollisionCaseOf<Dim> pair = thermal_pair<Dim>(draw, kappa);
    const double wanted = draw.uniform(0.25, 1.25) * pair.contact_gap();
    const double speed = std::abs(std::sqrt(2.0) * draw.normal());
    bring_together(pair, any_direction<Dim>(draw), wanted, sense * speed);
    // The gap is computed again from the stored doubles.
    const auto gap = static_cast<double>(gap_at(pair, 0));
    if (gap >= 0.25 * pair.contact_gap() && gap <= 1.25 * pair.contact_gap()) return pair;
  }
}

/// Bodies grow or shrink while they rotate; some start as a point.
template <int Dim>
CollisionCaseOf<Dim> growth(Stream& draw, double kappa) {
  CollisionCaseOf<Dim> pair = thermal_pair<Dim>(draw, kappa);
  let_grow(draw, pair);
  return placed_apart(draw, pair, 0.2, 1.4);
}

/// Aspect ratios are log-uniform from 1 to 100 and drawn for each body.
template <int Dim>
CollisionCaseOf<Dim> aspect_ratios(Stream& draw, double largest) {
  const auto ratio = [&] { return log_uniform(draw, 1, largest); };
  if constexpr (Dim == 2) {
    const double kappa1 = ratio(), kappa2 = ratio();
    const CollisionCase pair = pair_of(draw, of_unit_area(kappa1), of_unit_area(kappa2));
    return close_pair(draw, pair);
  } else {
    const Moving<3> one = any_body<3>(draw, ratio());
    const Moving<3> two = any_body<3>(draw, ratio());
    return close_pair<3>(draw, {one, two, usual_horizon});
  }
}

// ---- classes in the plane -----------------------------------------------------------------------------

/// Size ratios are log-uniform from 1 to 1000, aspect ratios from 1 to 100.
CollisionCase sizes(Stream& draw, double largest) {
  const Ellipse one = of_unit_area(log_uniform(draw, 1, largest));
  const Ellipse shape = of_unit_area(log_uniform(draw, 1, largest));
  const double size = log_uniform(draw, 1e-3, 1);
  CollisionCase pair = pair_of(draw, one, scaled(shape, size));
  // A small body turns as fast as one of unit size would, because fast rotation is a class of its own.
  pair.two.motion.angular_velocity = thermal_turning(draw, shape, 0);
  return close_pair(draw, pair);
}

/// The bodies are crossed at the start with four intersections, so that Ψ > 0 despite the overlap. (Ellipses of the
/// same area do not contain each other.)
CollisionCase crossed_at_start(Stream& draw, double kappa) {
  while (true) {
    CollisionCase pair = thermal_pair<2>(draw, kappa);
    const Vec2 n = any_direction<2>(draw);
    pair.two.pose.position = draw.uniform(0, 0.5) * pair.reach() * n;
    const VieillardBaron<double> at = vieillard_baron_at(pair, 0);
    if (at.psi > 1e-3 && !at.disjoint()) return pair;
  }
}

/// Relative and angular velocities are of order 1e-8, and gaps are scaled accordingly.
CollisionCase slow(Stream& draw, double kappa) {
  constexpr double slowness = 1e-8;
  CollisionCase pair = thermal_pair<2>(draw, kappa);
  const Vec2 common = thermal_vector<2>(draw);
  for (Moving<2>* flight : {&pair.one, &pair.two}) {
    flight->motion.velocity *= slowness;
    flight->motion.angular_velocity *= slowness;
  }
  const Vec2 n = any_direction<2>(draw);
  double approach = pair.one.motion.velocity.dot(n) - pair.two.motion.velocity.dot(n) +
                    support(pair.one, n).rate + support(pair.two, n).rate;
  if (approach < 0) {  // in reversed time the surfaces approach
    for (Moving<2>* flight : {&pair.one, &pair.two})
      flight->motion = {-flight->motion.velocity, -flight->motion.angular_velocity};
    approach = -approach;
  }
  bring_together(pair, n, draw.uniform(0.1, 1.9) * approach * pair.horizon, approach);
  pair.one.motion.velocity += common;
  pair.two.motion.velocity += common;
  return pair;
}

CollisionCase round_pair(Stream& draw, double excess) {
  const double b1 = log_uniform(draw, 0.5, 2), b2 = log_uniform(draw, 0.5, 2);
  const CollisionCase pair = pair_of(draw, {b1 * (1 + excess), b1}, {b2 * (1 + excess), b2});
  return close_pair(draw, pair);
}
/// Aspect ratios are 1 + 1e-12.
CollisionCase nearly_circular(Stream& draw, double /*kappa*/) {
  return round_pair(draw, 1e-12);
}
/// Circles are represented as ellipses.
CollisionCase round(Stream& draw, double /*kappa*/) {
  return round_pair(draw, 0);
}

/// A contact occurs before or after the horizon, and no sample before it overlaps. If a sample does, the horizon is
/// 0.
CollisionCase meeting(Stream& draw, CollisionCase pair, double normal_angle) {
  const double when = draw.uniform(0.05, 0.6);
  bring_together<2>(pair, unit(normal_angle), 0, draw.uniform(0.2, 3));
  happen_at(pair, when);
  pair.horizon = disjoint_at_samples(pair, when, 32) ? draw.uniform(0.6, 2) * when : 0;
  return pair;
}

/// Flat sides, parallel exactly or to within 1e-6, meet before or just after the horizon.
CollisionCase parallel_sides(Stream& draw, double kappa) {
  CollisionCase pair;
  do {
    pair = thermal_pair<2>(draw, kappa);
    const auto off = [&] {
      return draw.uniform() < 0.125 ? 0 : signed_log_uniform(draw, 1e-12, 1e-6);
    };
    pair.two.pose.angle = pair.one.pose.angle + off();
    pair.two.motion.angular_velocity = pair.one.motion.angular_velocity + off();
    pair.two.motion.velocity = pair.one.motion.velocity + 0.1 * thermal_vector<2>(draw);
    const double normal_angle =
        pair.one.pose.angle + std::numbers::pi / 2 + 0.1 * draw.normal() / kappa;
    pair = meeting(draw, pair, normal_angle);
  } while (pair.horizon == 0);
  return pair;
}

/// The tip of one body meets the other before or just after the horizon.
CollisionCase tip(Stream& draw, double kappa) {
  CollisionCase pair;
  do {
    pair = thermal_pair<2>(draw, kappa);
    const double normal_angle = pair.one.pose.angle + 0.1 * draw.normal() / kappa;
    if (draw.uniform() < 0.25) pair.two.pose.angle = normal_angle + 0.1 * draw.normal() / kappa;
    pair = meeting(draw, pair, normal_angle);
  } while (pair.horizon == 0);
  return pair;
}

/// Close pairs lie a million semi-major axes from the origin.
CollisionCase large_coordinates(Stream& draw, double kappa) {
  const Vec2 far = 1e6 * of_unit_area(kappa).a * any_direction<2>(draw);
  CollisionCase pair = thermal_pair<2>(draw, kappa);
  pair.one.pose.position = far;
  return close_pair(draw, pair);
}

// ---- classes in space ---------------------------------------------------------------------------------

/// Size and aspect ratios as in the class of the plane.
EllipsoidCase sizes_of_solids(Stream& draw, double largest) {
  const auto body = [&] {
    const double kappa = log_uniform(draw, 1, largest);
    return any_body<3>(draw, kappa);
  };
  EllipsoidCase pair{body(), body(), usual_horizon};
  Ellipsoid& small = pair.two.body.shape;
  small = scaled(small, log_uniform(draw, 1e-3, 1));
  return close_pair(draw, pair);
}

/// Bodies of the same shape are parallel and rotate alike, as a body and its image do, so that η₁ = 0 at all times.
EllipsoidCase parallel_congruent(Stream& draw, double kappa) {
  EllipsoidCase pair = thermal_pair<3>(draw, kappa);
  pair.two.body = pair.one.body;
  pair.two.pose.orientation = pair.one.pose.orientation;
  pair.two.motion.angular_velocity = pair.one.motion.angular_velocity;
  return close_pair(draw, pair);
}

/// These pairs differ from those of `draw_pair` only in that scalene bodies rotate by Euler's equations.
template <EllipsoidCase (*draw_pair)(Stream&, double)>
EllipsoidCase tumbling(Stream& draw, double kappa) {
  EllipsoidCase pair = draw_pair(draw, kappa);
  let_tumble(pair);
  return pair;
}

/// The axes in ascending order of their moments.
std::array<int, 3> by_moment(const Ellipsoid& shape) {
  std::array<int, 3> axes{0, 1, 2};
  std::ranges::sort(axes, std::greater<>{}, [&](int k) { return shape.semi_axes[k]; });
  return axes;
}

/// Both bodies are scalene. `spin` draws the angular velocities along their own axes.
template <class Spin>
EllipsoidCase scalene_pair(Stream& draw, double kappa, const Spin& spin) {
  EllipsoidCase pair = thermal_pair<3>(draw, kappa);
  for (Moving<3>* flight : {&pair.one, &pair.two}) {
    const double middle = std::pow(kappa, draw.uniform(0.1, 0.9));
    Ellipsoid& shape = flight->body.shape;
    shape = {Vec3(kappa, middle, 1) / std::cbrt(kappa * middle)};
    flight->motion.angular_velocity = flight->pose.orientation * spin(shape);
  }
  return close_pair(draw, pair);
}

/// The deviation from uniform rotation or from the separatrix, relative to the angular velocity.
double small_deviation(Stream& draw) {
  return signed_log_uniform(draw, 1e-12, 1e-1);
}

/// Angular velocities are along a principal axis up to a relative deviation between 1e-12 and 0.1. The unstable axis
/// is as frequent as the others.
EllipsoidCase nearly_uniform(Stream& draw, double kappa) {
  return scalene_pair(draw, kappa, [&](const Ellipsoid& shape) -> Vec3 {
    const auto axis = static_cast<int>(draw.below(3));
    const double speed = draw.normal() / std::sqrt(shape.inertia_per_mass()[axis]);
    Vec3 omega = any_direction<3>(draw);
    omega *= speed * small_deviation(draw);
    omega[axis] = speed;
    return omega;
  });
}

/// L² = 2EI₂ holds up to a relative deviation of ω₃ between 1e-12 and 0.1, which means I₃(I₃ − I₂) ω₃² = I₁(I₂ − I₁)
/// ω₁² for any ω₂.
EllipsoidCase near_separatrix(Stream& draw, double kappa) {
  return scalene_pair(draw, kappa, [&](const Ellipsoid& shape) -> Vec3 {
    const auto [one, two, three] = by_moment(shape);
    const Vec3 moments = shape.inertia_per_mass();
    Vec3 omega = thermal_vector<3>(draw).cwiseQuotient(moments.cwiseSqrt());
    const double ratio = moments[one] * (moments[two] - moments[one]) /
                         (moments[three] * (moments[three] - moments[two]));
    omega[three] = sign(draw) * std::sqrt(ratio) * omega[one];
    omega[three] *= 1 + small_deviation(draw);
    return omega;
  });
}

// ---- the list -----------------------------------------------------------------------------------------

/// The FNV-1a hash of name and aspect ratio, so that a class keeps its cases whatever other classes exist.
std::uint64_t key_of(const std::string& name, double aspect_ratio) {
  std::uint64_t key = 0xcbf29ce484222325U;
  for (const char c : name + std::to_string(aspect_ratio)) {
    key ^= static_cast<unsigned char>(c);
    key *= 0x100000001b3U;
  }
  return key;
}

template <int Dim>
struct Entry {
  const char* name;
  CollisionCaseOf<Dim> (*make)(Stream&, double kappa);
  std::vector<double> aspect_ratios;
};

template <int Dim>
std::vector<Entry<Dim>> entries() {
  const std::vector<double> usual{2, Dim == 2 ? 6. : 10.}, drawn{100}, none{1}, flat{2, 20};
  std::vector<Entry<Dim>> all = {{"generic", generic<Dim>, usual},
                                 {"grazing", grazing<Dim>, usual},
                                 {"fast_rotation", fast_rotation<Dim>, usual},
                                 {"aspect_ratios", aspect_ratios<Dim>, drawn}};
  const auto add = [&](std::initializer_list<Entry<Dim>> more) { all.insert(all.end(), more); };
  if constexpr (Dim == 2)
    add({{"sizes", sizes, drawn},
         {"crossed_at_start", crossed_at_start, usual},
         {"touching_leaving", touching<2, -1>, usual},
         {"touching_approaching", touching<2, 1>, usual},
         {"slow", slow, usual},
         {"nearly_circular", nearly_circular, none},
         {"round", round, none},
         {"parallel_sides", parallel_sides, usual},
         {"tip", tip, usual},
         {"large_coordinates", large_coordinates, usual},
         {"growth", growth<2>, usual}});
  else
    add({{"sizes", sizes_of_solids, drawn},
         {"growth", growth<3>, usual},
         {"touching_leaving", touching<3, -1>, usual},
         {"parallel_congruent", parallel_congruent, usual},
         {"tumbling", tumbling<generic<3>>, flat},
         {"tumbling_grazing", grazing<3, true>, flat},
         {"tumbling_fast", tumbling<fast_rotation<3>>, flat},
         {"tumbling_leaving", tumbling<touching<3, -1>>, flat},
         {"tumbling_nearly_uniform", tumbling<nearly_uniform>, flat},
         {"tumbling_near_separatrix", tumbling<near_separatrix>, flat}});
  return all;
}

}  // namespace

template <int Dim>
std::vector<CaseClassOf<Dim>> stability_suite() {
  std::vector<CaseClassOf<Dim>> list;
  for (const auto& [name, make, aspect_ratios] : entries<Dim>())
    for (const double kappa : aspect_ratios)
      list.push_back({name, kappa,
                      [make = make, kappa, key = key_of(name, kappa)](std::uint64_t seed,
                                                                      std::uint64_t index) {
                        Stream draw(seed, Purpose::benchmark_cases, key, index);
                        return make(draw, kappa);
                      }});
  return list;
}

template std::vector<CaseClassOf<2>> stability_suite();
template std::vector<CaseClassOf<3>> stability_suite();

EllipsoidCase passing_pair(double depth) {
  const auto solid = [](const Vec3& semi_axes, const Vec3& position,
                        const Vec3& velocity) -> Moving<3> {
    return {{{semi_axes}, 1, 0}, {position, Quaternion::Identity()}, {velocity, Vec3::Zero()}};
  };
  return {solid({2, 1, 1.2}, {0, 0, 0}, {0, 0, 0}),
          solid({1.5, 1, 0.8}, {3, 2 - depth, 0}, {-1, 0, 0}), 5.12};
}

}  // namespace vitrel::bench
