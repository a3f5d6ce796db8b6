#pragma once

#include "core/contact/simd.h"
#include "core/geometry/growing.h"

namespace vitrel {

/// A vector with components of type T: double, the two bodies of a pair, or a SIMD batch (simd.h).
template <class T>
struct Vec3Of {
  T x, y, z;
};

template <class T, class U>
VITREL_INLINE auto dot(const Vec3Of<T>& u, const Vec3Of<U>& v) {
  using Sum = std::conditional_t<std::is_same_v<T, double>, U, T>;
  return Sum(u.x * v.x + u.y * v.y + u.z * v.z);
}

/// A unit vector n with an orthonormal basis of its tangent plane: right-handed, e₁ × e₂ = n.
template <class T>
struct AxisOf {
  Vec3Of<T> n, e1, e2;
};

/// Completes n to an orthonormal basis without a square root; the result is smooth in n except at n_z = 0 (Duff et al.,
/// 2017).
template <class T>
VITREL_INLINE AxisOf<T> completed(const Vec3Of<T>& n) {
  using detail::signs;
  const T sign = signs(n.z);
  const T a = -1. / (sign + n.z);
  const T b = n.x * n.y * a;
  return {n, {1. + sign * (n.x * n.x * a), sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

/// An ellipsoid at one instant, given by the rows of G = diag(a, b, c) Rᵀ, which are its semi-axes as vectors. The
/// ellipsoid is the set of Gᵀu with |u| ≤ 1.
template <class T>
struct AxesOf {
  Vec3Of<T> first, second, third;
};

/// The support function h(n) = |G n| of an ellipsoid and its derivatives. The surface point with outward normal
/// n is x = h n + s₁ e₁ + s₂ e₂. The Hessian of h, H = Σ/h − x xᵀ/h, has the radii of curvature as its
/// eigenvalues in the plane of e₁ and e₂.
template <class T>
struct SupportOf {
  T height;         ///< h
  T s1, s2;         ///< x·e₁, x·e₂
  T h11, h12, h22;  ///< e_i·H e_j
};

template <class T, class B, class A>
VITREL_INLINE SupportOf<T> support_along(const AxesOf<B>& body, const AxisOf<A>& axis) {
  using std::sqrt;
  const auto image = [&](const Vec3Of<A>& v) -> Vec3Of<T> {
    return {dot(body.first, v), dot(body.second, v), dot(body.third, v)};
  };
  const Vec3Of<T> m = image(axis.n), w1 = image(axis.e1), w2 = image(axis.e2);
  SupportOf<T> s;
  const T square = dot(m, m);
  s.height = sqrt(square);
  const T inverse = 1. / s.height;
  s.s1 = dot(m, w1) * inverse;
  s.s2 = dot(m, w2) * inverse;
  s.h11 = (dot(w1, w1) - s.s1 * s.s1) * inverse;
  s.h12 = (dot(w1, w2) - s.s1 * s.s2) * inverse;
  s.h22 = (dot(w2, w2) - s.s2 * s.s2) * inverse;
  return s;
}

/// An angular velocity along an axis: ω·n, ω·e₁, ω·e₂.
template <class T>
struct SpinOf {
  T on, o1, o2;
};

template <class T, class B, class A>
VITREL_INLINE SpinOf<T> spin_along(const Vec3Of<B>& omega, const AxisOf<A>& axis) {
  return {dot(omega, axis.n), dot(omega, axis.e1), dot(omega, axis.e2)};
}

/// The time derivatives of the support function at a fixed n while the body rotates, and the gradient of −ḣ in the
/// plane of e₁ and e₂. Rotating the body is the same as rotating n the other way, so ḣ = −x·(ω × n) and
/// ḧ = (ω × n)·H(ω × n) + (x·ω)(ω·n) − ω² h.
template <class T>
struct SupportRates {
  T rate;            ///< ḣ
  T second;          ///< ḧ
  T mixed1, mixed2;  ///< −∂ḣ/∂e₁, −∂ḣ/∂e₂
};

template <class T>
VITREL_INLINE SupportRates<T> support_rates(const SupportOf<T>& s, const SpinOf<T>& w) {
  const T hq1 = s.h11 * w.o2 - s.h12 * w.o1;
  const T hq2 = s.h12 * w.o2 - s.h22 * w.o1;
  return {s.s2 * w.o1 - s.s1 * w.o2,
          (hq1 * w.o2 - hq2 * w.o1) + w.on * (s.s1 * w.o1 + s.s2 * w.o2) -
              s.height * (w.o1 * w.o1 + w.o2 * w.o2),
          hq1 + (w.on * s.s2 - w.o2 * s.height), hq2 + (w.o1 * s.height - w.on * s.s1)};
}

/// Returns a bound of ḧ for `duration`, which may be negative (backwards), from bounds of the derivatives of h² over
/// that time, |(h²)''|/2 ≤ `second` and |(h²)'''|/2 ≤ `third`: ḧ = ((h²)''/2 − ḣ²)/h is at most q/h_min with
///
///     q = min(second, h ḧ + ḣ² + third t),   h_min² = max(c², h² − 2 |h ḣ| t − second t²),
///
/// where h and its derivatives are the present ones, c is the shortest semi-axis, the term |h ḣ| counts only if h
/// decreases, and negative q counts as 0.
template <class T>
VITREL_INLINE T bounded_acceleration(const SupportOf<T>& s, const SupportRates<T>& r,
                                     const T& second, const T& third, const T& cc,
                                     const T& duration) {
  using detail::positive_part;
  using std::sqrt;
  const T time = abs(duration);
  const T now = s.height * r.second + r.rate * r.rate;
  const T rising = min(second, now + third * time);
  const T slope = 2. * s.height * r.rate;
  const T least = s.height * s.height - positive_part(-slope * duration) - second * time * time;
  const T min_squared = -min(-least, -cc);
  return positive_part(rising) / sqrt(min_squared);
}

/// Returns a bound of ḧ for `duration`, which may be negative (backwards), while a body rotates about a constant ω.
///
/// In the frame of the body, n rotates about u = ω/|ω| at a constant angle α. Let S be the shape matrix in that frame,
/// Δ ≤ a² − c² the difference of its eigenvalues in the plane normal to u, and τ = |S u − u (u·S u)|. With φ = |ω| t,
///
///     h² = const + sin 2α τ cos(φ − φ₁) + ½ sin²α Δ cos 2(φ − φ₂),
///
/// so that |(h²)''|/2 ≤ ω² Q and |(h²)'''|/2 ≤ 2 |ω|³ Q with Q = |sin α cos α| τ + sin²α Δ. A spheroid that rotates
/// about an axis normal to its own has τ = 0.
template <class T>
VITREL_INLINE T support_acceleration_bound(const SupportOf<T>& s, const SupportRates<T>& r,
                                           const SpinOf<T>& w, const T& delta, const T& tau,
                                           const T& cc, const T& duration) {
  using std::sqrt;
  const T across = w.o1 * w.o1 + w.o2 * w.o2;  // ω² sin²α
  const T along = w.on * w.on;
  const T square = across + along;
  const T amplitude = sqrt(across * along) * tau + across * delta;
  return bounded_acceleration<T>(s, r, amplitude, 2. * sqrt(square) * amplitude, cc, duration);
}

/// A vector of the tangent plane, in the basis e₁, e₂.
using Tangent = Vec2;

/// Two ellipsoids at one instant. Element 0 belongs to body 1.
struct EllipsoidPair {
  AxesOf<SimdPair> axes;  ///< at size 1
  SimdPair size;          ///< factor of the semi-axes
  Vec3 d;                 ///< from centre 1 to centre 2
};

/// The support gap g = n·d − σ₁h₁ − σ₂h₂ at a unit vector n, where σ are the sizes, with its gradient and second
/// derivatives along the great circles through n. In the plane of e₁ and e₂, C = Σ σ H + g.
struct GapAlongAxis3 : SupportOf<SimdPair> {
  double gap = 0;
  Tangent slope;
  double c11 = 1, c12 = 0, c22 = 1;  ///< C = −∇∇g

  double determinant() const { return c11 * c22 - c12 * c12; }
  bool is_concave() const { return c11 + c22 > 0 && determinant() > 0; }
  /// (det C) C⁻¹ t
  Tangent adjugate(const Tangent& t) const {
    return {c22 * t[0] - c12 * t[1], c11 * t[1] - c12 * t[0]};
  }
  /// The Newton step to the maximum or, where g is not concave, the gradient over h₁ + h₂.
  Tangent newton() const {
    return is_concave() ? Tangent(adjugate(slope) / determinant())
                        : Tangent(slope / reduce(height));
  }
  /// The gain in g of the Newton step, to second order (meaningful only if g is concave).
  double gain() const { return 0.5 * dot(slope, newton()); }
};

using Axis3 = AxisOf<double>;

/// Returns τ of support_acceleration_bound, from the components of u = ω/|ω| along the axes of the body and its squared
/// semi-axes.
template <class T>
VITREL_INLINE T tumbling(const Vec3Of<T>& u, const Vec3Of<T>& squares) {
  using std::sqrt;
  const T mean = squares.x * u.x * u.x + squares.y * u.y * u.y + squares.z * u.z * u.z;
  const Vec3Of<T> rest{(squares.x - mean) * u.x, (squares.y - mean) * u.y,
                       (squares.z - mean) * u.z};
  return sqrt(dot(rest, rest));
}

/// `components` and `vector` convert between the two vector types.
inline Vec3Of<double> components(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}
inline Vec3 vector(const Vec3Of<double>& v) {
  return {v.x, v.y, v.z};
}

VITREL_INLINE GapAlongAxis3 gap_along(const EllipsoidPair& pair, const Axis3& axis) {
  GapAlongAxis3 g;
  static_cast<SupportOf<SimdPair>&>(g) = support_along<SimdPair>(pair.axes, axis);
  const auto total = [&](const SimdPair& of) { return reduce(pair.size * of); };
  const Vec3Of<double> d = components(pair.d);
  g.gap = dot(axis.n, d) - total(g.height);
  g.slope = {dot(axis.e1, d) - total(g.s1), dot(axis.e2, d) - total(g.s2)};
  g.c11 = total(g.h11) + g.gap;
  g.c12 = total(g.h12);
  g.c22 = total(g.h22) + g.gap;
  return g;
}

}  // namespace vitrel
