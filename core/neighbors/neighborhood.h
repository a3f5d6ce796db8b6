#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include "core/contact/ellipse_contact_screen.h"
#include "core/contact/ellipse_gap_batch.h"
#include "core/contact/ellipsoid_contact_screen.h"
#include "core/contact/ellipsoid_gap_batch.h"
#include "core/geometry/capsule.h"
#include "core/geometry/periodic_box.h"
#include "core/neighbors/cell_grid.h"
#include "core/neighbors/list_pool.h"
#include "core/neighbors/prefetch.h"
#include "core/neighbors/type_index.h"

namespace vitrel {

/// The image (j, shift) of another particle, at r_j + shift ∘ L.
template <int Dim>
struct NeighborImage {
  std::uint32_t other = 0;
  std::array<std::int16_t, Dim> boxes{};  // compact, because lists are read in every prediction

  NeighborImage() = default;
  NeighborImage(std::size_t j, const Shift<Dim>& shift) : other(static_cast<std::uint32_t>(j)) {
    for (int k = 0; k < Dim; ++k) boxes[k] = static_cast<std::int16_t>(shift[k]);
  }

  Shift<Dim> shift() const {
    Shift<Dim> wide;
    for (int k = 0; k < Dim; ++k) wide[k] = boxes[k];
    return wide;
  }
  /// The image of particle i that is a neighbour of the other particle.
  NeighborImage reversed_image(std::size_t i) const { return {i, -shift()}; }
  bool operator==(const NeighborImage& image) const {
    bool same = other == image.other;
    for (int k = 0; k < Dim; ++k) same = same && boxes[k] == image.boxes[k];
    return same;
  }
};

/// A neighbour: an image, with the warm start of the contact screen for this pair.
template <Body B>
struct Neighbor : NeighborImage<B::dimension> {
  [[no_unique_address]] typename ContactScreen<B>::WarmStart warm_start;

  bool is(const NeighborImage<B::dimension>& image) const { return image == *this; }
};

/// Near-neighbour lists with neighbourhoods shaped like the particles (after Donev, Torquato & Stillinger, 2005).
///
/// Every particle carries a fixed neighbourhood: its own shape at a reference pose, expanded on all sides by
/// `margin`. While it stays inside, it can touch only particles whose neighbourhoods overlap its own; when it
/// leaves, only its own reference pose and list are updated. A body displaced by Δr, rotated by Δθ and grown by Δσ
/// is inside its neighbourhood if
///
///     |Δr| + σ max_support_rate |Δθ| + max(Δσ, 0) circumradius ≤ margin,
///
/// since its support function has grown by no more than that in any direction. Two neighbourhoods are disjoint if
/// the bodies at their reference poses are 2 margin apart.
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

  /// `shapes` at size 1, one per type, and the type of each particle; both must outlive this object. `poses` are
  /// wrapped into the box.
  Neighborhoods(const PeriodicBox<dimension>& box, std::span<const Shape> shapes,
                const TypeIndex& type_index, std::span<const Pose<dimension>> poses,
                double target_neighbors)
      : box_(box),
        shapes_(shapes),
        type_index_(type_index),
        largest_(largest_circumradius()),
        references_(box, cell_reach(poses.size()), poses.size()) {
    if constexpr (has_capsule) capsules_ = std::vector<CapsuleOf>(shapes.begin(), shapes.end());
    for (std::size_t i = 0; i < poses.size(); ++i) references_.insert(i, reference(i, poses[i], 1));
    const double max_candidate_gap = max_gap(target_neighbors);
    const std::vector<Pair> pairs = pairs_closer_than(max_candidate_gap);
    margin_ = 0.5 * choose_gap(pairs, target_neighbors);
    std::vector<std::uint32_t> counts(poses.size());
    const auto near = [&](const Pair& pair) { return pair.gap < 2 * margin_; };
    for (const Pair& pair : pairs)
      if (near(pair)) ++counts[pair.i], ++counts[pair.image.other];
    lists_.reserve(counts);
    for (const Pair& pair : pairs)
      if (near(pair)) link(lists_, pair.i, Neighbor<B>{pair.image, {pair.axis}});
    if (needs_outer_layer()) outer_ = std::make_unique<OuterLayer>(*this, pairs, max_candidate_gap);
  }

