#include "analysis/structure/pair_correlation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "analysis/structure/distance_bins.h"
#include "analysis/structure/orientation_tensor.h"

namespace vitrel {

namespace {

template <int Dim>
struct Point;

/// Here director = (cos 2θ, sin 2θ) and rotor = 1; both are 0 for a round particle.
template <>
struct Point<2> {
  Point() = default;
  Point(const Configuration2& configuration, std::size_t i)
      : position(configuration.position[i]),
        species(static_cast<std::size_t>(configuration.species[i])) {
    if (configuration.shape[i].is_round()) return;
    const double twice = 2 * configuration.angle[i];
    director = direction(twice);
    rotor = 1;
  }

  Vec2 position = Vec2::Zero();
  Vec2 director = Vec2::Zero();
  double rotor = 0;
  std::size_t species = 0;
};

/// Here director is the figure axis, or 0 for a round particle.
template <>
struct Point<3> {
  Point() = default;
  Point(const Configuration3& configuration, std::size_t i)
      : position(configuration.position[i]),
        species(static_cast<std::size_t>(configuration.species[i])) {
    const ParticleShape<3>& shape = configuration.shape[i];
    if (shape.is_round()) return;
    director = figure_axis(shape, configuration.orientation[i]);
    rotor = 1;
  }

  Vec3 position = Vec3::Zero();
  Vec3 director = Vec3::Zero();
  double rotor = 0;
  std::size_t species = 0;
};

/// Points sorted by cells, along x, row after row: the neighbours of a point are one run of memory per row, or two if
/// they go on across the edge of the box.
template <int Dim>
class SortedPoints {
 public:
  /// The more cells there are along the range, the fewer candidates are tested in vain, and the shorter are the runs.
  SortedPoints(const Configuration<Dim>& configuration, double range, double cells_along_range)
      : lengths_(configuration.box.lengths()), range_(range) {
    for (int k = 0; k < Dim; ++k) {
      // More cells than a few per point are useless.
      const double most = 4 * std::pow(static_cast<double>(configuration.size()), 1.0 / Dim) + 1;
      count_[k] =
          static_cast<std::int64_t>(std::clamp(cells_along_range * lengths_[k] / range, 1.0, most));
      width_[k] = lengths_[k] / static_cast<double>(count_[k]);
    }
    std::vector<Point<Dim>> points;
    for (std::size_t i = 0; i < configuration.size(); ++i) points.emplace_back(configuration, i);
    sort(points);
  }

  /// Calls visit(p, q, separation) for every pair of images that may lie within the range, each pair
  /// once.
  void for_each_pair(auto&& visit) const {
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

  // Returns the cells within reach, also beyond the box, with a margin for rounding at the edges.
  Cells covered(double at, double reach, int k) const {
    const double half = reach + 1e-12 * lengths_[k];
    return {static_cast<std::int64_t>(std::floor((at - half) / width_[k])),
            static_cast<std::int64_t>(std::floor((at + half) / width_[k]))};
  }

  std::int64_t boxes_off(std::int64_t cell, int k) const {
    return cell >= 0 ? cell / count_[k] : -((count_[k] - 1 - cell) / count_[k]);
  }

  // Visits the points in those of the cells from `start` on that are within reach along the axes up to K. `offset`,
  // added to a position, gives the separation.
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

  // Visits the points after i in this row.
  void visit_row(std::size_t i, const Cells& cells, std::int64_t start, const Vec<Dim>& row,
                 auto& visit) const {
    const Point<Dim>& here = points_[i];
    for (std::int64_t right = boxes_off(cells.low, 0); right <= boxes_off(cells.high, 0); ++right) {
      const std::int64_t low = std::max<std::int64_t>(cells.low - right * count_[0], 0);
      const std::int64_t high = std::min(cells.high - right * count_[0], count_[0] - 1);
      // The copy lets the loop keep it in registers.
      Vec<Dim> offset = row;
      offset[0] = static_cast<double>(right) * lengths_[0] - here.position[0];
      const std::size_t end = first_[static_cast<std::size_t>(start + high) + 1];
      for (std::size_t j = std::max(first_[static_cast<std::size_t>(start + low)], i + 1); j < end;
           ++j)
        visit(here, points_[j], points_[j].position + offset);
    }
  }

  Vec<Dim> lengths_;
  double range_;
  std::int64_t count_[Dim];
  double width_[Dim];
  std::vector<std::size_t> first_;  // first point of every cell, and the end
  std::vector<Point<Dim>> points_;
};

/// The sums over the pairs of a bin.
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

/// Pairs of species in the bins of the distance, if several species have particles.
template <int Dim>
class SpeciesPairs {
 public:
  SpeciesPairs(const Configuration<Dim>& configuration, const DistanceBins& bins)
      : bins_(bins),
        box_(configuration.box),
        members_(std::max<std::size_t>(1, configuration.species_names.size())) {
    for (const std::int32_t species : configuration.species)
      ++members_[static_cast<std::size_t>(species)];
    if (std::ranges::count_if(members_, [](double count) { return count > 0; }) > 1)
      found_.resize(members_.size() * members_.size() * (bins.count() + 1));
  }

  bool is_mixture() const { return !found_.empty(); }
  /// Returns how many pairs of the groups a and b were met in this bin, in this order.
  double& found(std::size_t a, std::size_t b, std::size_t bin) {
    return found_[(a * members_.size() + b) * (bins_.count() + 1) + bin];
  }

