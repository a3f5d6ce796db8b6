#include "bench/lab/reference/first_contact.h"

#include <vector>

#include "bench/lab/reference/interval_jet.h"

namespace vitrel::lab {

namespace {

struct Invariants {
  Jet g1, g2, psi;
};

// Ψ = G1²G2² + 18 G1G2 − 4q G1³ − 4 G2³/q − 27 with q = (a₂b₂)²/(a₁b₁)², G1 = 1 + tr(Σ₁A₂) − dᵀA₂d and
// G2 the same with 1 and 2 exchanged; traces by the relative angle, dᵀA d in the frame of the ellipse.
class PsiOverTime {
 public:
  PsiOverTime(const Flight<Ellipse>& one, const Flight<Ellipse>& two) : one_(one), two_(two) {
    const Real areas = Real(two.body.a) * two.body.b / (Real(one.body.a) * one.body.b);
    q_ = areas * areas;
  }

  Invariants over(const Interval& time) const {
    const Real turn = Real(two_.pose.angle) - one_.pose.angle;
    const Real turning = Real(two_.motion.angular_velocity) - one_.motion.angular_velocity;
    const Jet c = cosine(turn, turning, time);
    const Jet cc = c * c;
    Invariants at;
    at.g1 = Jet(1) + trace(one_.body, two_.body, cc) - distance_in(two_, time);
    at.g2 = Jet(1) + trace(two_.body, one_.body, cc) - distance_in(one_, time);
    const Jet product = at.g1 * at.g2;
    at.psi = product * product + Jet(18) * product - Jet(4 * q_) * at.g1 * at.g1 * at.g1 -
             Jet(4 / q_) * at.g2 * at.g2 * at.g2 - Jet(27);
    return at;
  }

 private:
  // tr(Σ_i A_j) = same cos² + crossed sin², with the angle between the axes.
  static Jet trace(const Ellipse& i, const Ellipse& j, const Jet& cos_squared) {
    const auto ratio = [](Real x, Real y) { return x * x / (y * y); };
    const Real same = ratio(i.a, j.a) + ratio(i.b, j.b);
    const Real crossed = ratio(i.a, j.b) + ratio(i.b, j.a);
    return Jet(crossed) + Jet(same - crossed) * cos_squared;
  }

  // dᵀ A d in the frame of one of the ellipses.
  Jet distance_in(const Flight<Ellipse>& frame, const Interval& time) const {
    const Vec2& r1 = one_.pose.position;
    const Vec2& r2 = two_.pose.position;
    const Vec2& v1 = one_.motion.velocity;
    const Vec2& v2 = two_.motion.velocity;
    const Jet dx = linear(Real(r2.x()) - r1.x(), Real(v2.x()) - v1.x(), time);
    const Jet dy = linear(Real(r2.y()) - r1.y(), Real(v2.y()) - v1.y(), time);
    const Jet c = cosine(frame.pose.angle, frame.motion.angular_velocity, time);
    const Jet s = sine(frame.pose.angle, frame.motion.angular_velocity, time);
    const Jet along = c * dx + s * dy;
    const Jet across = c * dy - s * dx;
    const Real a = frame.body.a, b = frame.body.b;
    return Jet(1 / (a * a)) * along * along + Jet(1 / (b * b)) * across * across;
  }

  const Flight<Ellipse>& one_;
  const Flight<Ellipse>& two_;
  Real q_;
};

Interval enclosure(const Jet& middle, const Interval& second, const Interval& offset) {
  return middle.value + middle.first * offset + Interval(0.5L) * second * offset * offset;
}

// The sign change of Ψ on [low, high], where it falls: to the last bit.
Real bisect(const PsiOverTime& psi, Real low, Real high) {
  while (true) {
    const Real middle = 0.5L * (low + high);
    if (middle <= low || middle >= high) return low;
    (psi.over(Interval(middle)).psi.value.middle() > 0 ? low : high) = middle;
  }
}

}  // namespace

TrueContact true_first_contact(const Flight<Ellipse>& one, const Flight<Ellipse>& two,
                               double horizon) {
  const PsiOverTime psi(one, two);
  const Invariants start = psi.over(Interval(0));
  const bool disjoint =
      start.psi.value.low > 0 && (start.g1.value.high < 0 || start.g2.value.high < 0);
  if (!disjoint) return {TrueContact::Outcome::overlap_at_start, 0, 0};

  TrueContact result;
  // Pieces still to look at, the leftmost on top.
  std::vector<Interval> pieces{Interval(0, horizon)};
  while (!pieces.empty()) {
    const Interval piece = pieces.back();
    pieces.pop_back();
    ++result.pieces;
    const Real middle = piece.middle();
    const Jet over = psi.over(piece).psi;
    const Jet at_middle = psi.over(Interval(middle)).psi;
    const Interval offset(piece.low - middle, piece.high - middle);
    if (over.value.low > 0 || enclosure(at_middle, over.second, offset).low > 0) continue;
    const Interval slope = at_middle.first + over.second * offset;
    if (slope.high < 0) {
      if (psi.over(Interval(piece.high)).psi.value.low > 0) continue;
      if (psi.over(Interval(piece.high)).psi.value.high < 0)
        return {TrueContact::Outcome::contact, bisect(psi, piece.low, piece.high), result.pieces};
    }
    if (middle <= piece.low || middle >= piece.high)
      return {TrueContact::Outcome::undecided, piece.low, result.pieces};
    pieces.push_back({middle, piece.high});
    pieces.push_back({piece.low, middle});
  }
  return result;
}

}  // namespace vitrel::lab
