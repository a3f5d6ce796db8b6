#include "core/contact/ellipse_gap.h"

#include <cmath>

namespace vitrel {

namespace {

// In two dimensions F(λ) needs no inverse: with w_i = adj(Σ_i) d and μ = 1 − λ,
// F = λμ (μ p₁ + λ p₂)/(μ² D₁ + λμ M + λ² D₂), p_i = d·w_i, D_i = det Σ_i, M = tr(adj(Σ₁) Σ₂).
class PerramWertheimRatio {
 public:
  explicit PerramWertheimRatio(const EllipsePair& pair) : d_(pair.d) {
    const SimdPair size_squared = pair.size * pair.size;
    const SimdPair bb = size_squared * pair.bb;
    const SimdPair aa_minus_bb = size_squared * pair.aa_minus_bb;
    const SimdPair aa = bb + aa_minus_bb;
    const SimdPair along = pair.ux * d_.x() + pair.uy * d_.y();
    const SimdPair across = pair.ux * d_.y() - pair.uy * d_.x();
    wx_ = bb * along * pair.ux - aa * across * pair.uy;
    wy_ = bb * along * pair.uy + aa * across * pair.ux;
    p_ = bb * (along * along) + aa * (across * across);
    det_ = aa * bb;
    const double s = pair.ux[0] * pair.uy[1] - pair.uy[0] * pair.ux[1];
    mixed_ = bb[0] * aa[1] + aa[0] * bb[1] + aa_minus_bb[0] * aa_minus_bb[1] * s * s;
  }

  // Returns the λ for which λ : μ is the ratio of the radii of the two ellipses along d.
  double circle_like() const {
    const double r1 = std::sqrt(det_[0] * p_[1]), r2 = std::sqrt(det_[1] * p_[0]);
    return r1 + r2 > 0 ? r1 / (r1 + r2) : 0.5;
  }

  // Returns C⁻¹d as a unit vector.
  Vec2 axis(double lambda) const { return unit_sum(1 - lambda, lambda); }
  // Returns C⁻¹d for the λ of circle_like, with its √x : √y replaced by (3x + y) : (x + 3y).
  Vec2 circle_like_axis() const {
    const double x = det_[1] * p_[0], y = det_[0] * p_[1];
    return unit_sum(3 * x + y, x + 3 * y);
  }

  // Whether F > 1, a number with the sign of dF/dλ, and the Newton step towards dF/dλ = 0.
  struct Point {
    bool above_one;
    double slope;
    double newton_step;
  };
  Point at(double lambda) const {
    const double mu = 1 - lambda;
    const double p = mu * p_[0] + lambda * p_[1];
    const double dp = p_[1] - p_[0];
    const double top = lambda * mu * p;
    const double dtop = (mu - lambda) * p + lambda * mu * dp;
    const double ddtop = -2 * p + 2 * (mu - lambda) * dp;
    const double bottom = mu * mu * det_[0] + lambda * mu * mixed_ + lambda * lambda * det_[1];
    const double dbottom = -2 * mu * det_[0] + (mu - lambda) * mixed_ + 2 * lambda * det_[1];
    const double ddbottom = 2 * (det_[0] - mixed_ + det_[1]);
    const double slope = dtop * bottom - top * dbottom;
    const double dslope = ddtop * bottom - top * ddbottom;
    return {top > bottom, slope, -slope / dslope};
  }

 private:
  // For degenerate bodies (points) only d is left as a direction, and for coinciding centres not even d.
  Vec2 unit_sum(double weight1, double weight2) const {
    Vec2 w(weight1 * wx_[0] + weight2 * wx_[1], weight1 * wy_[0] + weight2 * wy_[1]);
    if (w.isZero(0)) w = d_.isZero(0) ? Vec2(1, 0) : d_;
    const double square = squared_norm(w);
    return std::sqrt(square) * (1 / square) * w;
  }

  Vec2 d_;
  SimdPair wx_, wy_, p_, det_;
  double mixed_;
};

constexpr int max_lambda_steps = 100;

}  // namespace

namespace detail {

Vec2 initial_axis(const EllipsePair& pair) {
  return PerramWertheimRatio(pair).circle_like_axis();
}

SeparatingAxis<Vec2> find_separating_axis(const EllipsePair& pair) {
  const PerramWertheimRatio f(pair);
  double lambda = f.circle_like();
  double low = 0, high = 1;
  for (int step = 0; step < max_lambda_steps; ++step) {
    const auto here = f.at(lambda);
    if (here.above_one) return {f.axis(lambda), true};
    (here.slope > 0 ? low : high) = lambda;
    double next = lambda + here.newton_step;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - lambda) <= 1e-15 * lambda) break;
    lambda = next;
  }
  return {f.axis(lambda), false};
}

template bool improve_axis(const EllipsePair&, Vec2&, GapAlongAxis&);

}  // namespace detail

SupportGap support_gap(const Ellipse& one, const Vec2& u1, const Ellipse& two, const Vec2& u2,
                       const Vec2& d) {
  return detail::largest_gap(EllipsePair(one, u1, two, u2, d));
}

SupportGap support_gap(const Ellipse& one, double angle1, const Ellipse& two, double angle2,
                       const Vec2& d) {
  return support_gap(one, direction(angle1), two, direction(angle2), d);
}

bool separated(const Ellipse& one, const Vec2& u1, const Ellipse& two, const Vec2& u2,
               const Vec2& d, double margin) {
  return detail::are_separated(one, two, d, margin,
                               [&] { return EllipsePair(one, u1, two, u2, d); });
}

}  // namespace vitrel
