#include "core/state/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <tuple>

#include "core/elementary.h"
#include "core/error.h"
#include "core/large_vector.h"
#include "core/state/exact_pair.h"
#include "core/tolerances.h"

namespace vitrel {
namespace {

using exact::Particle;
using exact::Point;
using Real = Extended;

std::string within_boxes() {
  return std::to_string(static_cast<int>(tolerance::max_box_lengths)) + " box lengths";
}

void validate_orientation(const Configuration2& configuration, std::size_t i,
                          const std::string& who) {
  if (!std::isfinite(configuration.angle[i]))
    throw InvariantError(who + ": its angle must be finite");
}

void validate_orientation(const Configuration3& configuration, std::size_t i,
                          const std::string& who) {
  constexpr double rounding = 1e-9;
  if (!(std::abs(configuration.orientation[i].norm() - 1) <= rounding))
    throw InvariantError(who + ": its orientation must be a quaternion of norm 1");
}

template <int Dim>
void validate_body(const Configuration<Dim>& configuration, std::size_t i, const std::string& who) {
  validate_orientation(configuration, i, who);
  const ParticleShape<Dim>& shape = configuration.shape[i];
  if (!(shape_of<Dim>(shape.half_lengths()) &&
        shape.circumradius() <=
            tolerance::max_box_lengths * configuration.box.lengths().minCoeff()))
    throw InvariantError(who + ": it must have " + half_lengths_rule<Dim>() +
                         ", and no semi-axis above " + within_boxes());
}

template <int Dim>
void validate(const Configuration<Dim>& configuration) {
  const Vec<Dim>& lengths = configuration.box.lengths();
  constexpr double shortest = 1e-70, longest = 1e70;
  if (!(lengths.allFinite() && lengths.minCoeff() >= shortest && lengths.maxCoeff() <= longest))
    throw InvariantError("exact check: the box lengths must be between 1e-70 and 1e70");
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const Vec<Dim>& position = configuration.position[i];
    const std::string who = "exact check: particle " + std::to_string(i);
    if (!position.allFinite() ||
        (position.cwiseAbs().array() > tolerance::max_box_lengths * lengths.array()).any())
      throw InvariantError(who + ": its position must be finite and within " + within_boxes() +
                           " of the origin");
    validate_body(configuration, i, who);
  }
}

template <int Dim>
LargeVector<Particle<Dim>> in_extended_precision(const Configuration<Dim>& configuration) {
  LargeVector<Particle<Dim>> particles;
  particles.reserve(configuration.size());
  for (std::size_t i = 0; i < configuration.size(); ++i)
    particles.push_back(exact::particle(configuration.shape[i], configuration.pose(i)));
  return particles;
}

/// The circumcircle (sphere) of a particle in double precision, in units of the longest box length.
template <int Dim>
struct Circumsphere {
  Vec<Dim> centre;  // wrapped, from 0 to L
  double radius;
  std::size_t particle;
};

/// Examines pairs of particles and collects the results.
///
/// Pairs far apart are rejected in double precision, with the longest box length as the unit and u = 2⁻⁵³. Wrapped
/// centres are rounded by u. A component of the distance to the nearest image takes two centres, a box length rounded
/// by u, and two subtractions, so its error is at most 5u, and that of the distance 9u. Squares, sums of radii and
/// their comparison add 8u of the sum of radii. The margin 2⁻⁴⁰ (1 + a), where a is the longest semi-axis, is more than
/// 2⁸ times as much.
template <int Dim>
class Examination {
  /// The components of a shift, as an array because arrays can be compared.
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
    scale_ = 1 / lengths_.maxCoeff();
    box_ = (scale_ * lengths_).template cast<double>();
    margin_ = 0x1p-40 * (1 + scaled(nearness_));
    set_smallest_gap(nearness_);
  }

  /// Centres that are farther apart than this cannot affect the result.
  double reach() const { return 3 * scaled(nearness_) + margin_; }
  const Vec<Dim>& box() const { return box_; }

