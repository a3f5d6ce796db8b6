#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "core/contact/pair.h"
#include "core/geometry/periodic_box.h"
#include "core/neighbors/cell_grid.h"

namespace vitrel {

/// Neighbour lists shaped like the particles (after Donev, Torquato & Stillinger, 2005).
///
/// Every particle carries a fixed neighbourhood: its own shape at a reference pose, widened all
/// around by `margin`. While it stays inside, only particles whose neighbourhoods meet its own can
/// touch it; when it leaves, its reference pose and list alone are renewed. A body moved by Δr and
/// turned by Δθ is inside its neighbourhood if |Δr| + swing |Δθ| ≤ margin, since its support
/// function has changed by no more than that in any direction. Two neighbourhoods are disjoint if
/// the bodies at their reference poses are 2 margin apart. Cells only find candidates.
///
/// The margin is the one that gives a wanted mean number of neighbours in the configuration at
/// hand. Neighbours are images (j, shift), seen at r_j + shift ∘ L; a particle's own images are
/// among them, each unordered pair (i, i, ±shift) once.
template <Body B>
class Neighborhoods {
 public:
  struct Neighbor {
    std::uint32_t other;
    Shift<2> shift;
  };

  /// `bodies` must outlive this object; `poses` are wrapped into the box.
  Neighborhoods(const PeriodicBox<2>& box, std::span<const B> bodies, std::span<const Pose2> poses,
                double wanted_neighbors)
      : box_(box),
        bodies_(bodies),
        reference_(poses.begin(), poses.end()),
        lists_(bodies.size()),
        largest_(largest_circumradius()),
        cells_(box, 2 * largest_, bodies.size()) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) cells_.insert(i, reference_[i].position);
    const std::vector<Pair> pairs = pairs_closer_than(widest_gap(wanted_neighbors));
    margin_ = 0.5 * choose_gap(pairs, wanted_neighbors);
    for (const Pair& pair : pairs)
      if (pair.gap < 2 * margin_) link(pair.i, pair.j, pair.shift);
  }

  std::span<const Neighbor> of(std::size_t i) const { return lists_[i]; }
  double margin() const { return margin_; }

  /// New reference pose (wrapped into the box) and new list for particle i.
  void renew(std::size_t i, const Pose2& pose) {
    unlink(i);
    reference_[i] = pose;
    cells_.move(i, pose.position);
    visit_pairs_of(i, 2 * margin_, [&](std::size_t j, const Shift<2>& shift, const Vec2& d) {
      if (!separated(bodies_[i], reference_[i], bodies_[j], reference_[j], d, 2 * margin_))
        link(i, j, shift);
    });
  }

  /// The earliest time at which particle i, now at `pose`, can leave its neighbourhood: the smaller
  /// of the roots of |Δr + v s| ± swing (Δθ + ω s) = margin.
  double exit_time(std::size_t i, const Pose2& pose, const Motion2& motion) const {
    const Vec2 moved = pose.position - reference_[i].position;
    const double swing = bodies_[i].swing();
    const double turned = swing * (pose.angle - reference_[i].angle);
    const double turning = swing * motion.angular_velocity;
    return std::min(crossing(moved, motion.velocity, margin_ - turned, -turning),
                    crossing(moved, motion.velocity, margin_ + turned, turning));
  }

 private:
  struct Pair {
    double gap;
    std::uint32_t i, j;
    Shift<2> shift;
  };

  // First s ≥ 0 with |r + v s| = room + growth s, for |r| ≤ room; 0 if outside already.
  static double crossing(const Vec2& r, const Vec2& v, double room, double growth) {
    const double c = r.squaredNorm() - room * room;
    if (!(room > 0) || c >= 0) return 0;
    const double a = v.squaredNorm() - growth * growth;
    const double b = r.dot(v) - room * growth;
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
    for (const B& body : bodies_) largest = std::max(largest, body.circumradius());
    return largest;
  }

  // A gap within which, at the mean density, there are surely more neighbours than wanted.
  double widest_gap(double wanted) const {
    const double density = static_cast<double>(bodies_.size()) / box_.volume();
    const double reach = std::sqrt(2 * wanted / (std::numbers::pi * density));
    double smallest = largest_;
    for (const B& body : bodies_) smallest = std::min(smallest, body.inradius());
    return std::clamp(reach - 2 * smallest, smallest, 4 * largest_);
  }

  static double choose_gap(std::vector<Pair> pairs, double wanted, std::size_t particles,
                           double widest) {
    const auto rank = static_cast<std::size_t>(0.5 * wanted * static_cast<double>(particles));
    if (rank >= pairs.size()) return widest;
    const auto nth = pairs.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(pairs.begin(), nth, pairs.end(),
                     [](const Pair& one, const Pair& two) { return one.gap < two.gap; });
    return nth->gap;
  }

  double choose_gap(const std::vector<Pair>& pairs, double wanted) const {
    const double widest = widest_gap(wanted);
    // In a jammed packing gaps vanish; a neighbourhood must still leave room to move.
    const double narrowest = 1e-4 * largest_;
    return std::max(choose_gap(pairs, wanted, bodies_.size(), widest), narrowest);
  }

  // Candidates (j, shift, d) of particle i by circumcircles, own images once per unordered pair.
  template <class Visit>
  void visit_pairs_of(std::size_t i, double gap, Visit&& visit) const {
    const double reach = bodies_[i].circumradius() + largest_ + gap;
    cells_.for_each_near(reference_[i].position, reach,
                         [&](std::size_t j, const Shift<2>& shift, const Vec2& d) {
                           if (j == i && !comes_after_zero(shift)) return;
                           visit(j, shift, d);
                         });
  }

  static bool comes_after_zero(const Shift<2>& shift) {
    return shift.x() > 0 || (shift.x() == 0 && shift.y() > 0);
  }

  std::vector<Pair> pairs_closer_than(double gap) const {
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      visit_pairs_of(i, gap, [&](std::size_t j, const Shift<2>& shift, const Vec2& d) {
        if (j < i || separated(bodies_[i], reference_[i], bodies_[j], reference_[j], d, gap))
          return;
        const double here =
            support_gap(bodies_[i], reference_[i], bodies_[j], reference_[j], d).gap;
        pairs.push_back(
            {here, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), shift});
      });
    return pairs;
  }

  void link(std::size_t i, std::size_t j, const Shift<2>& shift) {
    lists_[i].push_back({static_cast<std::uint32_t>(j), shift});
    if (i != j) lists_[j].push_back({static_cast<std::uint32_t>(i), -shift});
  }

  void unlink(std::size_t i) {
    for (const Neighbor& neighbor : lists_[i])
      if (neighbor.other != i)
        std::erase_if(lists_[neighbor.other], [i](const Neighbor& n) { return n.other == i; });
    lists_[i].clear();
  }

  PeriodicBox<2> box_;
  std::span<const B> bodies_;
  std::vector<Pose2> reference_;
  std::vector<std::vector<Neighbor>> lists_;
  double largest_;
  CellGrid cells_;
  double margin_ = 0;
};

}  // namespace vitrel
