#include "analysis/glass/glass_fit.h"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <tuple>

#include "analysis/statistics/gsl_errors.h"
#include "analysis/statistics/least_squares.h"
#include "core/error.h"
#include "core/random/stream.h"
#include "core/special_values.h"

namespace vitrel {

namespace {

constexpr double equal_densities = 1e-4;
constexpr double smallest_gap = 1e-5;  // minimum distance of φ_c from the highest density
constexpr double densest = 1;
constexpr double min_goodness = 0.05;
constexpr double one_error = 1;        // rise of χ² at the ends of a 68.3 % interval
constexpr double limit_95 = 2.7055;    // rise of χ² at a limit of 95 %, 1.645²
constexpr double min_distinction = 4;  // amount by which χ² of the other law must be larger
constexpr double max_deviation = 3;    // standard errors of a density from the extrapolated law
constexpr std::size_t max_fewer = 3;   // number of densities that a shorter window lacks
constexpr int resamples = 40;
constexpr int scan_points = 400, limit_points = 50;

/// One density: y = ln τ.
struct Point {
  double packing_fraction, y, error;
};
using Points = std::span<const Point>;

/// Returns x(φ, φ_c) of the law ln τ = ln A + s x(φ, φ_c).
double abscissa(GlassLaw law, double density, double packing_fraction) {
  const double gap = density - packing_fraction;
  return law == GlassLaw::mode_coupling ? -std::log(gap) : packing_fraction / gap;
}

/// Returns ∂x/∂φ_c.
double abscissa_derivative(GlassLaw law, double density, double packing_fraction) {
  const double gap = density - packing_fraction;
  return law == GlassLaw::mode_coupling ? -1 / gap : -packing_fraction / (gap * gap);
}

/// The best straight line for a given φ_c.
struct Line {
  double log_prefactor, strength, chi_square;
  double information;  ///< χ² grows by information · (s − strength)²
};

/// The fit of a law to the points of one window.
class WindowFit {
 public:
  /// φ_c must be above `relaxed`.
  WindowFit(Points points, GlassLaw law, double relaxed) : points_(points), law_(law) {
    highest_ = points_.back().packing_fraction;
    min_gap_ = std::max(relaxed - highest_, 0.0) + smallest_gap;
  }

  GlassWindow operator()() const {
    GlassWindow w = scan();
    if (w.density > density(first())) refine(w);
    set_limits(w);
    w.degrees = points_.size() - 3;
    w.goodness = gsl_cdf_chisq_Q(w.chi_square, static_cast<double>(w.degrees));
    return w;
  }

 private:
  double density(double u) const { return highest_ + std::exp(u); }
  double first() const { return std::log(min_gap_); }
  double last() const { return std::log(densest - highest_); }

  Line line(double u) const {
    const double at = density(u);
    double weights = 0, x = 0, y = 0;
    for (const Point& p : points_) {
      const double weight = 1 / (p.error * p.error);
      weights += weight;
      x += weight * abscissa(law_, at, p.packing_fraction);
      y += weight * p.y;
    }
    x /= weights, y /= weights;
    double xx = 0, xy = 0, yy = 0;
    for (const Point& p : points_) {
      const double weight = 1 / (p.error * p.error);
      const double dx = abscissa(law_, at, p.packing_fraction) - x;
      xx += weight * dx * dx;
      xy += weight * dx * (p.y - y);
      yy += weight * (p.y - y) * (p.y - y);
    }
    const double strength = std::max(0.0, xy / xx);
    return {y - strength * x, strength, yy - strength * (2 * xy - strength * xx), xx};
  }

  /// Returns the window with the best φ_c of a fine grid.
  GlassWindow scan() const {
    const double step = (last() - first()) / (scan_points - 1);
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < scan_points; ++k) {
      const double chi_square = line(first() + step * k).chi_square;
      if (chi_square < least) least = chi_square, best = k;
    }
    const double u = first() + step * best;
    const Line fit = line(u);
    GlassWindow w{};
    w.lowest = points_.front().packing_fraction;
    w.highest = highest_;
    w.densities = points_.size();
    w.density = best < scan_points - 1 && fit.strength > 0 ? density(u) : unknown;
    w.strength = fit.strength;
    w.log_prefactor = fit.log_prefactor;
    w.chi_square = least;
    w.covariance.setConstant(unknown);
    return w;
  }