  LargeVector<Circumsphere<Dim>> circumspheres() const {
    LargeVector<Circumsphere<Dim>> spheres;
    spheres.reserve(particles_.size());
    for (const Particle<Dim>& particle : particles_) {
      Point<Dim> centre = particle.centre;
      for (int k = 0; k < Dim; ++k)
        centre[k] -= std::floor(static_cast<double>(centre[k] / lengths_[k])) * lengths_[k];
      spheres.push_back({(scale_ * centre).template cast<double>(), scaled(particle.circumradius),
                         spheres.size()});
    }
    return spheres;
  }

  /// Examines all images of a pair, or of a particle with itself.
  void examine(const Circumsphere<Dim>& one, const Circumsphere<Dim>& two) {
    if (far_apart(one, two)) return;
    const auto [i, j] = std::minmax(one.particle, two.particle);
    const Real reach =
        particles_[i].circumradius + particles_[j].circumradius + clearance_ / scale_;
    Boxes shift{};
    examine_images<0>(i, j, shift, particles_[j].centre - particles_[i].centre, reach);
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

  double scaled(Real length) const { return static_cast<double>(scale_ * length); }

  /// Pairs with a larger gap do not change the result.
  Real relevant_gap() const { return std::max<Real>(0, smallest_gap_); }

  void set_smallest_gap(Real gap) {
    smallest_gap_ = gap;
    clearance_ = scaled(relevant_gap()) + margin_;
  }

  bool far_apart(const Circumsphere<Dim>& one, const Circumsphere<Dim>& two) const {
    double square = 0;
    for (int k = 0; k < Dim; ++k) {
      const double away = std::abs(two.centre[k] - one.centre[k]);
      const double nearest = std::min(away, box_[k] - away);
      square += nearest * nearest;
    }
    const double reach = one.radius + two.radius + clearance_;
    return square > reach * reach;
  }

  /// Examines the images whose shift has the given components before component k, which `d` already includes.
  /// Truncation may add some images that are out of reach.
  template <int k>
  void examine_images(std::size_t i, std::size_t j, Boxes& shift, const Point<Dim>& d, Real reach) {
    if constexpr (k == Dim) {
      if (i != j || shift > Boxes{}) examine_image(i, j, shift, d);
    } else {
      const int last = truncated((reach - d[k]) / lengths_[k]);
      for (shift[k] = truncated((-reach - d[k]) / lengths_[k]); shift[k] <= last; ++shift[k]) {
        Point<Dim> shifted = d;
        shifted[k] += shift[k] * lengths_[k];
        examine_images<k + 1>(i, j, shift, shifted, reach);
      }
    }
  }

  /// Truncates by way of double, which is much faster. Below 2¹¹ the conversion rounds by 2⁻⁴², less than the margin.
  static int truncated(Real boxes) { return static_cast<int>(static_cast<double>(boxes)); }

  void examine_image(std::size_t i, std::size_t j, const Boxes& shift, const Point<Dim>& d) {
    const Particle<Dim>& one = particles_[i];
    const Particle<Dim>& two = particles_[j];
    const Real circles = d.norm() - (one.circumradius + two.circumradius);
    if (circles >= relevant_gap()) return;
    if (circles < 0) ++pairs_examined_;
    if (circles < 0 && may_overlap({i, j, shift}, d)) return;
    const auto finding = exact::examine(one, two, d, smallest_gap_);
    if (finding.overlap) overlaps_.push_back({i, j, Shift<Dim>(shift.data())});
    if (finding.gap < smallest_gap_) set_smallest_gap(finding.gap);
  }

  LargeVector<Particle<Dim>> particles_;
  Point<Dim> lengths_;
  std::map<Place, double> closest_;  // smallest distances of close pairs
  Real nearness_ = 0;                // the longest semi-axis
  Real scale_ = 0;                   // one over the longest box length
  double margin_ = 0;
  Vec<Dim> box_;  // box lengths, scaled
  Real smallest_gap_ = 0;
  double clearance_ = 0;  // the relevant gap, scaled, plus the margin
  std::vector<PairImage<Dim>> overlaps_;
  std::uint64_t pairs_examined_ = 0;
};

/// Periodic cells at least `reach` wide, so that everything within reach of a particle is in its cell or in one next to
/// it. The cells only select candidates; images are found pair by pair.
template <int Dim>
class Cells {
 public:
  /// Makes at most `most` cells along each axis.
  Cells(const Examination<Dim>& examination, double most) : box_(examination.box()) {
    // Cells are a little wider than needed, so that rounding cannot move a particle out of reach.
    const double width = examination.reach() * (1 + 1e-6);
    std::size_t cells = 1;
    for (int k = 0; k < Dim; ++k) {
      count_[k] = static_cast<int>(std::clamp(std::floor(box_[k] / width), 1.0, most));
      cells *= count_[k];
    }
    own_images_ = box_.minCoeff() <= width;
    sort(examination.circumspheres(), cells);
  }

