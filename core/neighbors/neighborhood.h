#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <memory>
#include <numbers>
#include <ranges>
#include <span>
#include <vector>

#include "core/contact/ellipse_gap_batch.h"
#include "core/contact/ellipsoid_gap_batch.h"
#include "core/elementary.h"
#include "core/geometry/capsule.h"
#include "core/geometry/free_flight.h"
#include "core/geometry/periodic_box.h"
#include "core/large_vector.h"
#include "core/neighbors/exit_time.h"
#include "core/neighbors/inline_cell_list.h"
#include "core/neighbors/list_pool.h"
#include "core/neighbors/neighbor.h"
#include "core/neighbors/prefetch.h"
#include "core/neighbors/type_index.h"

namespace vitrel {

/// Near-neighbour lists with neighbourhoods shaped like the particles (after Donev, Torquato & Stillinger, 2005).
///
/// Every particle carries a fixed neighbourhood: its own shape at a reference pose, expanded on all sides by `margin`.
/// While a particle stays inside its neighbourhood, it can touch only particles whose neighbourhoods overlap its own;
/// when it leaves, only its own reference pose and list are updated. A body displaced by Δr, rotated by Δθ and grown by
/// Δσ is inside its neighbourhood if
///
///     |Δr| + σ max_support_rate |Δθ| + max(Δσ, 0) circumradius ≤ margin,
///
/// since its support function has grown by no more than this in any direction. Two neighbourhoods are disjoint if the
/// bodies at their reference poses are 2 margin apart.
///
/// Cells find candidates, and capsules (capsule.h) discard most of them. A long body still has very many
/// candidates, because its circumsphere contains most of its surroundings. An outer layer of larger neighbourhoods,
/// which particles leave less often, then limits them: inner neighbourhoods can overlap only if the outer ones do.
///
/// The margin is chosen to give a target mean number of neighbours in the given configuration. A particle's own
/// images are also neighbours, with each unordered pair (i, i, ±shift) stored once.
template <Body B>
class Neighborhoods {
  static constexpr int dimension = B::dimension;
  using Vector = Vec<dimension>;
  using Image = NeighborImage<dimension>;

 public:
  using Shape = BaseShape<B>;

  /// `shapes` holds the shapes at size 1, one per type, and `type_index` the type of each particle; both must outlive
  /// this object. `poses` are wrapped into the box.
  Neighborhoods(const PeriodicBox<dimension>& box, std::span<const Shape> shapes,
                const TypeIndex& type_index, std::span<const Pose<dimension>> poses,
                double target_neighbors)
      : box_(box),
        shapes_(shapes),
        type_index_(type_index),
        largest_(std::ranges::max(shapes | std::views::transform(&Shape::circumradius))),
        smallest_(std::ranges::min(shapes | std::views::transform(&Shape::inradius))),
        sizes_differ_(std::ranges::min(shapes | std::views::transform(&Shape::circumradius)) <
                      0.8 * largest_),
        cells_(box, cell_width(poses.size()), poses.size()),
        listed_at_(poses.size()) {
    if constexpr (has_capsule) capsules_ = std::vector<CapsuleOf>(shapes.begin(), shapes.end());
    references_.reserve(poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i) {
      references_.push_back(reference(i, poses[i], 1));
      cells_.insert(i, poses[i].position);
    }
    margin_ = 0.5 * choose_gap(target_neighbors);
    const LargeVector<Pair> pairs = pairs_closer_than(2 * margin_);
    std::vector<std::uint32_t> counts(poses.size());
    for (const Pair& pair : pairs) ++counts[pair.i], ++counts[pair.image.other];
    lists_.reserve(counts);
    for (const Pair& pair : pairs) link(lists_, pair.i, Neighbor<B>{pair.image, {pair.axis}});
    if (needs_outer_layer())
      outer_ = std::make_unique<OuterLayer>(*this, max_gap(target_neighbors));
  }

  std::span<Neighbor<B>> of(std::size_t i) { return lists_[i]; }
  std::span<const Neighbor<B>> of(std::size_t i) const { return lists_[i]; }
  double margin() const { return margin_; }
  /// Returns whether there is an outer layer.
  bool is_layered() const { return outer_ != nullptr; }

  /// Stores the axis of a pair as its warm start; `normal` points from i to the other.
  void store_axis(std::size_t i, const Image& with, const Vector& normal) {
    const auto store = [&](std::size_t k, const Image& image, const Vector& axis) {
      for (Neighbor<B>& neighbor : lists_[k])
        if (neighbor.is(image)) neighbor.warm_start = {axis};
    };
    store(i, with, normal);
    store(with.other, with.reversed_image(i), -normal);
  }

