#include "core/geometry/ellipse.h"

#include <cmath>

#include "core/elementary.h"

namespace vitrel {

double perimeter(const Ellipse& ellipse) {
  const double ratio = ellipse.b / ellipse.a;
  return 4 * ellipse.a * std::comp_ellint_2(std::sqrt((1 - ratio) * (1 + ratio)));
}

Mat2 shape_matrix(const Ellipse& ellipse, double angle) {
  const auto [c, s] = cosine_and_sine(angle);
  const double aa = ellipse.a * ellipse.a;
  const double bb = ellipse.b * ellipse.b;
  Mat2 sigma;
  sigma(0, 0) = aa * c * c + bb * s * s;
  sigma(1, 1) = aa * s * s + bb * c * c;
  sigma(0, 1) = sigma(1, 0) = (aa - bb) * c * s;
  return sigma;
}

}  // namespace vitrel