  std::vector<std::vector<double>> partial() {
    std::vector<std::vector<double>> partial;
    for (std::size_t a = 0; is_mixture() && a < members_.size(); ++a)
      for (std::size_t b = a; b < members_.size(); ++b) partial.push_back(of_pair(a, b));
    return partial;
  }

 private:
  /// Returns g_AB of two species, which is empty if there is no such pair.
  std::vector<double> of_pair(std::size_t a, std::size_t b) {
    const double pairs = a == b ? 0.5 * members_[a] * (members_[a] - 1) : members_[a] * members_[b];
    if (pairs == 0) return {};
    return bins_.over_ideal_gas(pairs, box_, [&](std::size_t bin) {
      return found(a, b, bin) + (a == b ? 0 : found(b, a, bin));
    });
  }

  const DistanceBins& bins_;
  const PeriodicBox<Dim>& box_;
  std::vector<double> members_, found_;  // particles of every species, and counts of pairs
};

/// Returns r² cos 2θ, with r and θ of the separation from the axis of the point.
inline double along_axis(const Point<2>& point, const Vec2& separation) {
  const double x = separation.x(), y = separation.y();
  return point.director.x() * (x * x - y * y) + point.director.y() * (2 * x * y);
}
/// Returns r² cos² θ, with r and θ of the separation from the axis of the point.
inline double along_axis(const Point<3>& point, const Vec3& separation) {
  const double along = point.director.dot(separation);
  return along * along;
}

/// Returns the edges between the bins of θ as cos 2θ, in three dimensions cos² θ.
template <int Dim>
auto axis_angle_edges() {
  std::array<double, axis_angle_bins<Dim> - 1> edges;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const double part = static_cast<double>(k + 1) / axis_angle_bins<Dim>;
    edges[k] = Dim == 2 ? std::cos(std::numbers::pi * part) : (1 - part) * (1 - part);
  }
  return edges;
}

/// Returns the number of edges that θ is beyond: comparisons are faster than a division, and than an unpredictable
/// branch.
std::size_t axis_angle_bin(const auto& edges, double along, double squared_distance) {
  std::size_t bin = 0;
  for (const double edge : edges) bin += along < edge * squared_distance;
  return bin;
}

}  // namespace

template <int Dim>
PairCorrelation pair_correlation(const Configuration<Dim>& configuration,
                                 const PairCorrelationOptions& options) {
  const DistanceBins distances(configuration, options);
  if (distances.count() == 0) return {};
  std::vector<Bin> bins(distances.count() + 1);
  SpeciesPairs<Dim> species(configuration, distances);
  SortedPoints<Dim>(configuration, distances.range(), 8)
      .for_each_pair([&, is_mixture = species.is_mixture()](
                         const Point<Dim>& p, const Point<Dim>& q, const Vec<Dim>& separation) {
        const std::size_t at = distances.bin(separation.norm());
        bins[at].add(p, q);
        if (is_mixture) ++species.found(p.species, q.species, at);
      });

  const double n = static_cast<double>(configuration.size());
  PairCorrelation result;
  result.distance = distances.middles();
  result.g = distances.over_ideal_gas(0.5 * n * (n - 1), configuration.box,
                                      [&](std::size_t k) { return bins[k].pairs; });
  result.partial = species.partial();
  for (std::size_t k = 0; k < distances.count(); ++k) {
    result.g_2.push_back(bins[k].g_2(Dim));
    result.g_4.push_back(bins[k].g_4(Dim));
    result.rotor_pairs.push_back(bins[k].rotor_pairs);
  }
  return result;
}

template <int Dim>
PairCorrelationByAngle pair_correlation_by_angle(const Configuration<Dim>& configuration,
                                                 const PairCorrelationOptions& options) {
  constexpr std::size_t angles = axis_angle_bins<Dim>;
  const double range = axis_angle_range * 2 * largest_circumradius(configuration);
  const DistanceBins distances(configuration,
                               {std::min(options.distance_max, range), options.distance_step});
  const auto rotors = static_cast<double>(rotor_count(configuration));
  if (distances.count() == 0 || rotors == 0) return {};
  std::vector<double> found((distances.count() + 1) * angles);
  SortedPoints<Dim>(configuration, distances.range(), 3)
      .for_each_pair([&, edges = axis_angle_edges<Dim>()](const Point<Dim>& p, const Point<Dim>& q,
                                                          const Vec<Dim>& separation) {
        const double squared = separation.squaredNorm();
        double* const at = found.data() + distances.bin(std::sqrt(squared)) * angles;
        for (const Point<Dim>* first : {&p, &q})
          at[axis_angle_bin(edges, along_axis(*first, separation), squared)] += first->rotor;
      });

  const double pairs = rotors * (static_cast<double>(configuration.size()) - 1) / angles;
  PairCorrelationByAngle result;
  result.distance = distances.middles();
  for (std::size_t angle = 0; angle < angles; ++angle)
    result.g.push_back(distances.over_ideal_gas(
        pairs, configuration.box, [&](std::size_t k) { return found[k * angles + angle]; }));
  return result;
}

template PairCorrelation pair_correlation<2>(const Configuration2&, const PairCorrelationOptions&);
template PairCorrelation pair_correlation<3>(const Configuration3&, const PairCorrelationOptions&);
template PairCorrelationByAngle pair_correlation_by_angle<2>(const Configuration2&,
                                                             const PairCorrelationOptions&);
template PairCorrelationByAngle pair_correlation_by_angle<3>(const Configuration3&,
                                                             const PairCorrelationOptions&);

}  // namespace vitrel
