#include "analysis/packing_images.h"

#include <cmath>
#include <limits>

namespace vitrel {
namespace {

/// One of the 27 ways in which coordinates are free or fixed to a side of the box.
using Sides = Eigen::Vector3i;  // −1, 0 (free) or 1

/// The least value with some coordinates fixed, if its point lies in the box, else infinity. `d` runs from
/// the body's centre to that of the box.
double least_value(const Mat3& sigma, const Vec3& d, const Vec3& half, const Sides& sides) {
  // Free coordinates drop out of Σ_CC, here by rows and columns of the unit matrix.
  Mat3 marginal = Mat3::Identity();
  Vec3 to_side = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    if (sides[k] == 0) continue;
    to_side[k] = d[k] + sides[k] * half[k];
    for (int l = 0; l < 3; ++l)
      if (sides[l] != 0) marginal(k, l) = sigma(k, l);
  }
  const Vec3 weights = marginal.ldlt().solve(to_side);
  const Vec3 point = sigma * weights;
  for (int k = 0; k < 3; ++k)
    if (sides[k] == 0 && std::abs(point[k] - d[k]) > half[k])
      return std::numeric_limits<double>::infinity();
  return to_side.dot(weights);
}

}  // namespace

Vec3 half_extents(const Ellipsoid& body, const Quaternion& orientation) {
  return (orientation.toRotationMatrix() * body.semi_axes.asDiagonal()).rowwise().norm();
}

bool meets_box(const Ellipsoid& body, const Pose3& pose, const PeriodicBox<3>& box) {
  const Vec3 half = 0.5 * box.lengths();
  const Vec3 d = -pose.position;
  const Mat3 sigma = shape_matrix(body, pose.orientation);
  for (int choice = 0; choice < 27; ++choice) {
    const Sides sides(choice % 3 - 1, choice / 3 % 3 - 1, choice / 9 - 1);
    if (least_value(sigma, d, half, sides) <= 1) return true;
  }
  return false;
}

std::vector<BodyInBox> bodies_in_box(const Configuration3& packing) {
  std::vector<BodyInBox> bodies;
  const Vec3& lengths = packing.box.lengths();
  for (std::size_t i = 0; i < packing.size(); ++i) {
    const Vec3& r = packing.position[i];
    const Vec3 reach = 0.5 * lengths + half_extents(packing.shape[i], packing.orientation[i]);
    const Vec3 low = (-(reach + r)).cwiseQuotient(lengths).array().ceil();
    const Vec3 high = (reach - r).cwiseQuotient(lengths).array().floor();
    const Vec3 inside = lengths - reach;
    for (double x = low.x(); x <= high.x(); ++x)
      for (double y = low.y(); y <= high.y(); ++y)
        for (double z = low.z(); z <= high.z(); ++z) {
          const Vec3 centre = r + Vec3(x, y, z).cwiseProduct(lengths);
          const bool is_cut = (centre.array().abs() > inside.array()).any();
          if (!is_cut || meets_box(packing.shape[i], {centre, packing.orientation[i]}, packing.box))
            bodies.push_back({i, Vec3(x, y, z).cast<std::int32_t>(), is_cut});
        }
  }
  return bodies;
}

}  // namespace vitrel