  /// Sets where χ² has risen on both sides, and how large s may be.
  void set_limits(GlassWindow& w) const {
    const double best = std::isnan(w.density) ? last() : std::log(w.density - highest_);
    w.low = crossing(best, first(), w.chi_square + one_error);
    w.high = crossing(best, last(), w.chi_square + one_error);
    w.least = crossing(best, first(), w.chi_square + limit_95);
    const double most = crossing(best, last(), w.chi_square + limit_95);
    w.strength_most = std::isnan(most) ? std::numeric_limits<double>::infinity() : w.strength;
    const double from = std::isnan(w.least) ? first() : std::log(w.least - highest_);
    const double to = std::isnan(most) ? last() : std::log(most - highest_);
    for (int k = 0; k < limit_points; ++k) {
      const Line at = line(from + (to - from) / (limit_points - 1) * k);
      const double rest = std::max(0.0, w.chi_square + limit_95 - at.chi_square);
      w.strength_most = std::max(w.strength_most, at.strength + std::sqrt(rest / at.information));
    }
  }

  /// Returns the φ_c between u and `end` at which χ² has risen to `target`; NaN if it does not.
  double crossing(double u, double end, double target) const {
    if (line(end).chi_square < target) return unknown;
    for (int k = 0; k < 60; ++k) {
      const double middle = (u + end) / 2;
      (line(middle).chi_square < target ? u : end) = middle;
    }
    return density(u);
  }

  /// Fits all three parameters at once, and computes their covariance.
  void refine(GlassWindow& w) const {
    const auto residuals = [&](const Eigen::VectorXd& p, Eigen::VectorXd& r, Eigen::MatrixXd& j) {
      const double gap = std::exp(p[2]);
      for (std::size_t n = 0; n < points_.size(); ++n) {
        const Point& point = points_[n];
        const auto k = static_cast<Eigen::Index>(n);
        const double at = highest_ + gap, x = abscissa(law_, at, point.packing_fraction);
        r[k] = (p[0] + p[1] * x - point.y) / point.error;
        j(k, 0) = 1 / point.error;
        j(k, 1) = x / point.error;
        j(k, 2) = p[1] * gap * abscissa_derivative(law_, at, point.packing_fraction) / point.error;
      }
    };
    const Eigen::Vector3d start(w.log_prefactor, w.strength, std::log(w.density - highest_));
    const LeastSquares fit = least_squares(points_.size(), start, residuals);
    if (!fit.converged || !(fit.chi_square <= w.chi_square) || fit.parameters[2] < first()) return;
    w.log_prefactor = fit.parameters[0];
    w.strength = fit.parameters[1];
    w.density = density(fit.parameters[2]);
    w.chi_square = fit.chi_square;
    const Eigen::Vector3d scale(1, 1, w.density - highest_);
    w.covariance = scale.asDiagonal() * fit.covariance * scale.asDiagonal();
  }

  Points points_;
  GlassLaw law_;
  double highest_, min_gap_;
};

void check(const std::vector<GlassPoint>& points) {
  for (const GlassPoint& p : points) {
    if (!(p.packing_fraction > 0 && p.packing_fraction < 1))
      throw UserError(fmt::format("glass fit: packing fraction {:g}; it must lie between 0 and 1",
                                  p.packing_fraction));
    if (!(p.time > 0 && p.error > 0 && std::isfinite(p.time) && std::isfinite(p.error)))
      throw UserError(
          fmt::format("glass fit: time {:g} with error {:g} at packing fraction {:g}; a fit in ln "
                      "tau needs both above 0 (leave out what has no time)",
                      p.time, p.error, p.packing_fraction));
  }
}

/// Times at equal densities combined into one, and the factor by which they scatter more than they should.
struct Densities {
  std::vector<Point> points;
  double scatter;
};

Densities merge(std::vector<GlassPoint> points) {
  std::stable_sort(points.begin(), points.end(), [](const GlassPoint& a, const GlassPoint& b) {
    return a.packing_fraction < b.packing_fraction;
  });
  Densities result{{}, 1};
  double chi_square = 0;
  for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end) {
    double weights = 0, fraction = 0, y = 0, yy = 0;
    for (; end < points.size() &&
           points[end].packing_fraction - points[begin].packing_fraction < equal_densities;
         ++end) {
      const GlassPoint& p = points[end];
      const double weight = p.time * p.time / (p.error * p.error);
      weights += weight;
      fraction += weight * p.packing_fraction;
      y += weight * std::log(p.time);
      yy += weight * std::log(p.time) * std::log(p.time);
    }
    result.points.push_back({fraction / weights, y / weights, 1 / std::sqrt(weights)});
    chi_square += yy - y * y / weights;
  }
  const std::size_t degrees = points.size() - result.points.size();
  if (degrees > 0)
    result.scatter = std::max(1.0, std::sqrt(chi_square / static_cast<double>(degrees)));
  for (Point& p : result.points) p.error *= result.scatter;
  return result;
}

