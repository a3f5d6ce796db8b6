#include "analysis/dynamics/diffusion.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "core/error.h"
#include "core/special_values.h"

namespace vitrel {

namespace {

// Ratio of the longest to the shortest time of the fit: the maximum, the minimum, and the one if m is not straight.
constexpr double longest_window = 27, shortest_window = 3, later_window = 9;
constexpr double chance = 3;       // number of standard errors within which two slopes agree
constexpr double tolerance = 0.1;  // change of the slope that a coefficient may have as its error

void check(const MeanSquareCurve& m) {
  if (m.value.size() != m.time.size() || m.error.size() != m.time.size())
    throw UserError(
        fmt::format("diffusion: {} times, {} values and {} errors; a mean square has equally many",
                    m.time.size(), m.value.size(), m.error.size()));
  if (!std::is_sorted(m.time.begin(), m.time.end(), std::less_equal<>()) ||
      (!m.time.empty() && m.time.front() <= 0))
    throw UserError("diffusion: the times of a mean square must be above 0 and ascend");
}

MeanSquareCurve points_with_error(const MeanSquareCurve& m) {
  MeanSquareCurve points;
  points.duration = m.duration;
  for (std::size_t k = 0; k < m.time.size(); ++k) {
    if (!(m.error[k] > 0)) continue;
    points.time.push_back(m.time[k]);
    points.value.push_back(m.value[k]);
    points.error.push_back(m.error[k]);
  }
  return points;
}

/// Returns ∫ w(d) overlap(d)² dd for lags s ≤ t of a run, where d = b − a, and w counts the pairs of origins a in [0,
/// run − s], b in [0, run − t]. The integrand is a cubic between the bounds, where Simpson's rule is exact.
double squared_overlap(double s, double t, double run) {
  const auto integrand = [&](double d) {
    const double overlap = std::min(s, d + t) - std::max(0.0, d);
    const double pairs = std::min(run - s, run - t - d) - std::max(0.0, -d);
    return pairs * overlap * overlap;
  };
  const double bounds[] = {std::max(-t, s - run), s - t, 0, std::min(s, run - t)};
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double from = bounds[k], to = bounds[k + 1];
    sum += (to - from) / 6 * (integrand(from) + 4 * integrand((from + to) / 2) + integrand(to));
  }
  return sum;
}

/// Returns the covariance of the mean squares at two times, up to a factor, if all motion is diffusion.
double diffusive_covariance(double s, double t, double run) {
  return run > t ? squared_overlap(s, t, run) / (run - s) / (run - t) : s * s;
}

/// Returns the covariance of the points, from the correlations of diffusion and their own errors.
Eigen::MatrixXd covariance(const MeanSquareCurve& m, const Eigen::VectorXd& variance) {
  const auto n = static_cast<Eigen::Index>(m.time.size());
  Eigen::MatrixXd result(n, n);
  for (Eigen::Index k = 0; k < n; ++k)
    for (Eigen::Index l = k; l < n; ++l)
      result(k, l) = result(l, k) = m.error[k] * m.error[l] *
                                    diffusive_covariance(m.time[k], m.time[l], m.duration) /
                                    std::sqrt(variance[k] * variance[l]);
  return result;
}

/// A straight line fitted to part of the curve has the slope Σ c_k m_k.
class Slopes {
 public:
  explicit Slopes(MeanSquareCurve curve) : m_(std::move(curve)), variance_(m_.time.size()) {
    for (Eigen::Index k = 0; k < variance_.size(); ++k)
      variance_[k] = diffusive_covariance(m_.time[k], m_.time[k], m_.duration);
    covariance_ = covariance(m_, variance_);
  }

  const MeanSquareCurve& curve() const { return m_; }

  /// Returns the coefficients c for the points [begin, end); the others are 0.
  Eigen::VectorXd coefficients(std::size_t begin, std::size_t end) const {
    double sum = 0, mean = 0;
    for (std::size_t k = begin; k < end; ++k) sum += weight(k), mean += weight(k) * m_.time[k];
    mean /= sum;
    Eigen::VectorXd c = Eigen::VectorXd::Zero(covariance_.rows());
    double scale = 0;
    for (std::size_t k = begin; k < end; ++k) {
      c[static_cast<Eigen::Index>(k)] = weight(k) * (m_.time[k] - mean);
      scale += weight(k) * (m_.time[k] - mean) * (m_.time[k] - mean);
    }
    return c / scale;
  }
  double value(const Eigen::VectorXd& c) const {
    return c.dot(Eigen::Map<const Eigen::VectorXd>(m_.value.data(), c.size()));
  }
  double error(const Eigen::VectorXd& c) const { return std::sqrt(c.dot(covariance_ * c)); }

