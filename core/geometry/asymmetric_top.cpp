#include "core/geometry/asymmetric_top.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "core/elementary.h"
#include "core/geometry/free_flight.h"

namespace vitrel {

namespace {

// Smaller ratios of squares count as 0; the limit is well above underflow.
constexpr double negligible = 1e-280;

// Returns Carlson's R_F(x, y, z) by duplication; at most one argument may be 0.
double carlson_rf(double x, double y, double z) {
  constexpr double tolerance = 1.5e-3;  // the remainder of the series is of sixth order in it
  for (;;) {
    const double mean = (x + y + z) / 3;
    const double dx = 1 - x / mean, dy = 1 - y / mean, dz = 1 - z / mean;
    if (std::max({std::abs(dx), std::abs(dy), std::abs(dz)}) < tolerance) {
      const double e2 = dx * dy - dz * dz, e3 = dx * dy * dz;
      return (1 + (e2 / 24 - 0.1 - 3 * e3 / 44) * e2 + e3 / 14) / std::sqrt(mean);
    }
    const double lambda = std::sqrt(x * y) + std::sqrt(x * z) + std::sqrt(y * z);
    x = 0.25 * (x + lambda);
    y = 0.25 * (y + lambda);
    z = 0.25 * (z + lambda);
  }
}

// Returns K(m) by the arithmetic-geometric mean, given 1 − m > 0.
double complete_integral(double one_minus_m) {
  double a = 1, g = std::sqrt(one_minus_m);
  while (a - g > 1e-8 * a) std::tie(a, g) = std::pair(0.5 * (a + g), std::sqrt(a * g));
  return std::numbers::pi / (a + g);
}

/// The principal axes in the order of their moments, as a right-handed frame.
struct SortedAxes {
  std::array<int, 3> axis{0, 1, 2};
  double handedness;
  double i1, i2, i3;
  double d21, d32, d31;  // |I₂ − I₁| …, without cancellation

  SortedAxes(const Ellipsoid& shape, bool largest_moment_last) {
    const Vec3& lengths = shape.semi_axes;
    // The longest axis has the smallest moment.
    std::ranges::sort(axis, [&](int j, int k) {
      return largest_moment_last ? lengths[j] > lengths[k] : lengths[j] < lengths[k];
    });
    handedness = (axis[1] - axis[0] + 3) % 3 == 1 ? 1 : -1;
    const Vec3 moments = shape.inertia_per_mass();
    i1 = moments[axis[0]];
    i2 = moments[axis[1]];
    i3 = moments[axis[2]];
    const auto difference = [&](int j, int k) {
      const double one = lengths[axis[j]], two = lengths[axis[k]];
      return 0.2 * std::abs(one - two) * (one + two);
    };
    d21 = difference(0, 1);
    d32 = difference(1, 2);
    d31 = difference(0, 2);
  }