  std::span<Neighbor<B>> of(std::size_t i) { return lists_[i]; }
  std::span<const Neighbor<B>> of(std::size_t i) const { return lists_[i]; }
  double margin() const { return margin_; }
  /// Whether there is an outer layer.
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

  /// Sets a new reference pose (wrapped into the box) and size of particle i, and updates its list.
  void update(std::size_t i, const Pose<dimension>& pose, double size) {
    references_.move(i, reference(i, pose, static_cast<float>(size)));
    if (outer_) outer_->update(i);
    candidates_.clear();
    visit_near(i, 2 * margin_, 0, [&](const Pair& pair) { candidates_.push_back(pair); });
    // Most neighbours stay; only the lists of added and removed neighbours change.
    previous_.assign(lists_[i].begin(), lists_[i].end());
    lists_.clear(i);
    for (const Pair& pair : candidates_)
      if (const auto known = std::find(previous_.begin(), previous_.end(), pair.image);
          known != previous_.end()) {
        lists_.add(i, *known);
        *known = previous_.back();
        previous_.pop_back();
      } else {
        link(lists_, i, Neighbor<B>{pair.image, {pair.axis}});
      }
    for (const Neighbor<B>& gone : previous_)
      if (gone.other != i) unlink(lists_, i, gone);
  }

  /// Prefetches what a prediction for particle i reads: the header of its list and, in a later call, the list.
  void prefetch_list_header(std::size_t i) const {
    lists_.prefetch_header(i);
    prefetch_line(&references_[i]);
  }
  void prefetch_list(std::size_t i) const { lists_.prefetch_list_header(i); }
  /// Prefetches what an update at this position reads: the cells and, in a later call, the references in them.
  void prefetch_cells(std::size_t i, const Vector& position) const {
    references_.prefetch_cells(position, reach_of(references_, i, 2 * margin_));
  }
  void prefetch_references(std::size_t i, const Vector& position) const {
    references_.prefetch_points(position, reach_of(references_, i, 2 * margin_));
  }

  /// A time until which particle i, now at `pose` and of the common size, stays inside its neighbourhood; without
  /// growth exactly the time at which it leaves.
  double exit_time(std::size_t i, const Pose<dimension>& pose, const Motion<dimension>& motion,
                   const CommonSize& common) const {
    // While the size grows by at most this fraction, the support rate of the larger size is a bound.
    constexpr double growth_at_once = 0.1;
    const Reference& reference = references_[i];
    const double growing = std::max(common.growth_rate, 0.0);
    const double max_size = common.size + (growing > 0 ? growth_at_once : 0);
    const double radius = shape(i).circumradius();
    const double max_support_rate = max_size * shape(i).max_support_rate();
    const Vector moved = pose.position - reference.position;
    const double slack = margin_ - radius * std::max(common.size - reference.size, 0.0);
    const double slack_rate = radius * growing;
    const double exit =
        crossing(moved, motion,
                 max_support_rate * rotation_angle(reference.orientation(), orientation_of(pose)),
                 max_support_rate, slack, slack_rate);
    return growing > 0 ? std::min(exit, growth_at_once / growing) : exit;
  }

 private:
  static constexpr bool has_capsule = std::same_as<Shape, Ellipsoid>;
  static constexpr bool is_sphere = std::same_as<Shape, Sphere>;
  struct Empty {};

