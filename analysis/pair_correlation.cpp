#include "analysis/pair_correlation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace vitrel {

namespace {

/// A particle; director = (cos 2θ, sin 2θ) and rotor = 1, or 0 if it is round.
struct Point {
  Vec2 position;
  Vec2 director;
  double rotor;
};

std::vector<Point> points_of(const Configuration2& configuration) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const double twice = 2 * configuration.angle[i];
    if (configuration.shape[i].is_round())
      points.push_back({configuration.position[i], Vec2::Zero(), 0});
    else
      points.push_back({configuration.position[i], {std::cos(twice), std::sin(twice)}, 1});
  }
  return points;
}

/// Points sorted by cells, row after row: the neighbours of a point are one run of memory per row, or
/// two where they go on across the edge of the box.
class SortedPoints {
 public:
  SortedPoints(const Configuration2& configuration, double range)
      : lengths_(configuration.box.lengths()), range_(range) {
    for (int k = 0; k < 2; ++k) {
      // Fewer candidates in vain against more runs; no more cells than a few per point.
      const double most = 4 * std::sqrt(static_cast<double>(configuration.size())) + 1;
      count_[k] = static_cast<std::int64_t>(std::clamp(8 * lengths_[k] / range, 1.0, most));
      width_[k] = lengths_[k] / static_cast<double>(count_[k]);
    }
    sort(points_of(configuration));
  }

  /// Calls visit(p, q, squared distance) for every pair of images that may lie within the range, each
  /// pair once.
  template <class Visit>
  void for_each_pair(Visit&& visit) const {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double y = from_edge(points_[i], 1);
      const Columns rows = covered(y, range_, 1);
      for (std::int64_t row = rows.low; row <= rows.high; ++row) {
        const double bottom = static_cast<double>(row) * width_[1];
        const double away = std::max({0.0, bottom - y, y - bottom - width_[1]});
        const double reach = std::sqrt(std::max(0.0, range_ * range_ - away * away));
        visit_row(i, row, reach, visit);
      }
    }
  }

 private:
  struct Columns {
    std::int64_t low, high;
  };

  double from_edge(const Point& point, int k) const {
    return point.position[k] + 0.5 * lengths_[k];
  }

  std::size_t cell_of(const Point& point) const {
    std::int64_t at[2];
    for (int k = 0; k < 2; ++k)
      at[k] = std::clamp<std::int64_t>(static_cast<std::int64_t>(from_edge(point, k) / width_[k]),
                                       0, count_[k] - 1);
    return static_cast<std::size_t>(at[1] * count_[0] + at[0]);
  }

  void sort(const std::vector<Point>& points) {
    first_.assign(static_cast<std::size_t>(count_[0] * count_[1]) + 1, 0);
    for (const Point& point : points) ++first_[cell_of(point) + 1];
    for (std::size_t cell = 1; cell < first_.size(); ++cell) first_[cell] += first_[cell - 1];
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    points_.resize(points.size());
    for (const Point& point : points) points_[next[cell_of(point)]++] = point;
  }

  // Columns or rows within reach, also beyond the box; with room for rounding at the edges.
  Columns covered(double at, double reach, int k) const {
    const double half = reach + 1e-12 * lengths_[k];
    return {static_cast<std::int64_t>(std::floor((at - half) / width_[k])),
            static_cast<std::int64_t>(std::floor((at + half) / width_[k]))};
  }

  std::int64_t boxes_off(std::int64_t cell, int k) const {
    return cell >= 0 ? cell / count_[k] : -((count_[k] - 1 - cell) / count_[k]);
  }

  // The points behind i in this row.
  template <class Visit>
  void visit_row(std::size_t i, std::int64_t row, double reach, Visit& visit) const {
    const Point& here = points_[i];
    const std::int64_t up = boxes_off(row, 1);
    const std::int64_t start = (row - up * count_[1]) * count_[0];
    const Columns columns = covered(from_edge(here, 0), reach, 0);
    for (std::int64_t right = boxes_off(columns.low, 0); right <= boxes_off(columns.high, 0);
         ++right) {
      const std::int64_t low = std::max<std::int64_t>(columns.low - right * count_[0], 0);
      const std::int64_t high = std::min(columns.high - right * count_[0], count_[0] - 1);
      const Vec2 offset =
          lengths_.cwiseProduct(Vec2(static_cast<double>(right), static_cast<double>(up))) -
          here.position;
      const std::size_t end = first_[static_cast<std::size_t>(start + high) + 1];
      for (std::size_t j = std::max(first_[static_cast<std::size_t>(start + low)], i + 1); j < end;
           ++j)
        visit(here, points_[j], (points_[j].position + offset).squaredNorm());
    }
  }

  Vec2 lengths_;
  double range_;
  std::int64_t count_[2];
  double width_[2];
  std::vector<std::size_t> first_;  // point of every cell, and the end
  std::vector<Point> points_;
};

/// Sums over the pairs of a bin.
struct Bin {
  double pairs = 0, rotor_pairs = 0;
  double cosine = 0, squared_cosine = 0;  // of 2(θ_i − θ_j)
};

std::size_t bins_within(const Configuration2& configuration,
                        const PairCorrelationOptions& options) {
  const double range = std::min(options.distance_max, 0.5 * configuration.box.lengths().minCoeff());
  // A quotient that rounding leaves just below a whole number is one.
  return static_cast<std::size_t>(range / options.distance_step * (1 + 1e-12));
}

}  // namespace

PairCorrelation pair_correlation(const Configuration2& configuration,
                                 const PairCorrelationOptions& options) {
  const std::size_t count = bins_within(configuration, options);
  if (count == 0) return {};
  const double step = options.distance_step, range = static_cast<double>(count) * step;
  // Pairs beyond the range go into one more bin: cheaper than to tell them apart.
  std::vector<Bin> bins(count + 1);
  SortedPoints(configuration, range)
      .for_each_pair([&, scale = 1 / step](const Point& p, const Point& q, double squared) {
        const auto at = static_cast<std::int64_t>(scale * std::sqrt(squared));
        Bin& bin = bins[std::min(static_cast<std::size_t>(at), count)];
        const double cosine = p.director.dot(q.director);
        bin.pairs += 1;
        bin.rotor_pairs += p.rotor * q.rotor;
        bin.cosine += cosine;
        bin.squared_cosine += cosine * cosine;
      });

  const double n = static_cast<double>(configuration.size());
  const double density = 0.5 * n * (n - 1) / configuration.box.volume();
  PairCorrelation result;
  for (std::size_t k = 0; k < count; ++k) {
    const double inner = static_cast<double>(k) * step, outer = inner + step;
    const double ring = std::numbers::pi * (outer * outer - inner * inner);
    result.distance.push_back(0.5 * (inner + outer));
    result.g.push_back(bins[k].pairs / (density * ring));
    result.g_2.push_back(bins[k].cosine / bins[k].rotor_pairs);
    result.g_4.push_back(2 * bins[k].squared_cosine / bins[k].rotor_pairs - 1);
    result.rotor_pairs.push_back(bins[k].rotor_pairs);
  }
  return result;
}

}  // namespace vitrel