  /// Returns the pose at which particle i, moving freely, will have used up a part of the margin; its position is
  /// clamped to the box. A neighbourhood around this pose lasts longer than one around the present pose. Farther ahead,
  /// a collision on the way would cost more than is gained.
  Pose<dimension> ahead_of(std::size_t i, const Pose<dimension>& pose,
                           const Motion<dimension>& motion) const {
    constexpr double part = 0.4;
    const double rate =
        norm(motion.velocity) + shape(i).max_support_rate() * norm(motion.angular_velocity);
    if (!(rate > 0)) return pose;
    Pose<dimension> ahead = advanced(pose, motion, part * margin_ / rate);
    const Vector half = 0.5 * box_.lengths();
    ahead.position = ahead.position.cwiseMax(-half).cwiseMin(half);
    return ahead;
  }

  /// Sets a new reference pose (in the box) and size of particle i, and updates its list and those of the neighbours
  /// that it gains or loses. Returns the number of neighbours that stay, which come first in its list.
  std::size_t update(std::size_t i, const Pose<dimension>& pose, double size) {
    const Reference before = references_[i];
    references_[i] = reference(i, pose, static_cast<float>(size));
    cells_.move(i, before.position, pose.position);
    if (outer_) outer_->update(i);
    remove_far(i);
    const std::size_t kept = lists_[i].size();
    add_near(i, before);
    return kept;
  }

  /// Prefetch what a prediction for particle i reads: prefetch_list_header the header of its list and, in a later call,
  /// prefetch_list the list.
  void prefetch_list_header(std::size_t i) const {
    lists_.prefetch_header(i);
    prefetch_line(&references_[i]);
  }
  void prefetch_list(std::size_t i) const { lists_.prefetch_list_header(i); }
  /// Prefetch what an update of particle i at this position reads: prefetch_cells the cells and, in a later call,
  /// prefetch_references the references of the neighbours.
  void prefetch_cells(std::size_t i, const Vector& position) {
    cells_.prefetch(position, reach_of(references_[i], i, 2 * margin_));
  }
  void prefetch_references(std::size_t i) const {
    for (const Image& neighbor : lists_[i]) prefetch_line(&references_[neighbor.other]);
  }

  /// Returns a time until which particle i, now at `pose` and of the common size, stays inside its neighbourhood;
  /// without growth, it is exactly the time at which the particle leaves.
  double exit_time(std::size_t i, const Pose<dimension>& pose, const Motion<dimension>& motion,
                   const CommonSize& common) const {
    // While the size grows by at most this much, the support rate of the larger size is a bound.
    constexpr double growth_at_once = 0.1;
    const Reference& reference = references_[i];
    const double growing = std::max(common.growth_rate, 0.0);
    const double max_size = common.size + (growing > 0 ? growth_at_once : 0);
    const double radius = shape(i).circumradius();
    const double max_support_rate = max_size * shape(i).max_support_rate();
    const Vector moved = pose.position - reference.position;
    const double slack = margin_ - radius * std::max(common.size - reference.size, 0.0);
    const double slack_rate = radius * growing;
    const double rotated =
        max_support_rate * detail::rotation_angle(reference.orientation(), orientation_of(pose));
    const double exit =
        detail::exit_time(moved, motion, rotated, max_support_rate, slack, slack_rate);
    return growing > 0 ? std::min(exit, growth_at_once / growing) : exit;
  }

 private:
  static constexpr bool has_capsule = std::constructible_from<CapsuleOf, Shape>;
  static constexpr bool is_sphere = std::same_as<Shape, Sphere>;
  struct Empty {};

  /// The pose of a neighbourhood, with the size that the particle had when the pose was set. It takes half a cache line
  /// in two dimensions and for spheres.
  struct alignas(32) Reference {
    Vector position;
    [[no_unique_address]] std::conditional_t<has_capsule, Capsule, Empty> capsule;
    float size = 1;
    [[no_unique_address]] std::conditional_t<is_sphere, Empty, Orientation<dimension>> rotated;

    Orientation<dimension> orientation() const {
      if constexpr (is_sphere)
        return Orientation<dimension>::Identity();
      else
        return rotated;
    }
  };
  using References = LargeVector<Reference>;
  using Cells = InlineCellList<dimension>;
  struct Pair {
    double gap;
    Vector axis;
    std::uint32_t i;
    Image image;
  };

