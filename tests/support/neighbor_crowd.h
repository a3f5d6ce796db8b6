#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "core/contact/ellipse_gap.h"
#include "core/contact/ellipsoid_gap.h"
#include "core/neighbors/neighborhood.h"
#include "core/random/stream.h"
#include "tests/support/solids.h"

/// This header has neighbour lists of particles at any places, and checks what they must hold.
namespace vitrel {

inline Pose2 random_pose(Stream& draw, const Vec2& lengths) {
  const Vec2 place{draw.uniform(-0.5, 0.5), draw.uniform(-0.5, 0.5)};
  return {place.cwiseProduct(lengths), draw.uniform(-9, 9)};
}
inline Pose3 random_pose(Stream& draw, const Vec3& lengths) {
  const Vec3 place{draw.uniform(-0.5, 0.5), draw.uniform(-0.5, 0.5), draw.uniform(-0.5, 0.5)};
  return {place.cwiseProduct(lengths), random_orientation(draw)};
}

inline double distance(const Disk& one, double, const Disk& two, double, const Vec2& d) {
  return d.norm() - one.radius - two.radius;
}
inline double distance(const Ellipse& one, double angle1, const Ellipse& two, double angle2,
                       const Vec2& d) {
  if (d.isZero()) return -one.b - two.b;
  return support_gap(one, angle1, two, angle2, d).gap;
}

template <class Shape>
bool closer_than(double gap, const Shape& one, const Pose2& pose1, const Shape& two,
                 const Pose2& pose2, const Vec2& d) {
  return distance(one, pose1.angle, two, pose2.angle, d) < gap;
}
inline bool closer_than(double gap, const Ellipsoid& one, const Pose3& pose1, const Ellipsoid& two,
                        const Pose3& pose2, const Vec3& d) {
  return !separated(one, pose1.orientation, two, pose2.orientation, d, gap);
}

/// Particle i sees particle j at this shift.
template <int Dim>
struct SeenImage {
  std::size_t i, j;
  std::array<int, Dim> shift;

  SeenImage(std::size_t from, std::size_t to, const Shift<Dim>& by) : i(from), j(to) {
    for (int k = 0; k < Dim; ++k) shift[k] = by[k];
  }
  auto operator<=>(const SeenImage&) const = default;
  SeenImage from_there() const {
    SeenImage other(j, i, Shift<Dim>::Zero());
    for (int k = 0; k < Dim; ++k) other.shift[k] = -shift[k];
    return other;
  }
};

/// The particles may overlap: the lists do not ask. Particle i is of kind i modulo their number.
template <class B>
struct Crowd {
  static constexpr int dimension = B::dimension;
  using Shape = BaseShape<B>;
  using Images = std::multiset<SeenImage<dimension>>;

  PeriodicBox<dimension> box;
  std::vector<Shape> kinds;
  TypeIndex type_index;
  std::vector<Pose<dimension>> poses;  // at the last renewal
  std::vector<double> sizes;           // as well
  Neighborhoods<B> lists;

  Crowd(Stream& draw, const Vec<dimension>& lengths, std::size_t particles, double wanted,
        const std::vector<Shape>& of_kinds)
      : box(lengths),
        kinds(of_kinds),
        type_index(kind_numbers(particles, kinds.size()), kinds.size()),
        poses(drawn_poses(draw, lengths, particles)),
        sizes(particles, 1),
        lists(box, kinds, type_index, poses, wanted) {}
  Crowd(const Crowd&) = delete;

  static std::vector<std::uint32_t> kind_numbers(std::size_t particles, std::size_t count) {
    std::vector<std::uint32_t> numbers;
    for (std::size_t i = 0; i < particles; ++i)
      numbers.push_back(static_cast<std::uint32_t>(i % count));
    return numbers;
  }
  static std::vector<Pose<dimension>> drawn_poses(Stream& draw, const Vec<dimension>& lengths,
                                                  std::size_t particles) {
    std::vector<Pose<dimension>> drawn;
    for (std::size_t i = 0; i < particles; ++i) drawn.push_back(random_pose(draw, lengths));
    return drawn;
  }

  const Shape& shape(std::size_t i) const { return kinds[type_index[i]]; }
  void update(std::size_t i, const Pose<dimension>& pose, double size) {
    poses[i] = pose;
    sizes[i] = size;
    lists.update(i, pose, size);
  }

  void renew(std::size_t i, Pose<dimension> pose, double size) {
    Shift<dimension> image = Shift<dimension>::Zero();
    box.wrap(pose.position, image);
    update(i, pose, size);
  }

  Images listed() {
    Images images;
    for (std::size_t i = 0; i < poses.size(); ++i)
      for (const Neighbor<B>& neighbor : lists.of(i))
        images.insert({i, neighbor.other, neighbor.shift()});
    return images;
  }

  /// Returns the images that are closer than `gap`, seen from either side.
  Images images_closer_than(double gap) const {
    Images images;
    for (std::size_t i = 0; i < poses.size(); ++i)
      for (std::size_t j = 0; j < poses.size(); ++j) {
        const auto one = scaled(shape(i), sizes[i]), two = scaled(shape(j), sizes[j]);
        box.for_each_image(poses[j].position - poses[i].position,
                           one.circumradius() + two.circumradius() + gap,
                           [&](const Shift<dimension>& shift, const Vec<dimension>& d) {
                             if (i == j && shift.isZero()) return;
                             if (closer_than(gap, one, poses[i], two, poses[j], d))
                               images.insert({i, j, shift});
                           });
      }
    return images;
  }

  /// Checks that the lists are complete, symmetric and no longer than need be. Complete: they have
  /// all images whose neighbourhoods meet, by a brute force that shares no code with the cells. No
  /// longer than need be: they have none twice, own images once of ±shift, and few (a share of all)
  /// that are farther away than half as far again.
  void expect_lists_right(double share_far) {
    const double reach = 2 * lists.margin();
    const Images found = listed();
    for (const auto& image : found) {
      ASSERT_EQ(found.count(image), 1u);
      ASSERT_EQ(found.count(image.from_there()), image.i == image.j ? 0u : 1u);
    }
    for (const auto& image : images_closer_than(reach * (1 - 1e-12)))
      ASSERT_TRUE(found.count(image) == 1 ||
                  (image.i == image.j && found.count(image.from_there()) == 1))
          << image.i << " lacks " << image.j;
    const Images near = images_closer_than(1.5 * reach);
    const auto far =
        std::ranges::count_if(found, [&](const auto& image) { return !near.contains(image); });
    ASSERT_LE(static_cast<double>(far), share_far * static_cast<double>(found.size()));
  }
};

}  // namespace vitrel
