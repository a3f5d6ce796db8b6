#include "bench/reference/first_contact.h"

#include <optional>

#include "bench/reference/interval_jet.h"
#include "bench/reference/true_gap.h"

namespace vitrel::bench {

// Boost reduces an angle in the precision of its type, which leaves few digits of a sine or cosine close to 0.
template <>
std::pair<Float128, Float128> cosine_and_sine(const Float128& angle) {
  const boost::multiprecision::cpp_bin_float_100 wide(angle);
  return {Float128(cos(wide)), Float128(sin(wide))};
}

namespace {

/// R(x, y) = xxx x³ + xxy x²y + xyy xy² + yyy y³ as a function of time.
template <class Real>
struct Cubic {
  Jet<Real> xxx, xxy, xyy, yyy;

  /// Its values at fixed x and y = 1.
  Jet<Real> at(const Real& x) const {
    const Interval<Real> x1(x), x2 = square(x1), x3 = x2 * x1;
    return x3 * xxx + x2 * xxy + x1 * xyy + yyy;
  }

  Jet<Real> discriminant() const {
    const Jet<Real> ends = xxx * yyy, inner = xxy * xyy;
    const Jet<Real> rest = xxx * (square(xyy) * xyy) + yyy * (square(xxy) * xxy);
    return square(inner) + Interval<Real>(18) * (ends * inner) - Interval<Real>(4) * rest -
           Interval<Real>(27) * square(ends);
  }
};

/// What one ellipse contributes, all constant in time.
template <class Real>
struct Constants {
  explicit Constants(const Flight<GrowingEllipse>& flight)
      : angle(Real(flight.pose.angle)),
        omega(Real(flight.motion.angular_velocity)),
        size(Real(flight.body.size)),
        rate(Real(flight.body.growth_rate)),
        aa(square(Interval<Real>(flight.body.shape.a))),
        bb(square(Interval<Real>(flight.body.shape.b))),
        det(aa * bb) {}

  Interval<Real> angle, omega, size, rate, aa, bb, det;
};

template <class Real>
struct Directions {
  Direction<Real> one, two, between;
};

template <class Real>
class Pair {
 public:
  Pair(const Flight<GrowingEllipse>& one, const Flight<GrowingEllipse>& two)
      : one_(one),
        two_(two),
        x_(difference(two.pose.position.x(), one.pose.position.x())),
        y_(difference(two.pose.position.y(), one.pose.position.y())),
        vx_(difference(two.motion.velocity.x(), one.motion.velocity.x())),
        vy_(difference(two.motion.velocity.y(), one.motion.velocity.y())),
        turning_(two_.omega - one_.omega),
        aligned_(one_.aa * two_.bb + one_.bb * two_.aa),
        askew_(difference(one.body.shape.a, one.body.shape.b) *
               (Interval<Real>(one.body.shape.a) + Interval<Real>(one.body.shape.b)) *
               difference(two.body.shape.a, two.body.shape.b) *
               (Interval<Real>(two.body.shape.a) + Interval<Real>(two.body.shape.b))) {}

  Directions<Real> directions(const Real& time) const {
    const auto at = [&](const Constants<Real>& of) {
      return direction(of.angle + of.omega * Interval<Real>(time));
    };
    return from(at(one_), at(two_));
  }

  /// The cubic over the times middle ± half, from the directions at the middle.
  Cubic<Real> over(const Real& middle, const Real& half, const Directions<Real>& at_middle) const {
    const Interval<Real> time =
        half > 0 ? Interval<Real>::widened(middle - half, middle + half) : Interval<Real>(middle);
    const auto spread = [&](const Direction<Real>& at, const Interval<Real>& omega) {
      return half > 0 ? turned(at, most(omega) * half) : at;
    };
    const Jet<Real> dx = linear(x_, vx_, time), dy = linear(y_, vy_, time);
    const Jet<Real> e1 = adjugate_form(one_, spread(at_middle.one, one_.omega), dx, dy);
    const Jet<Real> e2 = adjugate_form(two_, spread(at_middle.two, two_.omega), dx, dy);
    const Jet<Real> s = sine(spread(at_middle.between, turning_), turning_);
    Jet<Real> trace = askew_ * square(s);
    trace.value = trace.value + aligned_;
    const Jet<Real> s1 = square(linear(one_.size, one_.rate, time));
    const Jet<Real> s2 = square(linear(two_.size, two_.rate, time));
    return {one_.det * s2, one_.det * s1 + s2 * trace - e1, two_.det * s2 + s1 * trace - e2,
            two_.det * s1};
  }