  /// The outer layer: larger neighbourhoods, and lists of those that overlap.
  class OuterLayer {
   public:
    /// The margin is at most half of `max_gap`.
    OuterLayer(Neighborhoods& inner, double max_gap)
        : inner_(inner),
          margin_(std::min(times * inner.margin_, 0.5 * max_gap)),
          references_(inner.references_),
          cells_(inner.cells_),
          lists_(references_.size()) {
      for (const Pair& pair : inner.pairs_closer_than(2 * margin_))
        link(lists_, pair.i, pair.image);
    }

    /// The outer margin over the inner margin, unless `max_gap` limits it.
    static constexpr double times = 4;

    std::span<const Image> of(std::size_t i) const { return lists_[i]; }

    /// Updates the outer layer after the inner neighbourhood of i was updated.
    void update(std::size_t i) {
      if (contains(i, inner_.references_[i])) return;
      cells_.move(i, references_[i].position, inner_.references_[i].position);
      references_[i] = inner_.references_[i];
      for (const Image& image : lists_[i])
        if (image.other != i) unlink(lists_, i, image);
      lists_.clear(i);
      inner_.for_each_near(cells_, references_, i, 2 * margin_, {},
                           [&](std::size_t j, const Shift<dimension>& shift, const Vector&) {
                             link(lists_, i, Image(j, shift));
                           });
    }

   private:
    // Returns whether the body is inside its outer neighbourhood; false for a body that was wrapped to the other side
    // of the box.
    bool contains(std::size_t i, const Reference& body) const {
      const Reference& mine = references_[i];
      const auto& shape = inner_.shape(i);
      const double size = std::max(body.size, mine.size);
      const double moved =
          norm(body.position - mine.position) +
          size * shape.max_support_rate() *
              std::abs(detail::rotation_angle(mine.orientation(), body.orientation())) +
          std::max(body.size - mine.size, 0.f) * shape.circumradius();
      return moved <= margin_ - inner_.margin_;
    }

    Neighborhoods& inner_;
    double margin_;
    References references_;
    Cells cells_;
    ListPool<Image> lists_;
  };

  Reference reference(std::size_t i, const Pose<dimension>& pose, float size) const {
    Reference made{pose.position, {}, size, {}};
    if constexpr (!is_sphere) made.rotated = orientation_of(pose);
    if constexpr (has_capsule) made.capsule = capsules_[type_index_[i]].at(made.rotated, size);
    return made;
  }

  // Returns the width of cells: half the largest circumradius or, if that is larger, the width for about this number of
  // particles per cell.
  double cell_width(std::size_t particles) const {
    constexpr double particles_per_cell = 2;
    const double volume = particles_per_cell * box_.volume() / static_cast<double>(particles);
    return std::max(0.5 * largest_, root(volume, dimension));
  }

  // Returns a gap within which, at the mean density, there are certainly more neighbours than the target.
  double max_gap(double target) const {
    const double density = static_cast<double>(references_.size()) / box_.volume();
    const double of_unit = dimension == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3;
    const double reach = root(2 * target / (of_unit * density), dimension);
    return std::clamp(reach - 2 * smallest_, smallest_, 4 * largest_);
  }

  // Returns the gap within which the particles of a sample have the target number of neighbours on average.
  double choose_gap(double target) {
    constexpr std::size_t max_sampled = 512;
    const std::size_t stride = 1 + (references_.size() - 1) / max_sampled;
    const double limit = max_gap(target);
    std::vector<double> gaps;
    std::size_t sampled = 0;
    for (std::size_t i = 0; i < references_.size(); i += stride, ++sampled)
      visit_near(i, limit, [&](const Pair& pair) { gaps.push_back(pair.gap); });
    const auto rank = static_cast<std::size_t>(target * static_cast<double>(sampled));
    if (rank >= gaps.size()) return limit;
    const auto nth = gaps.begin() + static_cast<std::ptrdiff_t>(rank);
    std::ranges::nth_element(gaps, nth);
    // In a jammed packing the gaps vanish; a neighbourhood must still leave room to move.
    const double min_gap = 1e-4 * largest_;
    return std::max(*nth, min_gap);
  }

  // Returns whether cells return so many candidates that an outer layer is worthwhile, and the box is wide enough for
  // it.
  bool needs_outer_layer() const {
    constexpr double many_candidates = 400;
    const double density = static_cast<double>(references_.size()) / box_.volume();
    return density * power(4 * (largest_ + margin_), dimension) > many_candidates &&
           OuterLayer::times * margin_ < 0.25 * box_.lengths().minCoeff();
  }

