#include "analysis/glass/glass_fit.h"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/statistics/gsl_errors.h"
#include "analysis/statistics/least_squares.h"
#include "core/error.h"
#include "core/special_values.h"

namespace vitrel {

namespace {

constexpr double equal_densities = 1e-4;
constexpr double smallest_gap = 1e-5;  // of φ_c from the highest density
constexpr double densest = 1;
constexpr double min_goodness = 0.05;
constexpr double one_error = 1;        // rise of χ² at the ends of a 68.3 % interval
constexpr double one_sigma = 0.15866;  // probability of less than the mean − σ
constexpr int scan_points = 400;
constexpr double max_deviation = 3;  // standard errors, of a density from the extrapolated law

/// One density: y = ln τ.
struct Point {
  double packing_fraction, y, error;
};

/// The law is ln τ = ln A + s x(φ, φ_c).
double abscissa(GlassLaw law, double density, double packing_fraction) {
  const double gap = density - packing_fraction;
  return law == GlassLaw::mode_coupling ? -std::log(gap) : packing_fraction / gap;
}

/// ∂x/∂φ_c.
double abscissa_derivative(GlassLaw law, double density, double packing_fraction) {
  const double gap = density - packing_fraction;
  return law == GlassLaw::mode_coupling ? -1 / gap : -packing_fraction / (gap * gap);
}

/// The best straight line for a given φ_c.
struct Line {
  double log_prefactor, strength, chi_square;
};

/// The law over the points of one window.
class WindowFit {
 public:
  /// φ_c is above `relaxed`.
  WindowFit(std::vector<Point> points, GlassLaw law, double relaxed)
      : points_(std::move(points)), law_(law) {
    highest_ = points_.back().packing_fraction;
    min_gap_ = std::max(relaxed - highest_, 0.0) + smallest_gap;
  }

  GlassWindow operator()() const {
    GlassWindow w = scan();
    if (w.density > density(first())) refine(w);
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
    return {y - strength * x, strength, yy - strength * (2 * xy - strength * xx)};
  }

  /// The best φ_c of a fine grid, and where χ² has risen on both sides.
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
    w.low = crossing(u, first(), least + one_error);
    w.high = crossing(u, last(), least + one_error);
    return w;
  }

  /// φ_c between u and `end` at which χ² has risen to `target`; NaN if it does not.
  double crossing(double u, double end, double target) const {
    if (line(end).chi_square < target) return unknown;
    for (int k = 0; k < 60; ++k) {
      const double middle = (u + end) / 2;
      (line(middle).chi_square < target ? u : end) = middle;
    }
    return density(u);
  }

  /// All three parameters at once, and their covariance.
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
    w.low = crossing(fit.parameters[2], first(), fit.chi_square + one_error);
    w.high = crossing(fit.parameters[2], last(), fit.chi_square + one_error);
  }

  std::vector<Point> points_;
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

/// Times at equal densities as one, and by how much more they scatter than they should.
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

/// Above which density a law may have its φ_c: at a divergence nothing relaxes.
double lower_end(const std::vector<Point>& points, GlassLaw law) {
  return law == GlassLaw::vogel_fulcher ? points.back().packing_fraction : 0;
}

std::vector<GlassWindow> all_windows(const std::vector<Point>& points, GlassLaw law) {
  std::vector<GlassWindow> windows;
  for (auto begin = points.begin(); points.end() - begin >= std::ptrdiff_t{min_densities}; ++begin)
    for (auto end = begin + min_densities; end <= points.end(); ++end)
      windows.push_back(WindowFit({begin, end}, law, lower_end(points, law))());
  return windows;
}

/// Akaike's weights, but for what all windows have in common.
void weigh(std::vector<GlassWindow>& windows) {
  const auto cost = [](const GlassWindow& w) {
    return w.chi_square / 2 - static_cast<double>(w.densities);
  };
  double least = std::numeric_limits<double>::infinity(), sum = 0;
  for (const GlassWindow& w : windows) least = std::min(least, cost(w));
  for (GlassWindow& w : windows) sum += w.weight = std::exp(least - cost(w));
  for (GlassWindow& w : windows) w.weight /= sum;
}

const GlassWindow& heaviest(const std::vector<GlassWindow>& windows) {
  return *std::max_element(
      windows.begin(), windows.end(),
      [](const GlassWindow& a, const GlassWindow& b) { return a.weight < b.weight; });
}

/// A normal distribution about `centre`, of different width on its two sides; NaN stands for the
/// half beyond all bounds, a centre of NaN for both halves above them.
struct Belief {
  double weight, centre, below, above;