  Cubic<Real> at(const Real& time) const { return over(time, Real(0), directions(time)); }

  /// |d|² − (R₁ + R₂)² with the circumradii R = p + 2 q t + r t².
  struct CircleQuadratic {
    Interval<Real> p, q, r;
  };
  CircleQuadratic circles(const GrowingEllipse& one, const GrowingEllipse& two) const {
    const Interval<Real> a1(one.shape.a), a2(two.shape.a);
    const Interval<Real> reach = a1 * one_.size + a2 * two_.size;
    const Interval<Real> growth = a1 * one_.rate + a2 * two_.rate;
    return {square(x_) + square(y_) - square(reach), x_ * vx_ + y_ * vy_ - reach * growth,
            square(vx_) + square(vy_) - square(growth)};
  }

 private:
  static Interval<Real> difference(double x, double y) {
    return Interval<Real>(Real(x)) - Interval<Real>(Real(y));
  }
  static Real most(const Interval<Real>& x) { return std::max(Real(-x.low), Real(x.high)); }

  static Directions<Real> from(const Direction<Real>& u1, const Direction<Real>& u2) {
    return {u1,
            u2,
            {u1.cosine * u2.cosine + u1.sine * u2.sine, u1.cosine * u2.sine - u1.sine * u2.cosine}};
  }

  // dᵀ adj(Σ) d in the frame of the ellipse.
  static Jet<Real> adjugate_form(const Constants<Real>& of, const Direction<Real>& u,
                                 const Jet<Real>& dx, const Jet<Real>& dy) {
    const Jet<Real> c = cosine(u, of.omega), s = sine(u, of.omega);
    const Jet<Real> along = c * dx + s * dy, across = c * dy - s * dx;
    return of.bb * square(along) + of.aa * square(across);
  }

  Constants<Real> one_, two_;
  Interval<Real> x_, y_, vx_, vy_, turning_;
  // W = aligned + askew sin² of the relative angle.
  Interval<Real> aligned_, askew_;
};

// The root x > 0 of ∂R/∂x = 3 xxx x² + 2 xxy x + xyy, y = 1, where R is least. xxx is taken where
// it is largest over the piece: a smaller one, 0 for a body that grows from a point, would choose
// an x far out, which no later time of the piece could use.
template <class Real>
Real minimum_at(const Cubic<Real>& middle, const Cubic<Real>& piece) {
  using std::sqrt;
  const Real a = piece.xxx.value.high, b = middle.xxy.value.middle(), c = middle.xyy.value.middle();
  const Real square_root = sqrt(std::max(Real(b * b - 3 * a * c), Real(0)));
  return b < 0 ? Real((square_root - b) / (3 * a)) : Real(-c / (b + square_root));
}

template <class Real>
Interval<Real> taylor(const Jet<Real>& middle, const Jet<Real>& piece, const Real& half) {
  const Interval<Real> offset(-half, half);
  const Interval<Real> half_square(0,
                                   Interval<Real>::widened(half * half / 2, half * half / 2).high);
  return middle.value + middle.first * offset + piece.second * half_square;
}

/// A search from the left that stops where Real can decide no more.
template <class Real>
class Search {
 public:
  enum class Result { passed, contact, overlap, stuck };

  Search(const Flight<GrowingEllipse>& one, const Flight<GrowingEllipse>& two)
      : pair_(one, two), circles_(pair_.circles(one.body, two.body)) {}

  /// passed: disjoint at time 0; stuck: undecided.
  Result start() const {
    const Cubic<Real> now = pair_.at(Real(0));
    if (circles_.p.low > 0 || negative_somewhere(now, now)) return Result::passed;
    const Interval<Real> phi = now.discriminant().value;
    if (phi.high < 0) return Result::overlap;
    if (phi.low > 0 && (now.xxy.value.high < 0 || now.xyy.value.high < 0)) return Result::passed;
    const bool no_axis = now.xxy.value.low >= 0 && now.xyy.value.low >= 0;
    return no_axis ? Result::overlap : Result::stuck;
  }