  // Returns the maximum distance of images closer to particle i than `limit`. Other references are older, with sizes
  // between 1 and that of i.
  double reach_of(const Reference& reference, std::size_t i, double limit) const {
    const double size = reference.size;
    return size * shape(i).circumradius() + std::max(size, 1.0) * largest_ + limit;
  }

  /// A region whose particles are neighbours already: a ball around the previous position of the particle.
  struct Known {
    Vector offset = Vector::Zero();  // offset from the present position
    double radius = 0;
  };
  // Returns the region whose particles a body at the reference `before` certainly had as neighbours.
  Known known_at(const Reference& before, std::size_t i) const {
    const Reference& now = references_[i];
    const double size = std::min({before.size, now.size, 1.f});
    return {before.position - now.position, size * (shape(i).inradius() + smallest_) + 2 * margin_};
  }

  // Calls visit(j, shift, separation) for the images of other particles that circumspheres and capsules do not prove to
  // be `limit` apart from particle i, and that are not in the known region. Own images are visited once per unordered
  // pair.
  template <class Visit>
  void for_each_near(Cells& cells, const References& references, std::size_t i, double limit,
                     const Known& known, Visit&& visit) const {
    const Reference& mine = references[i];
    const double reach = reach_of(mine, i, limit);
    cells.for_each_in_shell(mine.position, reach, known.offset, known.radius,
                            [&](std::size_t j, const Shift<dimension>& shift) {
                              if (j == i) return;
                              const Vector d = separation(references, mine, j, shift);
                              if (!are_far(mine, i, references[j], j, d, limit)) visit(j, shift, d);
                            });
    if (box_.lengths().minCoeff() > reach) return;
    box_.for_each_image(Vector::Zero(), reach, [&](const Shift<dimension>& shift, const Vector& d) {
      if (is_positive_shift(shift) && !are_far(mine, i, mine, i, d, limit)) visit(i, shift, d);
    });
  }

  // Calls visit(j, shift, separation) for the candidates of the outer layer that are not proved to be `limit` apart
  // from particle i; `limit` is two margins.
  template <class Visit>
  void for_each_in_outer_layer(std::size_t i, double limit, Visit&& visit) const {
    const Reference& mine = references_[i];
    for (const Image& image : outer_->of(i)) {
      const Shift<dimension> shift = image.shift();
      const Vector d = separation(references_, mine, image.other, shift);
      if (!are_far(mine, i, references_[image.other], image.other, d, limit))
        visit(image.other, shift, d);
    }
  }

  Vector separation(const References& references, const Reference& from, std::size_t j,
                    const Shift<dimension>& shift) const {
    return references[j].position + box_.translation(shift) - from.position;
  }

  // Calls visit(pair) with the gap at the reference poses for each (j, shift, separation) that `for_each` passes on.
  // Axes are improved until the gaps exceed `limit`.
  template <class ForEach, class Visit>
  void visit_gaps(std::size_t i, double limit, ForEach&& for_each, Visit&& visit) const {
    const Reference& mine = references_[i];
    GapBatch<Shape> batch(scaled(shape(i), mine.size), mine.orientation(), limit);
    Image image[GapBatch<Shape>::lanes];
    int count = 0;
    const auto flush = [&] {
      batch.evaluate();
      for (int k = 0; k < count; ++k)
        visit(Pair{batch.gap(k), batch.axis(k), static_cast<std::uint32_t>(i), image[k]});
      count = 0;
    };
    for_each([&](std::size_t j, const Shift<dimension>& shift, const Vector& d) {
      const Reference& other = references_[j];
      batch.set(count, scaled(shape(j), other.size), other.orientation(), d);
      image[count++] = {j, shift};
      if (count == GapBatch<Shape>::lanes) flush();
    });
    if (count > 0) flush();
  }

  // Calls visit(pair) for all images closer to particle i than `limit`.
  template <class Visit>
  void visit_near(std::size_t i, double limit, Visit&& visit) {
    visit_gaps(
        i, limit, [&](auto&& add) { for_each_near(cells_, references_, i, limit, {}, add); },
        [&](const Pair& pair) {
          if (pair.gap < limit) visit(pair);
        });
  }

