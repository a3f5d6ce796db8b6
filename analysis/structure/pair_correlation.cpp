#include "analysis/structure/pair_correlation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "analysis/structure/orientation_tensor.h"

namespace vitrel {

namespace {

template <int Dim>
struct Point;

/// director = (cos 2θ, sin 2θ) and rotor = 1, or 0 of a round particle.
template <>
struct Point<2> {
  Point() = default;
  Point(const Configuration2& configuration, std::size_t i) : position(configuration.position[i]) {
    if (configuration.shape[i].is_round()) return;
    const double twice = 2 * configuration.angle[i];
    director = direction(twice);
    rotor = 1;
  }

  Vec2 position = Vec2::Zero();
  Vec2 director = Vec2::Zero();
  double rotor = 0;
};

/// director: the figure axis, or 0 of a round particle.
template <>
struct Point<3> {
  Point() = default;
  Point(const Configuration3& configuration, std::size_t i) : position(configuration.position[i]) {
    const Ellipsoid& shape = configuration.shape[i];
    if (shape.is_round()) return;
    director = figure_axis(shape, configuration.orientation[i]);
    rotor = 1;
  }

  Vec3 position = Vec3::Zero();
  Vec3 director = Vec3::Zero();
  double rotor = 0;
};

/// Points sorted by cells, along x, row after row: the neighbours of a point are one run of memory per
/// row, or two where they go on across the edge of the box.
template <int Dim>
class SortedPoints {
 public:
  SortedPoints(const Configuration<Dim>& configuration, double range)
      : lengths_(configuration.box.lengths()), range_(range) {
    for (int k = 0; k < Dim; ++k) {
      // Fewer candidates in vain against more runs; no more cells than a few per point.
      const double most = 4 * std::pow(static_cast<double>(configuration.size()), 1.0 / Dim) + 1;
      count_[k] = static_cast<std::int64_t>(std::clamp(8 * lengths_[k] / range, 1.0, most));
      width_[k] = lengths_[k] / static_cast<double>(count_[k]);
    }
    std::vector<Point<Dim>> points;
    for (std::size_t i = 0; i < configuration.size(); ++i) points.emplace_back(configuration, i);
    sort(points);
  }

  /// Calls visit(p, q, squared distance) for every pair of images that may lie within the range, each
  /// pair once.
  template <class Visit>
  void for_each_pair(Visit&& visit) const {
    for (std::size_t i = 0; i < points_.size(); ++i)
      visit_cells<Dim - 1>(i, range_ * range_, 0, -points_[i].position, visit);
  }

 private:
  struct Cells {
    std::int64_t low, high;
  };

  double from_edge(const Point<Dim>& point, int k) const {
    return point.position[k] + 0.5 * lengths_[k];
  }

  std::size_t cell_of(const Point<Dim>& point) const {
    std::int64_t cell = 0;
    for (int k = Dim - 1; k >= 0; --k) {
      const auto at = static_cast<std::int64_t>(from_edge(point, k) / width_[k]);
      cell = cell * count_[k] + std::clamp<std::int64_t>(at, 0, count_[k] - 1);
    }
    return static_cast<std::size_t>(cell);
  }

  void sort(const std::vector<Point<Dim>>& points) {
    std::int64_t cells = 1;
    for (const std::int64_t count : count_) cells *= count;
    first_.assign(static_cast<std::size_t>(cells) + 1, 0);
    for (const Point<Dim>& point : points) ++first_[cell_of(point) + 1];
    for (std::size_t cell = 1; cell < first_.size(); ++cell) first_[cell] += first_[cell - 1];
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    points_.resize(points.size());
    for (const Point<Dim>& point : points) points_[next[cell_of(point)]++] = point;
  }

  // Those within reach, also beyond the box; with room for rounding at the edges.
  Cells covered(double at, double reach, int k) const {
    const double half = reach + 1e-12 * lengths_[k];
    return {static_cast<std::int64_t>(std::floor((at - half) / width_[k])),
            static_cast<std::int64_t>(std::floor((at + half) / width_[k]))};
  }

  std::int64_t boxes_off(std::int64_t cell, int k) const {
    return cell >= 0 ? cell / count_[k] : -((count_[k] - 1 - cell) / count_[k]);
  }

  // Of the cells that begin at `start`, those within reach along the axes up to K. `offset`, added to a
  // position, gives the separation.
  template <int K, class Visit>
  void visit_cells(std::size_t i, double squared_reach, std::int64_t start, Vec<Dim> offset,
                   Visit& visit) const {
    const double at = from_edge(points_[i], K);
    const Cells cells = covered(at, std::sqrt(squared_reach), K);
    if constexpr (K == 0) {
      visit_row(i, cells, start, offset, visit);
    } else {
      for (std::int64_t cell = cells.low; cell <= cells.high; ++cell) {
        const double begin = static_cast<double>(cell) * width_[K];
        const double away = std::max({0.0, begin - at, at - begin - width_[K]});
        const std::int64_t boxes = boxes_off(cell, K);
        offset[K] = static_cast<double>(boxes) * lengths_[K] - points_[i].position[K];
        visit_cells<K - 1>(i, std::max(0.0, squared_reach - away * away),
                           (start + cell - boxes * count_[K]) * count_[K - 1], offset, visit);
      }
    }
  }

