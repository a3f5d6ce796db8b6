#include "core/state/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>

#include "core/contact/vieillard_baron.h"
#include "core/error.h"

namespace vitrel {
namespace {

using Real = long double;
static_assert(std::numeric_limits<Real>::digits >= 64, "the exact check needs 80-bit arithmetic");

struct Point {
  Real x, y;
};

struct Particle {
  Point centre;
  EllipseAxes<Real> axes;
};

/// Limit of positions and semi-axes in box lengths. Shifts then stay below 2¹¹, so that shift ∘ L
/// is exact in 64 bits, 53 of which belong to L.
constexpr double most_boxes = 300;

void validate(const Configuration2& configuration) {
  const auto& lengths = configuration.box.lengths();
  if (!(lengths.allFinite() && lengths.minCoeff() > 0))
    throw InvariantError("exact check: the box lengths must be finite and positive");
  const std::string within = std::to_string(static_cast<int>(most_boxes)) + " box lengths";
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const Ellipse& shape = configuration.shape[i];
    const Vec2& position = configuration.position[i];
    const std::string who = "exact check: particle " + std::to_string(i);
    if (!position.allFinite() || (position.cwiseAbs().array() > most_boxes * lengths.array()).any())
      throw InvariantError(who + ": its position must be finite and within " + within +
                           " of the origin");
    if (!std::isfinite(configuration.angle[i]))
      throw InvariantError(who + ": its angle must be finite");
    if (!(shape.b > 0 && shape.a >= shape.b && shape.a <= most_boxes * lengths.minCoeff()))
      throw InvariantError(who + ": its semi-axes must obey b > 0 and b ≤ a ≤ " + within);
  }
}

std::vector<Particle> in_extended_precision(const Configuration2& configuration) {
  std::vector<Particle> particles;
  particles.reserve(configuration.size());
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const Real angle = configuration.angle[i];
    particles.push_back(
        {{configuration.position[i].x(), configuration.position[i].y()},
         {configuration.shape[i].a, configuration.shape[i].b, std::cos(angle), std::sin(angle)}});
  }
  return particles;
}

/// The support function of an ellipse about its centre along the unit vector n, with its derivative
/// along the angle of n and the radius of curvature ρ = h + h'' = a²b²/h³.
struct Support {
  Real h, slope, radius;
};

Support support_of(const EllipseAxes<Real>& e, const Point& n) {
  const Real along = n.x * e.cosine + n.y * e.sine;
  const Real across = n.y * e.cosine - n.x * e.sine;
  const Real p = e.a * along;
  const Real q = e.b * across;
  const Real h = std::sqrt(p * p + q * q);
  const Real ab = e.a * e.b;
  return {h, -(e.a - e.b) * (e.a + e.b) * along * across / h, ab * ab / (h * h * h)};
}

/// g(n) = n·d − h₁(n) − h₂(n) with its derivatives along the angle of n.
struct Separation {
  Real gap, slope, curvature;
};

Separation separation_along(const Particle& one, const Particle& two, const Point& d,
                            const Point& n) {
  const Support first = support_of(one.axes, n);
  const Support second = support_of(two.axes, n);
  const Real gap = n.x * d.x + n.y * d.y - first.h - second.h;
  const Real slope = n.x * d.y - n.y * d.x - first.slope - second.slope;
  return {gap, slope, -gap - first.radius - second.radius};
}

Point normalized(const Point& p) {
  const Real length = std::hypot(p.x, p.y);
  return {p.x / length, p.y / length};
}

Point turned(const Point& n, Real tangent) {
  return normalized({n.x - tangent * n.y, n.y + tangent * n.x});
}

/// The local maximum of g above n: Newton's method along the angle, halving every step that would
/// lead down. On the arc where g > 0 it is strictly concave, so that there is one maximum on it.
/// Ends early with any value that is `enough`.
Real climb(const Particle& one, const Particle& two, const Point& d, Point n, Real enough) {
  constexpr Real longest_step = 0.1L;
  constexpr Real shortest_step = 1e-10L;  // g is flat there: an error of 1e-20 in relative terms
  constexpr int most_steps = 200;
  Separation here = separation_along(one, two, d, n);
  for (int step = 0; step < most_steps && here.gap < enough; ++step) {
    Real turn = std::copysign(longest_step, here.slope);
    if (here.curvature < 0)
      turn = std::clamp(-here.slope / here.curvature, -longest_step, longest_step);
    Point next = turned(n, turn);
    Separation there = separation_along(one, two, d, next);
    while (there.gap < here.gap && std::abs(turn) > shortest_step) {
      turn /= 2;
      next = turned(n, turn);
      there = separation_along(one, two, d, next);
    }
    if (there.gap > here.gap) n = next, here = there;
    if (std::abs(turn) <= shortest_step) break;
  }
  return here.gap;
}

