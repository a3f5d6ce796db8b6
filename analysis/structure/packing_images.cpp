#include "analysis/structure/packing_images.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace vitrel {
namespace {

/// One of the 27 ways in which coordinates are free or fixed to a side of the box.
using Sides = Eigen::Vector3i;  // −1, 0 (free) or 1

/// Returns the smallest value with some coordinates fixed if its point lies in the box, and infinity otherwise. `d`
/// runs from the body's centre to that of the box.
double min_value(const Mat3& sigma, const Vec3& d, const Vec3& half, const Sides& sides) {
  // Free coordinates drop out of Σ_CC, because their rows and columns are those of the unit matrix.
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

/// Returns the middles of at most `count` of the widest gaps between points on a circle of this length.
std::vector<double> widest_gaps(std::vector<double> points, double length, std::size_t count) {
  for (double& x : points) x -= std::floor(x / length) * length;
  std::ranges::sort(points);
  std::vector<std::pair<double, double>> gaps;  // width, middle
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double next = k + 1 < points.size() ? points[k + 1] : points[0] + length;
    gaps.emplace_back(next - points[k], 0.5 * (points[k] + next));
  }
  std::ranges::sort(gaps, std::greater());
  std::vector<double> middles;
  for (std::size_t k = 0; k < std::min(count, gaps.size()); ++k) middles.push_back(gaps[k].second);
  return middles;
}

/// Returns |√(d_Cᵀ Σ_CC⁻¹ d_C) − 1|, where C are the coordinates with a finite d.
double distance_from_touch(const Mat3& sigma, const Vec3& d) {
  Mat3 marginal = Mat3::Identity();
  Vec3 to_side = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(d[k])) continue;
    to_side[k] = d[k];
    for (int l = 0; l < 3; ++l)
      if (std::isfinite(d[l])) marginal(k, l) = sigma(k, l);
  }
  return std::abs(std::sqrt(to_side.dot(marginal.ldlt().solve(to_side))) - 1);
}

/// Returns the minimum of distance_from_touch over all planes, edges and corners that are near a body at r.
double distance_from_lattice(const Mat3& sigma, const Vec3& r, const Vec3& lengths) {
  constexpr double unfixed = std::numeric_limits<double>::infinity();
  std::vector<double> offsets[3];
  for (int k = 0; k < 3; ++k) {
    offsets[k] = {unfixed};
    const double near = 2 * std::sqrt(sigma(k, k));
    const double first = std::ceil((r[k] - near) / lengths[k] - 0.5);
    for (double n = first; (n + 0.5) * lengths[k] <= r[k] + near; ++n)
      offsets[k].push_back((n + 0.5) * lengths[k] - r[k]);
  }
  double least = 1;
  for (const double x : offsets[0])
    for (const double y : offsets[1])
      for (const double z : offsets[2])
        if (std::min({x, y, z}) < unfixed)
          least = std::min(least, distance_from_touch(sigma, {x, y, z}));
  return least;
}

}  // namespace

bool meets_box(const ParticleShape<3>& body, const Pose3& pose, const PeriodicBox<3>& box) {
  const Vec3 half = 0.5 * box.lengths();
  const Vec3 d = -pose.position;
  const Mat3 sigma = shape_matrix(body, pose.orientation);
  for (int choice = 0; choice < 27; ++choice) {
    const Sides sides(choice % 3 - 1, choice / 3 % 3 - 1, choice / 9 - 1);
    if (min_value(sigma, d, half, sides) <= 1) return true;
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

double grazing_distance(const Configuration3& packing, const Vec3& translation) {
  double least = 1;
  for (std::size_t i = 0; i < packing.size(); ++i)
    least = std::min(
        least, distance_from_lattice(shape_matrix(packing.shape[i], packing.orientation[i]),
                                     packing.position[i] - translation, packing.box.lengths()));
  return least;
}

Vec3 clean_cut(const Configuration3& packing) {
  constexpr std::size_t max_gaps = 6;
  const Vec3& lengths = packing.box.lengths();
  std::vector<double> choices[3];
  for (int k = 0; k < 3; ++k) {
    std::vector<double> touching;
    for (std::size_t i = 0; i < packing.size(); ++i) {
      const double reach = half_extents(packing.shape[i], packing.orientation[i])[k];
      touching.insert(touching.end(),
                      {packing.position[i][k] - reach, packing.position[i][k] + reach});
    }
    choices[k] = widest_gaps(std::move(touching), lengths[k], max_gaps);
  }
  Vec3 best = Vec3::Zero();
  double farthest = -1;
  for (const double x : choices[0])
    for (const double y : choices[1])
      for (const double z : choices[2]) {
        const Vec3 translation = Vec3(x, y, z) - 0.5 * lengths;
        const double distance = grazing_distance(packing, translation);
        if (distance > farthest) farthest = distance, best = translation;
      }
  return best;
}

}  // namespace vitrel