  /// The pose of a neighbourhood, with the size that the particle had when it was set. Half a cache line in two
  /// dimensions and for spheres.
  struct alignas(32) Reference {
    Vector position;
    [[no_unique_address]] std::conditional_t<has_capsule, Capsule, Empty> capsule;
    std::uint32_t next = 0;  // set by the grid
    float size = 1;
    [[no_unique_address]] std::conditional_t<is_sphere, Empty, Orientation<dimension>> rotated;

    Orientation<dimension> orientation() const {
      if constexpr (is_sphere)
        return Orientation<dimension>::Identity();
      else
        return rotated;
    }
  };
  using References = CellGrid<dimension, Reference>;
  struct Pair {
    double gap;
    Vector axis;
    std::uint32_t i;
    Image image;
  };

  /// The outer layer: larger neighbourhoods and the lists of those that overlap.
  class OuterLayer {
   public:
    /// `pairs` are all pairs closer than `reach`.
    OuterLayer(const Neighborhoods& inner, std::span<const Pair> pairs, double reach)
        : inner_(inner),
          margin_(std::min(times * inner.margin_, 0.5 * reach)),
          references_(inner.references_),
          lists_(references_.size()) {
      for (const Pair& pair : pairs)
        if (pair.gap < 2 * margin_) link(lists_, pair.i, pair.image);
    }

    /// Outer margin over inner margin.
    static constexpr double times = 4;

    std::span<const Image> of(std::size_t i) const { return lists_[i]; }

    /// Follows an update of the inner neighbourhood of i.
    void update(std::size_t i) {
      if (contains(i, inner_.references_[i])) return;
      references_.move(i, inner_.references_[i]);
      for (const Image& image : lists_[i])
        if (image.other != i) unlink(lists_, i, image);
      lists_.clear(i);
      for_each_near(i, [&](const Image& image) { link(lists_, i, image); });
    }

   private:
    // False for a body that was wrapped to the other side of the box.
    bool contains(std::size_t i, const Reference& body) const {
      const Reference& mine = references_[i];
      const auto& shape = inner_.shape(i);
      const double size = std::max(body.size, mine.size);
      const double moved = (body.position - mine.position).norm() +
                           size * shape.max_support_rate() *
                               std::abs(rotation_angle(mine.orientation(), body.orientation())) +
                           std::max(body.size - mine.size, 0.f) * shape.circumradius();
      return moved <= margin_ - inner_.margin_;
    }

    template <class Visit>
    void for_each_near(std::size_t i, Visit&& visit) const {
      inner_.for_each_near(references_, i, 2 * margin_, 0,
                           [&](std::size_t j, const Shift<dimension>& shift, const Vector&) {
                             visit(Image(j, shift));
                           });
    }

    const Neighborhoods& inner_;
    double margin_;
    References references_;
    ListPool<Image> lists_;
  };

  Reference reference(std::size_t i, const Pose<dimension>& pose, float size) const {
    Reference made{pose.position, {}, 0, size, {}};
    if constexpr (!is_sphere) made.rotated = orientation_of(pose);
    if constexpr (has_capsule) made.capsule = capsules_[type_index_[i]].at(made.rotated, size);
    return made;
  }

  // The rotation angle between two orientations: signed in two dimensions, the smallest one in three.
  static double rotation_angle(double from, double to) { return to - from; }
  static double rotation_angle(const Quaternion& from, const Quaternion& to) {
    return from.angularDistance(to);
  }

  // The time at which displacement and rotation together use up the slack: in two dimensions the body may
  // continue in either sense, in three the bound is rotation away from the reference.
  static double crossing(const Vector& moved, const Motion2& motion, double rotated,
                         double max_support_rate, double slack, double slack_rate) {
    const double turning = max_support_rate * motion.angular_velocity;
    const double exit = crossing(moved, motion.velocity, slack - rotated, -turning - slack_rate);
    return max_support_rate == 0 ? exit
                                 : std::min(exit, crossing(moved, motion.velocity, slack + rotated,
                                                           turning - slack_rate));
  }
  static double crossing(const Vector& moved, const Motion3& motion, double rotated,
                         double max_support_rate, double slack, double slack_rate) {
    return crossing(moved, motion.velocity, slack - rotated,
                    -max_support_rate * motion.angular_velocity.norm() - slack_rate);
  }