/// Returns the density above which a law may have its φ_c: at a divergence nothing relaxes.
double lower_end(const std::vector<Point>& points, GlassLaw law) {
  return law == GlassLaw::vogel_fulcher ? points.back().packing_fraction : 0;
}

GlassWindow fit_window(const std::vector<Point>& points, std::size_t begin, std::size_t count,
                       GlassLaw law) {
  GlassWindow w = WindowFit(Points(points).subspan(begin, count), law, lower_end(points, law))();
  w.begin = begin;
  return w;
}

std::vector<GlassWindow> all_windows(const std::vector<Point>& points, GlassLaw law) {
  std::vector<GlassWindow> windows;
  for (std::size_t begin = 0; begin + min_densities <= points.size(); ++begin)
    for (std::size_t count = min_densities; begin + count <= points.size(); ++count)
      windows.push_back(fit_window(points, begin, count, law));
  return windows;
}

/// Returns the largest window in which the law fits; all densities if there is none.
const GlassWindow& largest(const std::vector<GlassWindow>& windows) {
  return *std::ranges::max_element(windows, {}, [](const GlassWindow& w) {
    return std::tuple(w.goodness >= min_goodness, w.densities, -w.chi_square);
  });
}

/// Returns the factor by which times grow from the lowest to the highest density.
double growth(Points points) {
  return std::exp(points.back().y - points.front().y);
}

/// Returns the distance of a point from the law of a window, in standard errors of both; NaN if the window leaves the
/// error of the law open.
double deviation(const Point& p, const GlassWindow& w, GlassLaw law) {
  const Eigen::Vector3d gradient(
      1, abscissa(law, w.density, p.packing_fraction),
      w.strength * abscissa_derivative(law, w.density, p.packing_fraction));
  const double expected =
      glass_law(law, w.log_prefactor, w.strength, w.density, p.packing_fraction);
  const double variance = gradient.dot(w.covariance * gradient);
  return std::abs(p.y - expected) / std::sqrt(variance + p.error * p.error);
}

/// Returns whether φ_c has an upper limit of 95 %; if and only if it has, s has one.
bool is_bounded(const GlassWindow& w) {
  return std::isfinite(w.strength_most);
}

Points densities_of(const GlassWindow& w, const std::vector<Point>& points) {
  return Points(points).subspan(w.begin, w.densities);
}

std::string text(const GlassWindow& w) {
  return fmt::format("the best window, [{:.4g}, {:.4g}]", w.lowest, w.highest);
}

/// Returns how a density outside of the window contradicts its law, or nothing if none does.
std::string contradiction(const GlassWindow& w, const std::vector<Point>& points, GlassLaw law) {
  std::string objection;
  double largest = max_deviation;
  for (const Point& p : points) {
    if (p.packing_fraction >= w.lowest && p.packing_fraction <= w.highest) continue;
    if (p.packing_fraction >= w.density)
      return fmt::format("times at {:.4g} are finite, beyond the phi_c = {:.4g} of {}",
                         p.packing_fraction, w.density, text(w));
    const double distance = deviation(p, w, law);
    if (!(distance > largest)) continue;
    largest = distance;
    objection = fmt::format("the law of {}, misses the time at {:.4g} by {:.2g} standard errors",
                            text(w), p.packing_fraction, distance);
  }
  return objection;
}

/// Returns how shorter windows with the same beginning contradict φ_c, or nothing if none does.
std::string drift(const GlassWindow& w, const std::vector<Point>& points, GlassLaw law) {
  const std::size_t fewest = std::max(min_densities + max_fewer, w.densities) - max_fewer;
  for (std::size_t count = fewest; count < w.densities; ++count) {
    const GlassWindow shorter = fit_window(points, w.begin, count, law);
    const double rise = w.chi_square - shorter.chi_square;
    if (gsl_cdf_chisq_Q(rise, static_cast<double>(w.densities - count)) < min_goodness)
      return fmt::format(
          "phi_c follows the end of the window: it is {:.4g} up to {:.4g}, but {:.4g} up to "
          "{:.4g}, and chi^2 differs by {:.3g}",
          w.density, w.highest, shorter.density, shorter.highest, rise);
  }
  return "";
}