  void remove_far(std::size_t i) {
    const std::span<Neighbor<B>> neighbors = lists_[i];
    const auto for_each_neighbor = [&](auto&& add) {
      for (const Image& image : neighbors) {
        const Shift<dimension> shift = image.shift();
        add(image.other, shift,
            image.other == i ? Vector(box_.translation(shift))
                             : separation(references_, references_[i], image.other, shift));
      }
    };
    std::size_t seen = 0;
    std::uint32_t kept = 0;
    ++updates_;
    visit_gaps(i, 2 * margin_, for_each_neighbor, [&](const Pair& pair) {
      if (pair.gap < 2 * margin_) {
        listed_at_[pair.image.other] = updates_;
        neighbors[kept++] = neighbors[seen];
      } else if (pair.image.other != i)
        unlink(lists_, i, pair.image);
      ++seen;
    });
    lists_.truncate(i, kept);
  }

  void add_near(std::size_t i, const Reference& before) {
    const double limit = 2 * margin_;
    const auto is_listed = [&](std::size_t j, const Shift<dimension>& shift) {
      if (listed_at_[j] != updates_) return false;
      const Image image(j, shift);
      return std::ranges::any_of(lists_[i], [&](const Image& known) { return known == image; });
    };
    const auto for_each_candidate = [&](auto&& add) {
      const auto add_unlisted = [&](std::size_t j, const Shift<dimension>& shift, const Vector& d) {
        if (!is_listed(j, shift)) add(j, shift, d);
      };
      if (outer_)
        for_each_in_outer_layer(i, limit, add_unlisted);
      else
        for_each_near(cells_, references_, i, limit, known_at(before, i), add_unlisted);
    };
    visit_gaps(i, limit, for_each_candidate, [&](const Pair& pair) {
      if (pair.gap < limit) link(lists_, i, Neighbor<B>{pair.image, {pair.axis}});
    });
  }

  // Returns whether two particles are proved to be more than `limit` apart. The reach of a query of the cells allows
  // for the largest particle, so among particles of very different sizes most candidates are far away, as their
  // circumspheres show.
  bool are_far(const Reference& one, std::size_t i, const Reference& two, std::size_t j,
               const Vector& d, double limit) const {
    if (sizes_differ_) {
      constexpr double rounding = 1 + 1e-6;  // sizes are rounded
      const double reach =
          rounding * (one.size * shape(i).circumradius() + two.size * shape(j).circumradius()) +
          limit;
      if (squared_norm(d) > reach * reach) return true;
    }
    if constexpr (has_capsule)
      return farther_apart(one.capsule, two.capsule, d, limit);
    else
      return false;
  }

  LargeVector<Pair> pairs_closer_than(double limit) {
    LargeVector<Pair> pairs;
    for (std::size_t i = 0; i < references_.size(); ++i)
      visit_near(i, limit, [&](const Pair& pair) {
        if (pair.image.other >= i) pairs.push_back(pair);
      });
    return pairs;
  }

  // Returns particle i as a neighbour of its neighbour.
  static Neighbor<B> reversed_image(std::size_t i, const Neighbor<B>& neighbor) {
    return {neighbor.reversed_image(i), reversed(neighbor.warm_start)};
  }
  static Image reversed_image(std::size_t i, const Image& image) { return image.reversed_image(i); }

  // `link` adds i and the other particle to each other's lists, and `unlink` removes i from the list of the other; both
  // serve either layer.
  template <class Entry>
  static void link(ListPool<Entry>& lists, std::size_t i, const Entry& entry) {
    lists.add(i, entry);
    if (i != entry.other) lists.add(entry.other, reversed_image(i, entry));
  }
  template <class Entry>
  static void unlink(ListPool<Entry>& lists, std::size_t i, const Image& image) {
    const Image mine = image.reversed_image(i);
    lists.remove_if(image.other, [&](const Image& known) { return known == mine; });
  }

  const Shape& shape(std::size_t i) const { return shapes_[type_index_[i]]; }

  PeriodicBox<dimension> box_;
  std::span<const Shape> shapes_;
  const TypeIndex& type_index_;
  ListPool<Neighbor<B>> lists_;
  std::vector<CapsuleOf> capsules_;  // capsule of each type
  double largest_, smallest_;        // largest circumradius and smallest inradius
  bool sizes_differ_;                // whether the circumradii differ
  References references_;
  Cells cells_;
  std::vector<std::uint32_t>
      listed_at_;  // the last update in which each particle was a neighbour that stayed
  std::uint32_t updates_ = 0;
  double margin_ = 0;
  std::unique_ptr<OuterLayer> outer_;
};

}  // namespace vitrel