  // The first s ≥ 0 with |r + v s| = slack + growth s, for |r| ≤ slack; 0 if already outside.
  static double crossing(const Vector& r, const Vector& v, double slack, double growth) {
    const double c = r.squaredNorm() - slack * slack;
    if (!(slack > 0) || c >= 0) return 0;
    const double a = v.squaredNorm() - growth * growth;
    const double b = r.dot(v) - slack * growth;
    // a s² + 2 b s + c = 0 with c < 0: the first positive root, without cancellation.
    const double discriminant = b * b - a * c;
    if (discriminant < 0) return std::numeric_limits<double>::infinity();
    const double root = std::sqrt(discriminant);
    const double below = b + root;
    const double time = below > 0 ? -c / below : (root - b) / a;
    return time > 0 ? time : std::numeric_limits<double>::infinity();
  }

  double largest_circumradius() const {
    double largest = 0;
    for (const Shape& shape : shapes_) largest = std::max(largest, shape.circumradius());
    return largest;
  }

  // The reach that gives cells with a quarter of a particle on average, or of the size of a particle if larger.
  double cell_reach(std::size_t particles) const {
    const double spacing =
        std::pow(box_.volume() / static_cast<double>(particles), 1.0 / dimension);
    return 2 * std::max(0.5 * largest_, spacing);
  }

  // A gap within which, at the mean density, there are certainly more neighbours than the target.
  double max_gap(double target) const {
    const double density = static_cast<double>(references_.size()) / box_.volume();
    const double of_unit = dimension == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3;
    const double reach = std::pow(2 * target / (of_unit * density), 1.0 / dimension);
    double smallest = largest_;
    for (const Shape& shape : shapes_) smallest = std::min(smallest, shape.inradius());
    return std::clamp(reach - 2 * smallest, smallest, 4 * largest_);
  }

  double choose_gap(std::vector<Pair> pairs, double target) const {
    const auto rank =
        static_cast<std::size_t>(0.5 * target * static_cast<double>(references_.size()));
    if (rank >= pairs.size()) return max_gap(target);
    const auto nth = pairs.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(pairs.begin(), nth, pairs.end(),
                     [](const Pair& one, const Pair& two) { return one.gap < two.gap; });
    // In a jammed packing the gaps vanish; a neighbourhood must still leave room to move.
    const double min_gap = 1e-4 * largest_;
    return std::max(nth->gap, min_gap);
  }

  // Whether cells return so many candidates that an outer layer is worthwhile, and the box is wide enough for it.
  bool needs_outer_layer() const {
    constexpr double many_candidates = 400;
    const double density = static_cast<double>(references_.size()) / box_.volume();
    return density * std::pow(4 * (largest_ + margin_), dimension) > many_candidates &&
           OuterLayer::times * margin_ < 0.25 * box_.lengths().minCoeff();
  }

  // The maximum distance of images closer to particle i than `limit`. Other references are older, with sizes
  // between 1 and that of i.
  double reach_of(const References& references, std::size_t i, double limit) const {
    const double size = references[i].size;
    return size * shape(i).circumradius() + std::max(size, 1.0) * largest_ + limit;
  }