  /// The times outside which the circumcircles are disjoint, within [0, horizon].
  Interval<Real> window(double horizon) const {
    const auto& [p, q, r] = circles_;
    const Interval<Real> none{Real(horizon), Real(horizon)};
    const Interval<Real> discriminant = square(q) - p * r;
    Interval<Real> part(0, Real(horizon));
    if (p.low <= 0) {
      // Overlapping circles; if they separate for good, after the one positive root.
      if (r.low > 0 && p.high < 0) part.high = std::min(part.high, last_root(q, r, discriminant));
      return part;
    }
    if (discriminant.high < 0) return none;
    // The roots are p/(−q ± √(q² − pr)); the first positive one has the larger denominator.
    const Interval<Real> denominator = root(discriminant) - q;
    if (denominator.high <= 0) return none;
    part.low = std::min(part.high, (Interval<Real>(p.low) / Interval<Real>(denominator.high)).low);
    if (r.low > 0) part.high = std::min(part.high, last_root(q, r, discriminant));
    return part.high > part.low ? part : none;
  }

  /// Searches from..to; on return `from` is the time up to which there is no contact. Stuck at a
  /// piece as short as `shortest`; content (passed) with one piece as long as `enough`.
  Result pass(Real& from, const Real& to, const Real& shortest, const Real& enough, int& pieces) {
    Real width = (to - from) / 2;
    while (from < to) {
      const Real end = width < to - from ? Real(from + width) : to;
      const Real middle = (from + end) / 2;
      if (end - from <= shortest || middle <= from || middle >= end) return Result::stuck;
      ++pieces;
      const Real half = std::max(Real(end - middle), Real(middle - from));
      const Directions<Real> directions = pair_.directions(middle);
      const Cubic<Real> at_middle = pair_.over(middle, Real(0), directions);
      const Cubic<Real> piece = pair_.over(middle, half, directions);
      Start start = Start::apart;
      if (negative_throughout(at_middle, piece, half) ||
          (start = at_start(piece, from, end - from)) == Start::leaving) {
        width = 4 * half;
        from = end;
        if (2 * half >= enough) return Result::passed;
      } else if (crosses(at_middle, piece, half, end)) {
        contact_ = {from, end};
        return Result::contact;
      } else if (start == Start::unclear && shortest > 0) {
        return Result::stuck;
      } else {
        width = middle - from;
      }
    }
    return Result::passed;
  }

  /// The root of Φ in `found`, where Φ' < 0, by interval Newton steps until they gain no more.
  Interval<Real> refined(Interval<Real> found) const {
    while (true) {
      const Real middle = found.middle();
      const Real half = std::max(Real(found.high - middle), Real(middle - found.low));
      const Directions<Real> directions = pair_.directions(middle);
      const Jet<Real> at = pair_.over(middle, Real(0), directions).discriminant();
      const Jet<Real> over = pair_.over(middle, half, directions).discriminant();
      const Interval<Real> slope = at.first + over.second * Interval<Real>(-half, half);
      if (slope.high >= 0) return found;
      const Interval<Real> next = Interval<Real>(middle) - at.value / slope;
      Interval<Real> both(std::max(found.low, next.low), std::min(found.high, next.high));
      if (both.width() > found.width() / 2) return both;
      found = both;
    }
  }

  const Interval<Real>& contact() const { return contact_; }

 private:
  static Real last_root(const Interval<Real>& q, const Interval<Real>& r,
                        const Interval<Real>& discriminant) {
    return ((root(discriminant) - q) / r).high;
  }

  static bool usable(const Real& x) { return x > 0 && x < 1 / std::numeric_limits<float>::min(); }

  static bool negative_somewhere(const Cubic<Real>& at_middle, const Cubic<Real>& piece) {
    const Real x = minimum_at(at_middle, piece);
    return usable(x) && piece.at(x).value.high < 0;
  }

  static bool negative_throughout(const Cubic<Real>& at_middle, const Cubic<Real>& piece,
                                  const Real& half) {
    const Real x = minimum_at(at_middle, piece);
    if (!usable(x)) return false;
    const Jet<Real> at = at_middle.at(x);
    if (at.value.high >= 0) return false;
    const Jet<Real> over = piece.at(x);
    return over.value.high < 0 || taylor(at, over, half).high < 0;
  }

  // How a piece that could not be passed from its middle begins. `leaving`: R, with x as it is best
  // at the start, falls, and stays negative all over the piece. `unclear`: it falls from where Real
  // cannot tell it from 0, so that no shorter piece will be passed either.
  enum class Start { apart, unclear, leaving };
  Start at_start(const Cubic<Real>& piece, const Real& from, const Real& width) const {
    const Cubic<Real> start = pair_.at(from);
    const Real x = minimum_at(start, start);
    if (!usable(x)) return Start::apart;
    const Jet<Real> at = start.at(x);
    if (at.first.high >= 0) return Start::apart;
    if (at.value.high >= 0) return Start::unclear;
    // A parabola that bends upwards is highest at its ends.
    const Interval<Real> s(width), half(Real(1) / 2);
    const Interval<Real> bend(std::max(piece.at(x).second.high, Real(0)));
    const Interval<Real> end = at.value + at.first * s + half * bend * square(s);
    return end.high < 0 ? Start::leaving : Start::apart;
  }

