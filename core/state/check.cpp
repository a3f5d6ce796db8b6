#include "core/state/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <tuple>

#include "core/error.h"
#include "core/state/exact_pair.h"

namespace vitrel {
namespace {

using exact::Particle;
using exact::Point;
using exact::Real;

/// Limit of positions and semi-axes in box lengths. Shifts then stay below 2¹¹, so that shift ∘ L
/// is exact in 64 bits, 53 of which belong to L.
constexpr double most_boxes = 300;

std::string within_boxes() {
  return std::to_string(static_cast<int>(most_boxes)) + " box lengths";
}

void validate_body(const Configuration2& configuration, std::size_t i, const std::string& who) {
  const Ellipse& shape = configuration.shape[i];
  if (!std::isfinite(configuration.angle[i]))
    throw InvariantError(who + ": its angle must be finite");
  if (!(shape.b > 0 && shape.a >= shape.b &&
        shape.a <= most_boxes * configuration.box.lengths().minCoeff()))
    throw InvariantError(who + ": its semi-axes must obey b > 0 and b ≤ a ≤ " + within_boxes());
}

void validate_body(const Configuration3& configuration, std::size_t i, const std::string& who) {
  const Vec3& semi_axes = configuration.shape[i].semi_axes;
  constexpr double rounding = 1e-9;
  if (!(std::abs(configuration.orientation[i].norm() - 1) <= rounding))
    throw InvariantError(who + ": its orientation must be a quaternion of norm 1");
  if (!((semi_axes.array() > 0).all() &&
        semi_axes.maxCoeff() <= most_boxes * configuration.box.lengths().minCoeff()))
    throw InvariantError(who + ": its semi-axes must be above 0 and at most " + within_boxes());
}

template <int Dim>
void validate(const Configuration<Dim>& configuration) {
  const Vec<Dim>& lengths = configuration.box.lengths();
  if (!(lengths.allFinite() && lengths.minCoeff() > 0))
    throw InvariantError("exact check: the box lengths must be finite and positive");
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const Vec<Dim>& position = configuration.position[i];
    const std::string who = "exact check: particle " + std::to_string(i);
    if (!position.allFinite() || (position.cwiseAbs().array() > most_boxes * lengths.array()).any())
      throw InvariantError(who + ": its position must be finite and within " + within_boxes() +
                           " of the origin");
    validate_body(configuration, i, who);
  }
}

template <int Dim>
std::vector<Particle<Dim>> in_extended_precision(const Configuration<Dim>& configuration) {
  std::vector<Particle<Dim>> particles;
  particles.reserve(configuration.size());
  for (std::size_t i = 0; i < configuration.size(); ++i)
    particles.push_back(exact::particle(configuration, i));
  return particles;
}

/// Walks over pairs of particles and keeps the findings.
template <int Dim>
class Examination {
  /// Compares component by component.
  using Boxes = std::array<std::int32_t, Dim>;

 public:
  explicit Examination(const Configuration<Dim>& configuration)
      : particles_(in_extended_precision(configuration)),
        lengths_(configuration.box.lengths().template cast<Real>()) {
    for (const auto& [pair, distance] : configuration.close_pairs) {
      if (pair.i > pair.j) throw InvariantError("exact check: a close pair must have i ≤ j");
      closest_[place(pair)] = distance;
    }
    for (const Particle<Dim>& particle : particles_)
      nearness_ = std::max(nearness_, particle.circumradius);
    smallest_gap_ = nearness_;
  }

  std::size_t size() const { return particles_.size(); }
  const Particle<Dim>& particle(std::size_t i) const { return particles_[i]; }
  /// No two centres farther apart than this have a surface distance that matters.
  Real reach() const { return 3 * nearness_; }

  /// All images of the pair i ≤ j.
  void examine(std::size_t i, std::size_t j) {
    const Particle<Dim>& one = particles_[i];
    const Particle<Dim>& two = particles_[j];
    const Point<Dim> d = two.centre - one.centre;
    const Real reach = one.circumradius + two.circumradius + std::max<Real>(0, smallest_gap_);
    for (int k = 0; k < Dim; ++k)
      if (beyond(reach, d[k], lengths_[k])) return;
    Boxes shift{};
    examine_images<0>(i, j, shift, d, reach);
  }

  ExactCheck<Dim> result() && {
    std::ranges::sort(overlaps_, {}, place);
    const double gap = smallest_gap_ < nearness_ ? static_cast<double>(smallest_gap_)
                                                 : std::numeric_limits<double>::infinity();
    return {std::move(overlaps_), gap, pairs_examined_};
  }

 private:
  using Place = std::tuple<std::size_t, std::size_t, Boxes>;
  static Place place(const PairImage<Dim>& pair) {
    Boxes shift;
    std::copy(pair.shift.begin(), pair.shift.end(), shift.begin());
    return {pair.i, pair.j, shift};
  }

  bool may_overlap(const Place& pair, const Point<Dim>& d) const {
    const auto found = closest_.find(pair);
    return found != closest_.end() && d.norm() >= found->second;
  }

  /// Quick and sufficient for |d| ≤ L: then d itself and one image are the nearest.
  static bool beyond(Real reach, Real d, Real length) {
    const Real away = std::abs(d);
    return away > reach && length - away > reach;
  }