/// A direction that separates disjoint ellipses. Between its two positive roots the polynomial p(t)
/// = t³ + G₁t² + (G₂/q)t + 1/q is negative, and (Σ₁ + tΣ₂)⁻¹d separates for every such t: take the
/// minimum of p.
Point separating_direction(const Particle& one, const Particle& two, const Point& d,
                           const VieillardBaron<Real>& contact) {
  const EllipseAxes<Real>& e = one.axes;
  const EllipseAxes<Real>& f = two.axes;
  const Real ratio = (e.a * e.b) / (f.a * f.b);
  const Real g = contact.g1;
  const Real root = std::sqrt(std::max<Real>(0, g * g - 3 * contact.g2 * ratio * ratio));
  // The larger root of 3t² + 2G₁t + G₂/q, without cancellation for either sign of G₁.
  const Real t = g < 0 ? (root - g) / 3 : -contact.g2 * ratio * ratio / (g + root);
  const auto adjugate_times = [](const EllipseAxes<Real>& axes, const Point& x) -> Point {
    const Real along = (x.x * axes.cosine + x.y * axes.sine) * axes.b * axes.b;
    const Real across = (x.y * axes.cosine - x.x * axes.sine) * axes.a * axes.a;
    return {along * axes.cosine - across * axes.sine, along * axes.sine + across * axes.cosine};
  };
  const Point first = adjugate_times(e, d);
  const Point second = adjugate_times(f, d);
  return normalized({first.x + t * second.x, first.y + t * second.y});
}

constexpr int samples_per_ellipse = 64;

/// (cos, sin) of equally spaced eccentric angles.
const std::array<Point, samples_per_ellipse>& eccentric_angles() {
  static const auto angles = [] {
    std::array<Point, samples_per_ellipse> table;
    for (int k = 0; k < samples_per_ellipse; ++k) {
      const Real angle = 2 * std::numbers::pi_v<Real> * k / samples_per_ellipse;
      table[k] = {std::cos(angle), std::sin(angle)};
    }
    return table;
  }();
  return angles;
}

/// The highest of many normals of both ellipses, at equal steps of their eccentric angle so that
/// sharp tips get their share, then the maximum next to it. Ends early with any value that is
/// `enough`.
Real overlap_gap(const Particle& one, const Particle& two, const Point& d, Real enough) {
  Point best{1, 0};
  Real highest = -std::numeric_limits<Real>::infinity();
  for (const EllipseAxes<Real>& e : {one.axes, two.axes}) {
    for (const Point& eccentric : eccentric_angles()) {
      const Real along = e.b * eccentric.x;
      const Real across = e.a * eccentric.y;
      const Point n =
          normalized({along * e.cosine - across * e.sine, along * e.sine + across * e.cosine});
      const Real gap = separation_along(one, two, d, n).gap;
      if (gap >= enough) return gap;
      if (gap > highest) highest = gap, best = n;
    }
  }
  return climb(one, two, d, best, enough);
}

/// Walks over pairs of particles and keeps the findings.
class Examination {
 public:
  Examination(std::vector<Particle> particles, const Vec2& lengths)
      : particles_(std::move(particles)), lengths_{lengths.x(), lengths.y()} {
    for (const Particle& particle : particles_) nearness_ = std::max(nearness_, particle.axes.a);
    smallest_gap_ = nearness_;
  }

  std::size_t size() const { return particles_.size(); }
  const Particle& particle(std::size_t i) const { return particles_[i]; }
  /// No two centres farther apart than this have a surface distance that matters.
  Real reach() const { return 3 * nearness_; }

  /// All images of the pair i ≤ j.
  void examine(std::size_t i, std::size_t j) {
    const Particle& one = particles_[i];
    const Particle& two = particles_[j];
    const Point d{two.centre.x - one.centre.x, two.centre.y - one.centre.y};
    const Real reach = one.axes.a + two.axes.a + std::max<Real>(0, smallest_gap_);
    if (beyond(reach, d.x, lengths_.x) || beyond(reach, d.y, lengths_.y)) return;
    const auto [low_x, high_x] = shifts_within(reach, d.x, lengths_.x);
    const auto [low_y, high_y] = shifts_within(reach, d.y, lengths_.y);
    for (int x = low_x; x <= high_x; ++x)
      for (int y = low_y; y <= high_y; ++y)
        if (i != j || x > 0 || (x == 0 && y > 0))
          examine(i, j, x, y, {d.x + x * lengths_.x, d.y + y * lengths_.y});
  }

  ExactCheck result() && {
    std::sort(overlaps_.begin(), overlaps_.end(), [](const PairImage& p, const PairImage& q) {
      return std::tuple(p.i, p.j, p.shift.x(), p.shift.y()) <
             std::tuple(q.i, q.j, q.shift.x(), q.shift.y());
    });
    const double gap = smallest_gap_ < nearness_ ? static_cast<double>(smallest_gap_)
                                                 : std::numeric_limits<double>::infinity();
    return {std::move(overlaps_), gap, pairs_examined_};
  }