  bool crosses(const Cubic<Real>& at_middle, const Cubic<Real>& piece, const Real& half,
               const Real& end) const {
    if (pair_.at(end).discriminant().value.high >= 0) return false;
    const Jet<Real> at = at_middle.discriminant(), over = piece.discriminant();
    return (at.first + over.second * Interval<Real>(-half, half)).high < 0;
  }

  Pair<Real> pair_;
  typename Pair<Real>::CircleQuadratic circles_;
  Interval<Real> contact_;
};

// The nearest double that is not above a time (which is in the horizon).
template <class Real>
double below(const Real& time) {
  const auto nearest = static_cast<double>(time);
  return Real(nearest) <= time ? nearest : std::nextafter(nearest, 0);
}

template <class Real>
TrueContact described(TrueContact::Outcome outcome, const Interval<Real>& when, int pieces,
                      const Flight<GrowingEllipse>& one, const Flight<GrowingEllipse>& two) {
  TrueContact found;
  found.outcome = outcome;
  found.pieces = pieces;
  found.time = static_cast<long double>(when.middle());
  found.uncertainty = static_cast<long double>(when.width() / 2);
  const ClosestSurfaces there = closest_surfaces(one, two, found.time);
  found.normal = there.normal;
  found.approach_speed = static_cast<double>(there.approach_speed);
  return found;
}

}  // namespace

template <class Real>
TrueContact true_first_contact(const Flight<GrowingEllipse>& one, const Flight<GrowingEllipse>& two,
                               double horizon) {
  // Double decides down to pieces of this fraction of the search; a contact has usually been
  // isolated long before, and near a graze shorter pieces are beyond it.
  constexpr double shortest = 1e-6;
  using Outcome = TrueContact::Outcome;
  using Coarse = Search<double>;
  using Fine = Search<Real>;

  Coarse coarse(one, two);
  std::optional<Fine> fine;
  auto start = coarse.start();
  if (start == Coarse::Result::stuck) {
    fine.emplace(one, two);
    const auto again = fine->start();
    if (again == Fine::Result::stuck)
      return described<Real>(Outcome::undecided, Real(0), 0, one, two);
    start = again == Fine::Result::passed ? Coarse::Result::passed : Coarse::Result::overlap;
  }
  TrueContact result;
  if (start == Coarse::Result::overlap) {
    result.outcome = Outcome::overlap_at_start;
    return result;
  }

  const Interval<double> window = coarse.window(horizon);
  const double enough = 100 * shortest * window.width();
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  double from = window.low;
  while (true) {
    const auto roughly =
        coarse.pass(from, window.high, shortest * window.width(), unlimited, result.pieces);
    if (roughly == Coarse::Result::passed && from >= window.high) return result;
    if (!fine) fine.emplace(one, two);
    if (roughly == Coarse::Result::contact) {
      const Interval<double> contact = coarse.refined(coarse.contact());
      return described(Outcome::contact, fine->refined({Real(contact.low), Real(contact.high)}),
                       result.pieces, one, two);
    }
    Real reached = from;
    const auto finely =
        fine->pass(reached, Real(window.high), Real(0), Real(enough), result.pieces);
    if (finely == Fine::Result::contact)
      return described(Outcome::contact, fine->refined(fine->contact()), result.pieces, one, two);
    if (finely == Fine::Result::stuck)
      return described<Real>(Outcome::undecided, reached, result.pieces, one, two);
    from = below(reached);
  }
}

template TrueContact true_first_contact<long double>(const Flight<GrowingEllipse>&,
                                                     const Flight<GrowingEllipse>&, double);
template TrueContact true_first_contact<Float128>(const Flight<GrowingEllipse>&,
                                                  const Flight<GrowingEllipse>&, double);

TrueContact true_first_contact(const Flight<Ellipse>& one, const Flight<Ellipse>& two,
                               double horizon) {
  const auto constant = [](const Flight<Ellipse>& flight) -> Flight<GrowingEllipse> {
    return {{flight.body, 1, 0}, flight.pose, flight.motion};
  };
  return true_first_contact<long double>(constant(one), constant(two), horizon);
}

}  // namespace vitrel::bench