  // Calls visit(pair) for the images of particles `first` and later that are closer to particle i than `limit` at
  // their reference poses; own images once per unordered pair.
  template <class Visit>
  void visit_near(std::size_t i, double limit, std::size_t first, Visit&& visit) const {
    const Reference& mine = references_[i];
    const Shape one = scaled(shape(i), mine.size);
    GapBatch<Shape> batch(one, mine.orientation(), limit);
    Image image[GapBatch<Shape>::lanes];
    int count = 0;
    const auto flush = [&] {
      batch.evaluate();
      for (int k = 0; k < count; ++k)
        if (batch.gap(k) < limit)
          visit(Pair{batch.gap(k), batch.axis(k), static_cast<std::uint32_t>(i), image[k]});
      count = 0;
    };
    const auto add = [&](std::size_t j, const Shift<dimension>& shift, const Vector& d) {
      const Reference& other = references_[j];
      batch.set(count, scaled(shape(j), other.size), other.orientation(), d);
      image[count++] = {j, shift};
      if (count == GapBatch<Shape>::lanes) flush();
    };
    if (outer_)
      for_each_in_outer_layer(i, limit, add);
    else
      for_each_near(references_, i, limit, first, add);
    if (count > 0) flush();
  }

  // Calls visit(j, shift, separation) for the images that circumspheres and capsules do not prove to be `limit`
  // apart from particle i; own images once per unordered pair.
  template <class Visit>
  void for_each_near(const References& references, std::size_t i, double limit, std::size_t first,
                     Visit&& visit) const {
    const Reference& mine = references[i];
    references.for_each_near(mine.position, reach_of(references, i, limit),
                             [&](std::size_t j, const Shift<dimension>& shift, const Vector& d) {
                               if (j >= first && (j != i || is_positive_shift(shift)) &&
                                   !are_far(mine, references[j], d, limit))
                                 visit(j, shift, d);
                             });
  }

  // The same for the candidates of the outer layer, with a limit of two margins.
  template <class Visit>
  void for_each_in_outer_layer(std::size_t i, double limit, Visit&& visit) const {
    const Reference& mine = references_[i];
    for (const Image& image : outer_->of(i)) {
      const Shift<dimension> shift = image.shift();
      const Vector d =
          references_[image.other].position + box_.translation(shift) - references_[i].position;
      if (!are_far(mine, references_[image.other], d, limit)) visit(image.other, shift, d);
    }
  }

  static bool are_far(const Reference& one, const Reference& two, const Vector& d, double limit) {
    if constexpr (has_capsule)
      return farther_apart(one.capsule, two.capsule, d, limit);
    else
      return false;
  }

  std::vector<Pair> pairs_closer_than(double limit) const {
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < references_.size(); ++i)
      visit_near(i, limit, i, [&](const Pair& pair) { pairs.push_back(pair); });
    return pairs;
  }

  // Particle i as a neighbour of its neighbour.
  static Neighbor<B> reversed_image(std::size_t i, const Neighbor<B>& neighbor) {
    return {neighbor.reversed_image(i), reversed(neighbor.warm_start)};
  }
  static Image reversed_image(std::size_t i, const Image& image) { return image.reversed_image(i); }

  // Adds i and the other to each other's lists, or removes i from that of the other; in either layer.
  template <class Entry>
  static void link(ListPool<Entry>& lists, std::size_t i, const Entry& entry) {
    lists.add(i, entry);
    if (i != entry.other) lists.add(entry.other, reversed_image(i, entry));
  }
  template <class Entry>
  static void unlink(ListPool<Entry>& lists, std::size_t i, const Entry& entry) {
    const Image mine = entry.reversed_image(i);
    lists.remove_if(entry.other, [&](const Image& known) { return known == mine; });
  }

  const Shape& shape(std::size_t i) const { return shapes_[type_index_[i]]; }

  PeriodicBox<dimension> box_;
  std::span<const Shape> shapes_;
  const TypeIndex& type_index_;
  ListPool<Neighbor<B>> lists_;
  std::vector<CapsuleOf> capsules_;  // of each type
  std::vector<Pair> candidates_;     // of an update
  std::vector<Neighbor<B>> previous_;
  double largest_;
  References references_;
  double margin_ = 0;
  std::unique_ptr<OuterLayer> outer_;
};

}  // namespace vitrel