  /// Calls visit once for every pair in the same or neighbouring cells and, in a small box, for every particle with
  /// itself.
  void for_each_pair(auto&& visit) const {
    for (std::size_t s = 0; s < members_.size(); ++s) {
      const std::size_t first = own_images_ ? s : s + 1;
      for_each_near_cell<0>(members_[s].centre, 0, [&](std::size_t cell) {
        for (std::size_t t = std::max(first, begin_[cell]); t < begin_[cell + 1]; ++t)
          visit(members_[s], members_[t]);
      });
    }
  }

 private:
  void sort(const LargeVector<Circumsphere<Dim>>& spheres, std::size_t cells) {
    begin_.assign(cells + 1, 0);
    for (const auto& sphere : spheres) ++begin_[cell_of(sphere.centre) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    members_.resize(spheres.size());
    std::vector<std::size_t> next = begin_;
    for (const auto& sphere : spheres) members_[next[cell_of(sphere.centre)]++] = sphere;
  }

  /// Visits each cell near `centre` once, even if there are fewer than three along an axis. `index` combines the first
  /// k coordinates of the cell.
  template <int k, class Visit>
  void for_each_near_cell(const Vec<Dim>& centre, std::size_t index, Visit&& visit) const {
    if constexpr (k == Dim) {
      visit(index);
    } else {
      const int n = count_[k];
      const int before = coordinate_of(centre[k], k) + n - 1;
      for (int step = 0; step < std::min(n, 3); ++step)
        for_each_near_cell<k + 1>(centre, index * n + (before + step) % n, visit);
    }
  }

  std::size_t cell_of(const Vec<Dim>& centre) const {
    std::size_t index = 0;
    for (int k = 0; k < Dim; ++k) index = index * count_[k] + coordinate_of(centre[k], k);
    return index;
  }

  int coordinate_of(double centre, int k) const {
    return std::clamp(static_cast<int>(centre / box_[k] * count_[k]), 0, count_[k] - 1);
  }

  Vec<Dim> box_;
  std::array<int, Dim> count_{};
  bool own_images_;
  LargeVector<Circumsphere<Dim>> members_;  // sorted by cell
  std::vector<std::size_t> begin_;          // where each cell begins in members_, and the end
};

}  // namespace

template <int Dim>
ExactCheck<Dim> exact_check(const Configuration<Dim>& configuration,
                            std::size_t brute_force_limit) {
  validate(configuration);
  const std::size_t size = configuration.size();
  Examination<Dim> examination(configuration);
  const double cells = size <= brute_force_limit ? 1 : std::ceil(root(size, Dim));
  Cells<Dim>(examination, cells).for_each_pair([&](const auto& one, const auto& two) {
    examination.examine(one, two);
  });
  return std::move(examination).result();
}

template ExactCheck<2> exact_check(const Configuration2&, std::size_t);
template ExactCheck<3> exact_check(const Configuration3&, std::size_t);

}  // namespace vitrel