 private:
  /// Quick and sufficient for |d| ≤ L: then d itself and one image are the nearest.
  static bool beyond(Real reach, Real d, Real length) {
    const Real away = std::abs(d);
    return away > reach && length - away > reach;
  }

  static std::pair<int, int> shifts_within(Real reach, Real d, Real length) {
    return {static_cast<int>(std::ceil((-reach - d) / length)),
            static_cast<int>(std::floor((reach - d) / length))};
  }

  void examine(std::size_t i, std::size_t j, int x, int y, const Point& d) {
    const Particle& one = particles_[i];
    const Particle& two = particles_[j];
    const Real contact_circle = one.axes.a + two.axes.a;
    const Real distance = std::hypot(d.x, d.y);
    if (distance - contact_circle >= std::max<Real>(0, smallest_gap_)) return;
    const auto contact = vieillard_baron<Real>(one.axes, two.axes, d.x, d.y);
    if (distance < contact_circle) ++pairs_examined_;
    if (distance >= contact_circle || contact.disjoint_or_touching()) {
      const Point n = separating_direction(one, two, d, contact);
      smallest_gap_ = std::min(smallest_gap_, climb(one, two, d, n, smallest_gap_));
    } else {
      overlaps_.push_back({i, j, {x, y}});
      smallest_gap_ = std::min(smallest_gap_, overlap_gap(one, two, d, smallest_gap_));
    }
  }

  std::vector<Particle> particles_;
  Point lengths_;
  Real nearness_ = 0;
  Real smallest_gap_ = 0;
  std::vector<PairImage> overlaps_;
  std::uint64_t pairs_examined_ = 0;
};

void examine_all_pairs(Examination& examination) {
  for (std::size_t i = 0; i < examination.size(); ++i)
    for (std::size_t j = i; j < examination.size(); ++j) examination.examine(i, j);
}

/// Cells at least `reach` wide, periodic: what lies within reach of a particle is in its cell or
/// in one next to it. They only name the candidates; images are found pair by pair.
class Cells {
 public:
  Cells(const Examination& examination, const Vec2& lengths) : lengths_(lengths) {
    // A little wider than needed, so that rounding cannot move a particle out of reach.
    const double width = static_cast<double>(examination.reach()) * (1 + 1e-6);
    const double most = std::sqrt(static_cast<double>(examination.size()));
    for (int k = 0; k < 2; ++k)
      count_[k] =
          static_cast<int>(std::clamp(std::floor(lengths[k] / width), 1.0, std::ceil(most)));
    members_.resize(static_cast<std::size_t>(count_[0]) * count_[1]);
    for (std::size_t i = 0; i < examination.size(); ++i) {
      const Point& r = examination.particle(i).centre;
      members_[index(cell_of(r.x, 0), cell_of(r.y, 1))].push_back(i);
    }
  }

  /// Calls visit(j) once for every particle in the cell of `centre` and its neighbours.
  template <class Visit>
  void for_each_near(const Point& centre, Visit&& visit) const {
    for (int x : neighbours(cell_of(centre.x, 0), 0))
      for (int y : neighbours(cell_of(centre.y, 1), 1))
        for (std::size_t j : members_[index(x, y)]) visit(j);
  }

 private:
  int cell_of(Real coordinate, int k) const {
    const Real fraction = coordinate / lengths_[k];
    const Real within = fraction - std::floor(fraction);
    return std::min(static_cast<int>(within * count_[k]), count_[k] - 1);
  }

  std::size_t index(int x, int y) const { return static_cast<std::size_t>(x) * count_[1] + y; }

  /// The cell and those beside it, each once even if there are fewer than three.
  std::vector<int> neighbours(int cell, int k) const {
    const int n = count_[k];
    std::vector<int> cells{cell};
    if (n > 1) cells.push_back((cell + 1) % n);
    if (n > 2) cells.push_back((cell + n - 1) % n);
    return cells;
  }

  Vec2 lengths_;
  std::array<int, 2> count_{};
  std::vector<std::vector<std::size_t>> members_;
};

void examine_by_cells(Examination& examination, const Vec2& lengths) {
  const Cells cells(examination, lengths);
  for (std::size_t i = 0; i < examination.size(); ++i)
    cells.for_each_near(examination.particle(i).centre, [&](std::size_t j) {
      if (j >= i) examination.examine(i, j);
    });
}

}  // namespace

ExactCheck exact_check(const Configuration2& configuration, std::size_t brute_force_limit) {
  validate(configuration);
  const Vec2& lengths = configuration.box.lengths();
  Examination examination(in_extended_precision(configuration), lengths);
  if (examination.size() <= brute_force_limit)
    examine_all_pairs(examination);
  else
    examine_by_cells(examination, lengths);
  return std::move(examination).result();
}

}  // namespace vitrel
