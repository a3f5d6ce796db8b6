#include "core/contact/ellipse_vieillard_baron.h"

#include <cmath>

#include "core/extended.h"

namespace vitrel {
namespace {

template <class Real>
Real square(Real x) {
  return x * x;
}

/// Returns xᵀAx, which is 1 on the boundary of the ellipse about the origin.
template <class Real>
Real quadric(const EllipseAxes<Real>& e, Real x, Real y) {
  return square((x * e.cosine + y * e.sine) / e.a) + square((y * e.cosine - x * e.sine) / e.b);
}

/// Returns tr(Σ₁A₂), where cosine and sine are those of the angle between the major axes.
template <class Real>
Real trace(const EllipseAxes<Real>& one, const EllipseAxes<Real>& two, Real cosine, Real sine) {
  return square(cosine) * (square(one.a / two.a) + square(one.b / two.b)) +
         square(sine) * (square(one.a / two.b) + square(one.b / two.a));
}

}  // namespace

template <class Real>
VieillardBaron<Real> vieillard_baron(const EllipseAxes<Real>& one, const EllipseAxes<Real>& two,
                                     Real dx, Real dy) {
  const Real cosine = one.cosine * two.cosine + one.sine * two.sine;
  const Real sine = one.cosine * two.sine - one.sine * two.cosine;
  const Real g1 = 1 + trace(one, two, cosine, sine) - quadric(two, dx, dy);
  const Real g2 = 1 + trace(two, one, cosine, sine) - quadric(one, dx, dy);
  const Real q = square((two.a * two.b) / (one.a * one.b));
  const Real g12 = g1 * g2;
  const Real psi = g12 * (g12 + 18) - 4 * (q * g1 * g1 * g1 + g2 * g2 * g2 / q) - 27;
  return {psi, g1, g2};
}

template VieillardBaron<double> vieillard_baron(const EllipseAxes<double>&,
                                                const EllipseAxes<double>&, double, double);
template VieillardBaron<long double> vieillard_baron(const EllipseAxes<long double>&,
                                                     const EllipseAxes<long double>&, long double,
                                                     long double);
template VieillardBaron<DoubleDouble> vieillard_baron(const EllipseAxes<DoubleDouble>&,
                                                      const EllipseAxes<DoubleDouble>&,
                                                      DoubleDouble, DoubleDouble);

VieillardBaron<double> vieillard_baron(const Ellipse& one, double angle1, const Ellipse& two,
                                       double angle2, const Vec2& d) {
  return vieillard_baron<double>({one.a, one.b, std::cos(angle1), std::sin(angle1)},
                                 {two.a, two.b, std::cos(angle2), std::sin(angle2)}, d.x(), d.y());
}

}  // namespace vitrel