  // The points behind i in this row.
  template <class Visit>
  void visit_row(std::size_t i, const Cells& cells, std::int64_t start, const Vec<Dim>& row,
                 Visit& visit) const {
    const Point<Dim>& here = points_[i];
    for (std::int64_t right = boxes_off(cells.low, 0); right <= boxes_off(cells.high, 0); ++right) {
      const std::int64_t low = std::max<std::int64_t>(cells.low - right * count_[0], 0);
      const std::int64_t high = std::min(cells.high - right * count_[0], count_[0] - 1);
      // A copy of its own: the loop then keeps it in registers.
      Vec<Dim> offset = row;
      offset[0] = static_cast<double>(right) * lengths_[0] - here.position[0];
      const std::size_t end = first_[static_cast<std::size_t>(start + high) + 1];
      for (std::size_t j = std::max(first_[static_cast<std::size_t>(start + low)], i + 1); j < end;
           ++j)
        visit(here, points_[j], (points_[j].position + offset).squaredNorm());
    }
  }

  Vec<Dim> lengths_;
  double range_;
  std::int64_t count_[Dim];
  double width_[Dim];
  std::vector<std::size_t> first_;  // point of every cell, and the end
  std::vector<Point<Dim>> points_;
};

/// Sums over the pairs of a bin.
struct Bin {
  double pairs = 0, rotor_pairs = 0;
  double first = 0, second = 0;  // powers of cos 2(θ_i − θ_j), or in space of (u_i·u_j)²

  template <int Dim>
  void add(const Point<Dim>& p, const Point<Dim>& q) {
    const double between = p.director.dot(q.director);
    const double power = Dim == 2 ? between : between * between;
    pairs += 1;
    rotor_pairs += p.rotor * q.rotor;
    first += power;
    second += power * power;
  }
  double g_2(int dimension) const {
    const double mean = first / rotor_pairs;
    return dimension == 2 ? mean : 1.5 * mean - 0.5;
  }
  double g_4(int dimension) const {
    const double mean = first / rotor_pairs, square = second / rotor_pairs;
    return dimension == 2 ? 2 * square - 1 : (35 * square - 30 * mean + 3) / 8;
  }
};

template <int Dim>
std::size_t bins_within(const Configuration<Dim>& configuration,
                        const PairCorrelationOptions& options) {
  const double range = std::min(options.distance_max, 0.5 * configuration.box.lengths().minCoeff());
  // A quotient that rounding leaves just below a whole number is one.
  return static_cast<std::size_t>(range / options.distance_step * (1 + 1e-12));
}

/// Area (volume) between two radii.
template <int Dim>
double shell_volume(double inner, double outer) {
  if constexpr (Dim == 2) return std::numbers::pi * (outer * outer - inner * inner);
  return 4 * std::numbers::pi / 3 * (outer * outer * outer - inner * inner * inner);
}

}  // namespace

template <int Dim>
PairCorrelation pair_correlation(const Configuration<Dim>& configuration,
                                 const PairCorrelationOptions& options) {
  const std::size_t count = bins_within(configuration, options);
  if (count == 0) return {};
  const double step = options.distance_step, range = static_cast<double>(count) * step;
  // Pairs beyond the range go into one more bin: cheaper than to tell them apart.
  std::vector<Bin> bins(count + 1);
  SortedPoints<Dim>(configuration, range)
      .for_each_pair(
          [&, scale = 1 / step](const Point<Dim>& p, const Point<Dim>& q, double squared) {
            const auto at = static_cast<std::int64_t>(scale * std::sqrt(squared));
            bins[std::min(static_cast<std::size_t>(at), count)].add(p, q);
          });

  const double n = static_cast<double>(configuration.size());
  const double density = 0.5 * n * (n - 1) / configuration.box.volume();
  PairCorrelation result;
  for (std::size_t k = 0; k < count; ++k) {
    const double inner = static_cast<double>(k) * step, outer = inner + step;
    result.distance.push_back(0.5 * (inner + outer));
    result.g.push_back(bins[k].pairs / (density * shell_volume<Dim>(inner, outer)));
    result.g_2.push_back(bins[k].g_2(Dim));
    result.g_4.push_back(bins[k].g_4(Dim));
    result.rotor_pairs.push_back(bins[k].rotor_pairs);
  }
  return result;
}

template PairCorrelation pair_correlation<2>(const Configuration2&, const PairCorrelationOptions&);
template PairCorrelation pair_correlation<3>(const Configuration3&, const PairCorrelationOptions&);

}  // namespace vitrel