  Vec3 sorted(const Vec3& v) const { return {v[axis[0]], v[axis[1]], handedness * v[axis[2]]}; }
  /// (L² − 2EI₂)/(±1), positive if axis 3 is the one about which the body circulates.
  double excess(const Vec3& omega) const {
    return i3 * d32 * omega[2] * omega[2] - i1 * d21 * omega[0] * omega[0];
  }
};

/// Returns a frame whose third axis is along the angular momentum L. Its rows are its axes in body coordinates:
/// L̂ × (L̂ × e₃) and −L̂ × e₃, both normalised, and L̂.
Mat3 frame_along(const Vec3& momentum) {
  const Vec3 l = normalized(momentum);
  const double across = std::sqrt(l[0] * l[0] + l[1] * l[1]);
  const double x = l[0] / across, y = l[1] / across;
  Mat3 frame;
  frame << x * l[2], y * l[2], -across, -y, x, 0, l[0], l[1], l[2];
  return frame;
}

Mat3 about_third_axis(double cosine, double sine) {
  Mat3 turn;
  turn << cosine, -sine, 0, sine, cosine, 0, 0, 0, 1;
  return turn;
}

}  // namespace

double AsymmetricTop::max_acceleration_factor(const Ellipsoid& shape) {
  const Vec3 moments = shape.inertia_per_mass();
  double largest = 0;
  for (int i = 0; i < 3; ++i)
    largest = std::max(largest, std::abs(moments[(i + 1) % 3] - moments[(i + 2) % 3]) / moments[i]);
  return largest / std::numbers::sqrt3;
}

AsymmetricTop::AsymmetricTop(const Ellipsoid& shape, const Quaternion& orientation,
                             const Vec3& angular_velocity) {
  const Mat3 axes = rotation_matrix(orientation);
  const double speed = norm(angular_velocity);
  if (!shape.is_scalene() || !(speed > 0)) {
    rotate_uniformly(axes, angular_velocity);
    return;
  }
  const Vec3 own = axes.transpose() * angular_velocity / speed;

  SortedAxes body(shape, true);
  Vec3 omega = body.sorted(own);
  max_speed_ =
      speed * std::sqrt(omega[0] * omega[0] + omega[2] * omega[2] +
                        omega[1] * omega[1] * body.i2 * (body.i1 + body.d32) / (body.i1 * body.i3));
  if (body.excess(omega) < 0) {
    body = SortedAxes(shape, false);
    omega = body.sorted(own);
  }
  const Vec3 squares = omega.cwiseAbs2();
  if (squares[0] + squares[1] < negligible || squares[0] + squares[2] < negligible) {
    rotate_uniformly(axes, angular_velocity);
    return;
  }

  const auto& [axis, handedness, i1, i2, i3, d21, d32, d31] = body;
  is_uniform_ = false;
  axis_ = axis;
  handedness_ = handedness;
  moments_ = {i1, i2, i3};
  side_ = i3 > i1 ? 1 : -1;
  const double a = std::sqrt(squares[0] + squares[1] * i2 * d32 / (i1 * d31));
  const double b = a * std::sqrt(i1 * d31 / (i2 * d32));
  const double d =
      std::copysign(std::sqrt(squares[2] + squares[1] * i2 * d21 / (i3 * d31)), omega[2]);
  amplitudes_ = {a, std::copysign(b, side_ * d), d};
  const double m = i2 * d21 * b * b / (i3 * d31 * d * d);
  one_minus_m_ = std::max(body.excess(omega) / (d32 * i3 * d * d), negligible);
  const double p = std::abs(d) * std::sqrt(d32 * d31 / (i1 * i2));

  quarter_ = complete_integral(one_minus_m_);
  phase0_ = start_phase(omega[1] / amplitudes_[1], omega[0] / a);
  const double nu = i3 * d21 / (i1 * d32);
  const double pole = carlson_rf(nu, nu + m, 1 + nu);  // homogeneous of degree −½
  const double complementary_quarter = complete_integral(m);
  is_dual_ = m > 0.5;
  const double momentum = norm(moments_.cwiseProduct(omega));
  precession_rate_ = momentum / (i2 * p);
  if (is_dual_)
    set_dual_series(complementary_quarter, pole);
  else
    set_direct_series(complementary_quarter, pole);
  phase_rate_ = speed * p;
  amplitudes_ *= speed;

  start_ = Mat3::Identity();
  const Mat3 now = at(0).axes;
  start_ = axes * now.transpose();
}

void AsymmetricTop::rotate_uniformly(const Mat3& axes, const Vec3& angular_velocity) {
  is_uniform_ = true;
  start_ = axes;
  angular_velocity_ = angular_velocity;
  max_speed_ = norm(angular_velocity);
}

// Returns u between −2K and 2K for these values of sn u and cn u, which are normalised up to rounding.
double AsymmetricTop::start_phase(double sn, double cn) const {
  const double u = sn * carlson_rf(cn * cn, cn * cn + one_minus_m_ * sn * sn, cn * cn + sn * sn);
  return cn >= 0 ? u : std::copysign(2 * quarter_, sn) - u;
}

void AsymmetricTop::set_direct_series(double complementary_quarter, double pole) {
  scale_ = 0.5 * std::numbers::pi / quarter_;
  ratio_ = std::sqrt(std::sqrt(one_minus_m_));
  const double nome = exponential(-std::numbers::pi * complementary_quarter / quarter_);
  const double step = exponential(2 * scale_ * pole);
  double rising = exponential(scale_ * pole), value = 0, slope = 0;
  for (int n = 0; n < terms; ++n, rising *= step) {
    nome_powers_[n] = (n % 2 == 0 ? 1 : -1) * power(nome, n * (n + 1));
    sines_[n] = 0.5 * nome_powers_[n] * (rising - 1 / rising);
    cosines_[n] = 0.5 * nome_powers_[n] * (rising + 1 / rising);
    value += std::abs(cosines_[n]);
    slope += (2 * n + 1) * std::abs(sines_[n]);
  }
  precession_rate_ -= side_ * scale_ * slope / value;
  half_period_turn_ = 2 * precession_rate_ * quarter_ + side_ * std::numbers::pi;
}

void AsymmetricTop::set_dual_series(double complementary_quarter, double pole) {
  scale_ = 0.5 * std::numbers::pi / complementary_quarter;
  const double nome = exponential(-2 * scale_ * quarter_);
  const CosineAndSine step = cosine_and_sine(2 * scale_ * pole);
  auto [cosine, sine] = cosine_and_sine(scale_ * pole);
  double even_cosine = 1, even_sine = 0;  // of the angle 2nπη/2K'
  double theta2 = 0, theta3 = -1, theta4 = -1, slope = 0;
  const auto turn = [&](double& c, double& s) {
    std::tie(c, s) = std::pair(c * step.cosine - s * step.sine, s * step.cosine + c * step.sine);
  };
  for (int n = 0; n < terms; ++n, turn(cosine, sine), turn(even_cosine, even_sine)) {
    const double sign = n % 2 == 0 ? 1 : -1, square = power(nome, n * n);
    theta3 += 2 * square;
    theta4 += 2 * sign * square * even_cosine;
    slope -= 4 * n * sign * square * even_sine;
    const double positive = power(nome, n * (n + 1));
    nome_powers_[n] = sign * positive;
    nome_squares_[n] = square;
    sines_[n] = sign * sine;
    cosines_[n] = sign * cosine;
    theta2 += positive;
  }
  ratio_ = theta2 / theta3;
  precession_rate_ -= side_ * scale_ * slope / theta4;
  const Functions end = dual_functions(quarter_);
  half_period_turn_ =
      2 * (precession_rate_ * quarter_ + side_ * polar_angle(end.theta_imaginary, end.theta_real));
}

AsymmetricTop::Functions AsymmetricTop::direct_functions(double u) const {
  auto [cosine, sine] = cosine_and_sine(scale_ * u);
  const double step_cosine = (cosine - sine) * (cosine + sine), step_sine = 2 * sine * cosine;
  Functions f{0, 0, 0, 0};
  for (int n = 0; n < terms; ++n) {
    f.sn += nome_powers_[n] * sine;
    f.cn += std::abs(nome_powers_[n]) * cosine;
    f.theta_real += cosines_[n] * sine;
    f.theta_imaginary -= sines_[n] * cosine;
    std::tie(cosine, sine) =
        std::pair(cosine * step_cosine - sine * step_sine, sine * step_cosine + cosine * step_sine);
  }
  f.cn *= ratio_;
  return f;
}

// Everything is divided by eˣ, x = scale |u|, so that nothing overflows: with w = q e²ˣ ≤ 1,
//
//     2 (cosh, sinh)((2n + 1)x) q^(n(n + 1)) → wⁿ q^(n²) ± e^(−2(n + 1)x) q^(n(n + 1)).
AsymmetricTop::Functions AsymmetricTop::dual_functions(double u) const {
  const double w = exponential(2 * scale_ * (std::abs(u) - quarter_));
  const double decay = exponential(-scale_ * std::abs(u)), decay2 = decay * decay;
  Functions f{0, 0, 0, 0};
  double rising = 1, falling = 1, below = 0;  // wⁿ, e^(−2nx), q^(n(n − 1))
  double sign = 1;
  for (int n = 0; n < terms; ++n) {
    const double positive = std::abs(nome_powers_[n]);
    const double up = rising * nome_squares_[n], down = falling * decay2 * positive;
    f.sn += sign * (up - down);
    f.cn += sign * (rising * below + falling * nome_squares_[n]);
    f.theta_real += sines_[n] * (up + down);
    f.theta_imaginary += cosines_[n] * (up - down);
    rising *= w;
    falling *= decay2;
    below = positive;
    sign = -sign;
  }
  f.sn = std::copysign(f.sn, u);
  f.theta_imaginary = std::copysign(f.theta_imaginary, f.theta_imaginary * u);
  f.cn *= 2 * ratio_ * decay;
  return f;
}

AsymmetricTop::State AsymmetricTop::at(double time) const {
  if (is_uniform_) {
    const Mat3 turn = rotation_matrix(rotation(angular_velocity_ * time));
    return {turn * start_, angular_velocity_, Vec3::Zero()};
  }
  const double u = phase0_ + phase_rate_ * time;
  const double half_periods = std::round(u / (2 * quarter_));
  const double rest = u - half_periods * (2 * quarter_);
  const Functions f = functions(rest);
  // sn and cn change sign with every half period.
  const double sign = std::fmod(half_periods, 2) == 0 ? 1 : -1;
  const double scale = sign / std::sqrt(f.sn * f.sn + f.cn * f.cn);
  const double sn = scale * f.sn, cn = scale * f.cn;
  const double dn = std::sqrt(cn * cn + one_minus_m_ * sn * sn);

  const Vec3 omega = amplitudes_.cwiseProduct(Vec3(cn, sn, dn));
  const Vec3 momentum = moments_.cwiseProduct(omega);
  const Vec3 rate = momentum.cross(omega).cwiseQuotient(moments_);

  const auto [cosine, sine] =
      cosine_and_sine(half_periods * half_period_turn_ + precession_rate_ * rest);
  const double size =
      std::sqrt(f.theta_real * f.theta_real + f.theta_imaginary * f.theta_imaginary);
  const double x = f.theta_real / size, y = side_ * f.theta_imaginary / size;
  const Mat3 sorted = start_ * about_third_axis(cosine * x - sine * y, sine * x + cosine * y) *
                      frame_along(momentum);
  State state{{}, sorted * omega, sorted * rate};
  state.axes.col(axis_[0]) = sorted.col(0);
  state.axes.col(axis_[1]) = sorted.col(1);
  state.axes.col(axis_[2]) = handedness_ * sorted.col(2);
  return state;
}

}  // namespace vitrel