  /// Returns the first point at or after a time, up to rounding.
  std::size_t index(double time) const {
    const auto at = std::lower_bound(m_.time.begin(), m_.time.end(), time * (1 - 1e-9));
    return static_cast<std::size_t>(at - m_.time.begin());
  }

 private:
  double weight(std::size_t k) const { return 1 / variance_[static_cast<Eigen::Index>(k)]; }

  MeanSquareCurve m_;
  Eigen::VectorXd variance_;  // variance of diffusion, up to a factor
  Eigen::MatrixXd covariance_;
};

/// Returns where the second half of a window begins, which goes from a point to the end.
std::size_t middle_of(const Slopes& slopes, std::size_t begin) {
  const std::vector<double>& time = slopes.curve().time;
  return slopes.index(std::sqrt(time[begin] * time.back()));
}

/// The slopes of both halves of a window, from a point to the end.
struct Halves {
  double change;  ///< later slope − earlier slope
  double error;   ///< error of the change
  double later;
};

Halves halves(const Slopes& slopes, std::size_t begin) {
  const std::size_t middle = middle_of(slopes, begin);
  const Eigen::VectorXd earlier = slopes.coefficients(begin, middle);
  const Eigen::VectorXd later = slopes.coefficients(middle, slopes.curve().time.size());
  const Eigen::VectorXd difference = later - earlier;
  return {slopes.value(difference), slopes.error(difference), slopes.value(later)};
}

bool straight(const Halves& h) {
  return std::abs(h.change) <= chance * h.error;
}

/// Returns whether both halves of a window have two points, which a slope needs.
bool has_halves(const Slopes& slopes, std::size_t begin) {
  const std::size_t middle = middle_of(slopes, begin);
  return middle >= begin + 2 && slopes.curve().time.size() >= middle + 2;
}

bool enough_points(const Slopes& slopes) {
  const std::vector<double>& time = slopes.curve().time;
  return time.size() >= 4 && time.back() >= later_window * time.front() * (1 - 1e-9) &&
         has_halves(slopes, slopes.index(time.back() / later_window));
}

/// Returns where the window begins: at m = 1, but not too near to either end.
std::size_t first_point(const Slopes& slopes) {
  const MeanSquareCurve& m = slopes.curve();
  const auto moved = std::ranges::find_if(m.value, [](double value) { return value >= 1; });
  const double longest = m.time.back();
  const std::size_t begin =
      slopes.index(std::clamp(m.time[static_cast<std::size_t>(moved - m.value.begin())],
                              longest / longest_window, longest / shortest_window));
  return has_halves(slopes, begin) ? begin : slopes.index(longest / later_window);
}

}  // namespace

DiffusionCoefficient no_coefficient(const std::string& reason) {
  return {unknown, unknown, unknown, unknown, reason};
}

DiffusionCoefficient diffusion_coefficient(const MeanSquareCurve& curve, int dimension) {
  check(curve);
  const Slopes slopes(points_with_error(curve));
  const MeanSquareCurve& m = slopes.curve();
  if (!enough_points(slopes))
    return no_coefficient(
        "the times with known errors are too few, or span less than a factor of nine");
  if (!(m.value.back() >= 1))
    return no_coefficient(fmt::format("the mean square is only {:.3g} at the longest time {:.4g}",
                                      m.value.back(), m.time.back()));

  const double longest = m.time.back();
  std::size_t from = first_point(slopes);
  if (!straight(halves(slopes, from))) from = std::max(from, slopes.index(longest / later_window));
  double change = 0;
  if (const Halves last = halves(slopes, from); !straight(last)) {
    change = std::abs(last.change);
    if (!(change <= tolerance * last.later))
      return no_coefficient(
          fmt::format("not diffusive yet: the slope still changes by {:.0f} % between the "
                      "halves of [{:.4g}, {:.4g}]",
                      100 * last.change / last.later, m.time[from], longest));
    from = slopes.index(longest / shortest_window);
  }
  const Eigen::VectorXd c = slopes.coefficients(from, m.time.size());
  const double scale = 1.0 / (2 * dimension);
  return {scale * slopes.value(c), scale * std::max(slopes.error(c), change), m.time[from], longest,
          ""};
}

}  // namespace vitrel