  double probability_up_to(double x) const {
    if (std::isnan(centre)) return 0;
    const double width = x < centre ? below : above;
    if (std::isnan(width)) return 0.5;
    return gsl_cdf_gaussian_P((x - centre) / width, 1);
  }
};

/// Where the sum of the beliefs reaches a probability, between two bounds; NaN if not between them.
double quantile(const std::vector<Belief>& beliefs, double probability, double from, double to) {
  const auto sum_up_to = [&](double x) {
    double sum = 0;
    for (const Belief& b : beliefs) sum += b.weight * b.probability_up_to(x);
    return sum;
  };
  if (sum_up_to(from) > probability || sum_up_to(to) < probability) return unknown;
  for (int k = 0; k < 60; ++k) {
    const double middle = (from + to) / 2;
    (sum_up_to(middle) < probability ? from : to) = middle;
  }
  return from;
}

void combine_densities(GlassFit& fit, double lower_end) {
  std::vector<Belief> beliefs;
  for (const GlassWindow& w : fit.windows)
    beliefs.push_back({w.weight, w.density, w.density - w.low, w.high - w.density});
  const double from = std::max(fit.window.highest, lower_end);
  fit.density = quantile(beliefs, 0.5, from, densest);
  fit.low = quantile(beliefs, one_sigma, from, densest);
  fit.high = quantile(beliefs, 1 - one_sigma, from, densest);
  fit.least = quantile(beliefs, 0.05, from, densest);
  fit.error = (fit.high - fit.low) / 2;
  fit.statistical = std::min(fit.error, (fit.window.high - fit.window.low) / 2);
  fit.spread = std::sqrt(fit.error * fit.error - fit.statistical * fit.statistical);
}

void combine_strengths(GlassFit& fit) {
  std::vector<Belief> beliefs;
  double largest = 0;
  for (const GlassWindow& w : fit.windows) {
    const double error = std::sqrt(w.covariance(1, 1));
    beliefs.push_back({w.weight, std::isnan(error) ? unknown : w.strength, error, error});
    if (!std::isnan(error)) largest = std::max(largest, w.strength + 5 * error);
  }
  fit.strength = quantile(beliefs, 0.5, 0, largest);
  fit.strength_error =
      (quantile(beliefs, 1 - one_sigma, 0, largest) - quantile(beliefs, one_sigma, 0, largest)) / 2;
}

/// By which factor times grow over all densities.
double growth(const std::vector<Point>& points) {
  const auto [least, most] = std::minmax_element(
      points.begin(), points.end(), [](const Point& a, const Point& b) { return a.y < b.y; });
  return std::exp(most->y - least->y);
}

/// The distance of a point from the law of a window, in standard errors of both; NaN if the window
/// leaves the error of the law open.
double deviation(const Point& p, const GlassWindow& w, GlassLaw law) {
  const Eigen::Vector3d gradient(
      1, abscissa(law, w.density, p.packing_fraction),
      w.strength * abscissa_derivative(law, w.density, p.packing_fraction));
  const double expected =
      glass_law(law, w.log_prefactor, w.strength, w.density, p.packing_fraction);
  const double variance = gradient.dot(w.covariance * gradient);
  return std::abs(p.y - expected) / std::sqrt(variance + p.error * p.error);
}

/// What a density outside of the best window says against its law; empty if nothing does.
std::string contradiction(const GlassFit& fit, const std::vector<Point>& points, GlassLaw law) {
  const GlassWindow& w = fit.window;
  const double divergence = std::fmin(w.density, fit.density);
  std::string text;
  double largest = max_deviation;
  for (const Point& p : points) {
    if (p.packing_fraction >= w.lowest && p.packing_fraction <= w.highest) continue;
    if (p.packing_fraction >= divergence)
      return fmt::format(
          "times at {:.4g} are finite, beyond the phi_c = {:.4g} of the best window, [{:.4g}, "
          "{:.4g}]",
          p.packing_fraction, divergence, w.lowest, w.highest);
    const double distance = deviation(p, w, law);
    if (!(distance > largest)) continue;
    largest = distance;
    text = fmt::format(
        "the law of the best window, [{:.4g}, {:.4g}], misses the time at {:.4g} by {:.2g} "
        "standard errors",
        w.lowest, w.highest, p.packing_fraction, distance);
  }
  return text;
}

/// Windows and what they say together, before it is judged.
GlassFit fit_windows(const Densities& densities, GlassLaw law) {
  GlassFit fit{};
  fit.scatter = densities.scatter;
  fit.density = fit.low = fit.high = fit.error = fit.statistical = fit.spread = fit.least = unknown;
  fit.strength = fit.strength_error = unknown;
  if (densities.points.size() < min_densities) return fit;
  fit.windows = all_windows(densities.points, law);
  weigh(fit.windows);
  fit.window = heaviest(fit.windows);
  combine_densities(fit, lower_end(densities.points, law));
  combine_strengths(fit);
  return fit;
}

/// The first reason not to believe the fit; empty if there is none.
std::string objection(const GlassFit& fit, const std::vector<Point>& points, GlassLaw law) {
  if (points.size() < min_densities)
    return fmt::format("{} densities in equilibrium; a fit needs {} or more", points.size(),
                       min_densities);
  const GlassWindow& w = fit.window;
  const GlassWindow& whole = fit.windows[points.size() - min_densities];
  if (!(whole.strength > 0)) return "the times do not grow with density";
  if (const double factor = growth(points); factor < min_growth)
    return fmt::format(
        "the times grow by a factor of only {:.2g} from {:.4g} to {:.4g}, and to extrapolate "
        "takes {:g} or more",
        factor, whole.lowest, whole.highest, min_growth);
  if (w.goodness < min_goodness)
    return fmt::format(
        "the law holds in no window: chi^2/dof is {:.3g} in the best one, [{:.4g}, {:.4g}]",
        w.chi_square / static_cast<double>(w.degrees), w.lowest, w.highest);
  const bool has_bound = !std::isnan(fit.high) || !std::isnan(fit.least);
  if (std::isnan(fit.low) || !has_bound)
    return fmt::format(
        "the density at which times diverge is not distinct from the highest one, "
        "{:.4g}",
        points.back().packing_fraction);
  return contradiction(fit, points, law);
}

}  // namespace

double glass_law(GlassLaw law, double log_prefactor, double strength, double density,
                 double packing_fraction) {
  return log_prefactor + strength * abscissa(law, density, packing_fraction);
}

GlassFit fit_glass_law(const std::vector<GlassPoint>& points, GlassLaw law) {
  check(points);
  const Densities densities = merge(points);
  GlassFit fit = fit_windows(densities, law);
  fit.reason = objection(fit, densities.points, law);
  if (!fit.reason.empty()) {
    fit.verdict = GlassVerdict::refused;
  } else if (std::isnan(fit.high)) {
    fit.verdict = GlassVerdict::lower_bound;
    fit.reason =
        fmt::format("above {:.4g} with a probability of 95 %, not bounded from above", fit.least);
  }
  return fit;
}

}  // namespace vitrel