  /// Images whose components before k of the shift are given and contained in d.
  template <int k>
  void examine_images(std::size_t i, std::size_t j, Boxes& shift, const Point<Dim>& d, Real reach) {
    if constexpr (k == Dim) {
      if (i != j || shift > Boxes{}) examine_image(i, j, shift, d);
    } else {
      const int last = static_cast<int>(std::floor((reach - d[k]) / lengths_[k]));
      shift[k] = static_cast<int>(std::ceil((-reach - d[k]) / lengths_[k]));
      for (; shift[k] <= last; ++shift[k]) {
        Point<Dim> shifted = d;
        shifted[k] += shift[k] * lengths_[k];
        examine_images<k + 1>(i, j, shift, shifted, reach);
      }
    }
  }

  void examine_image(std::size_t i, std::size_t j, const Boxes& shift, const Point<Dim>& d) {
    const Particle<Dim>& one = particles_[i];
    const Particle<Dim>& two = particles_[j];
    const Real circles = d.norm() - (one.circumradius + two.circumradius);
    if (circles >= std::max<Real>(0, smallest_gap_)) return;
    if (circles < 0) ++pairs_examined_;
    if (circles < 0 && may_overlap({i, j, shift}, d)) return;
    const exact::Finding finding = exact::examine(one, two, d, smallest_gap_);
    if (finding.overlap) overlaps_.push_back({i, j, Shift<Dim>(shift.data())});
    smallest_gap_ = std::min(smallest_gap_, finding.gap);
  }

  std::vector<Particle<Dim>> particles_;
  Point<Dim> lengths_;
  std::map<Place, double> closest_;  // of close pairs
  Real nearness_ = 0;
  Real smallest_gap_ = 0;
  std::vector<PairImage<Dim>> overlaps_;
  std::uint64_t pairs_examined_ = 0;
};

template <int Dim>
void examine_all_pairs(Examination<Dim>& examination) {
  for (std::size_t i = 0; i < examination.size(); ++i)
    for (std::size_t j = i; j < examination.size(); ++j) examination.examine(i, j);
}

/// Cells at least `reach` wide, periodic: what lies within reach of a particle is in its cell or
/// in one next to it. They only name the candidates; images are found pair by pair.
template <int Dim>
class Cells {
 public:
  Cells(const Examination<Dim>& examination, const Vec<Dim>& lengths) : lengths_(lengths) {
    // A little wider than needed, so that rounding cannot move a particle out of reach.
    const double width = static_cast<double>(examination.reach()) * (1 + 1e-6);
    const double most = std::pow(static_cast<double>(examination.size()), 1.0 / Dim);
    std::size_t cells = 1;
    for (int k = 0; k < Dim; ++k) {
      count_[k] =
          static_cast<int>(std::clamp(std::floor(lengths[k] / width), 1.0, std::ceil(most)));
      cells *= count_[k];
    }
    members_.resize(cells);
    for (std::size_t i = 0; i < examination.size(); ++i) {
      std::size_t index = 0;
      for (int k = 0; k < Dim; ++k)
        index = index * count_[k] + cell_of(examination.particle(i).centre[k], k);
      members_[index].push_back(i);
    }
  }

  /// Calls visit(j) once for every particle in the cell of `centre` and its neighbours.
  template <class Visit>
  void for_each_near(const Point<Dim>& centre, Visit&& visit) const {
    visit_near<0>(centre, 0, visit);
  }

 private:
  /// `index` is that of the cell's first k coordinates.
  template <int k, class Visit>
  void visit_near(const Point<Dim>& centre, std::size_t index, Visit& visit) const {
    if constexpr (k == Dim) {
      for (std::size_t j : members_[index]) visit(j);
    } else {
      for (int cell : neighbours(cell_of(centre[k], k), k))
        visit_near<k + 1>(centre, index * count_[k] + cell, visit);
    }
  }

  int cell_of(Real coordinate, int k) const {
    const Real fraction = coordinate / lengths_[k];
    const Real within = fraction - std::floor(fraction);
    return std::min(static_cast<int>(within * count_[k]), count_[k] - 1);
  }

  /// The cell and those beside it, each once even if there are fewer than three.
  std::vector<int> neighbours(int cell, int k) const {
    const int n = count_[k];
    std::vector<int> cells{cell};
    if (n > 1) cells.push_back((cell + 1) % n);
    if (n > 2) cells.push_back((cell + n - 1) % n);
    return cells;
  }

  Vec<Dim> lengths_;
  std::array<int, Dim> count_{};
  std::vector<std::vector<std::size_t>> members_;
};

template <int Dim>
void examine_by_cells(Examination<Dim>& examination, const Vec<Dim>& lengths) {
  const Cells<Dim> cells(examination, lengths);
  for (std::size_t i = 0; i < examination.size(); ++i)
    cells.for_each_near(examination.particle(i).centre, [&](std::size_t j) {
      if (j >= i) examination.examine(i, j);
    });
}

}  // namespace

template <int Dim>
ExactCheck<Dim> exact_check(const Configuration<Dim>& configuration,
                            std::size_t brute_force_limit) {
  validate(configuration);
  const Vec<Dim>& lengths = configuration.box.lengths();
  Examination<Dim> examination(configuration);
  if (examination.size() <= brute_force_limit)
    examine_all_pairs(examination);
  else
    examine_by_cells(examination, lengths);
  return std::move(examination).result();
}

template ExactCheck<2> exact_check(const Configuration2&, std::size_t);
template ExactCheck<3> exact_check(const Configuration3&, std::size_t);

}  // namespace vitrel