/// Returns a text if the other law fits the window as well, and nothing if it does not.
std::string alternative(const GlassWindow& w, const std::vector<Point>& points, GlassLaw law) {
  const GlassLaw other =
      law == GlassLaw::mode_coupling ? GlassLaw::vogel_fulcher : GlassLaw::mode_coupling;
  const double chi_square = fit_window(points, w.begin, w.densities, other).chi_square;
  if (chi_square - w.chi_square >= min_distinction) return "";
  return fmt::format(
      "the data do not tell the laws apart: chi^2 is {:.2f} by this one and {:.2f} by the other, "
      "which must be larger by {:g}",
      w.chi_square, chi_square, min_distinction);
}

/// Returns the first reason not to believe the law of a window, or nothing if there is none.
std::string objection(const GlassWindow& w, const std::vector<Point>& points, GlassLaw law) {
  if (w.goodness < min_goodness)
    return fmt::format("the law holds in no window: chi^2/dof is {:.3g} in [{:.4g}, {:.4g}]",
                       w.chi_square / static_cast<double>(w.degrees), w.lowest, w.highest);
  if (const double factor = growth(densities_of(w, points)); factor < min_growth)
    return fmt::format(
        "within {}, the times grow by a factor of only {:.2g}, and to extrapolate takes {:g} or "
        "more",
        text(w), factor, min_growth);
  if (law == GlassLaw::mode_coupling && w.strength_most < min_exponent)
    return fmt::format(
        "the exponent is below {:.3g} with a probability of 95 %, and mode-coupling theory allows "
        "none below {:.4g}",
        w.strength_most, min_exponent);
  if (std::string reason = contradiction(w, points, law); !reason.empty()) return reason;
  if (const double highest = points.back().packing_fraction; !(w.least > highest))
    return fmt::format(
        "the density at which times diverge is not distinct from the highest one, {:.4g}", highest);
  if (!is_bounded(w)) return "";
  if (std::string reason = drift(w, points, law); !reason.empty()) return reason;
  return alternative(w, points, law);
}

/// Returns a text unless times drawn anew within their errors support the law as well.
std::string weakness(const GlassWindow& w, const std::vector<Point>& points, GlassLaw law) {
  int supports = 0;
  for (std::uint64_t k = 0; k < resamples; ++k) {
    Stream draw(k, Purpose::resampling);
    std::vector<Point> again = points;
    for (Point& p : again) {
      p.y += p.error * draw.normal();
      p.error *= std::numbers::sqrt2;
    }
    const GlassWindow same = fit_window(again, w.begin, w.densities, law);
    supports += is_bounded(same) && objection(same, again, law).empty();
  }
  if (2 * supports >= resamples) return "";
  return fmt::format(
      "the verdict does not survive the errors of the times: drawn anew within them, they support "
      "the law in {} of {} cases",
      supports, resamples);
}

/// Returns why there is no law, whatever its windows say, or nothing if there may be one.
std::string shortage(const std::vector<Point>& points) {
  if (points.size() < min_densities)
    return fmt::format("{} densities in equilibrium; a fit needs {} or more", points.size(),
                       min_densities);
  if (const double factor = growth(points); factor < min_growth)
    return fmt::format(
        "the times grow by a factor of only {:.2g} from {:.4g} to {:.4g}, and to extrapolate "
        "takes {:g} or more",
        factor, points.front().packing_fraction, points.back().packing_fraction, min_growth);
  return "";
}

}  // namespace

double GlassWindow::strength_error() const {
  return std::sqrt(covariance(1, 1));
}

double glass_law(GlassLaw law, double log_prefactor, double strength, double density,
                 double packing_fraction) {
  return log_prefactor + strength * abscissa(law, density, packing_fraction);
}

GlassFit fit_glass_law(const std::vector<GlassPoint>& points, GlassLaw law) {
  check(points);
  const auto [densities, scatter] = merge(points);
  GlassFit fit{GlassVerdict::refused, shortage(densities), scatter};
  if (densities.size() < min_densities) return fit;
  fit.windows = all_windows(densities, law);
  fit.window = largest(fit.windows);
  if (fit.reason.empty()) fit.reason = objection(fit.window, densities, law);
  const bool bounded = is_bounded(fit.window);
  if (fit.reason.empty() && bounded) fit.reason = weakness(fit.window, densities, law);
  if (!fit.reason.empty()) return fit;
  fit.verdict = bounded ? GlassVerdict::found : GlassVerdict::lower_bound;
  if (!bounded)
    fit.reason = fmt::format(
        "if the law holds, it is above {:.4g} with a probability of 95 %, and not bounded "
        "from above",
        fit.window.least);
  return fit;
}

}  // namespace vitrel
