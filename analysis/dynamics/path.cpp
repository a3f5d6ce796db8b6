#include "analysis/dynamics/path.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "core/state/figure_axis.h"

namespace vitrel {

namespace {

Quaternion orientation_at(const Track<3>& track, std::size_t k) {
  const auto& q = track.orientation;
  return {q[0][k], q[1][k], q[2][k], q[3][k]};
}

/// Returns axes in the frame of the body: the figure axis, or all three from the longest to the shortest.
std::vector<Vec3> body_axes(const ParticleShape<3>& shape, std::size_t count) {
  if (count == 1) return {figure_axis(shape, Quaternion::Identity())};
  std::array<int, 3> order{};
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater<>{}, [&](int k) { return shape.half_lengths()[k]; });
  std::vector<Vec3> axes;
  for (const int k : order) axes.push_back(Vec3::Unit(k));
  return axes;
}

/// Returns angles unwrapped by the shortest turns from frame to frame. The largest turn is noted as if the period were
/// 2π.
FrameSeries unwrapped(FrameSeries angle, double period, double& largest_turn) {
  for (std::size_t k = 1; k < angle.size(); ++k) {
    const double turn = std::remainder(angle[k] - angle[k - 1], period);
    largest_turn = std::max(largest_turn, std::abs(turn) * (2 * std::numbers::pi / period));
    angle[k] = angle[k - 1] + turn;
  }
  return angle;
}

void follow(Path<2>& path, const Track<2>& track, const ParticleShape<2>&, std::size_t) {
  const FrameSeries& angle = track.orientation[0];
  const double period = track.turn_period;
  path.turn[0] = period == 0 ? angle : unwrapped(angle, period, path.largest_turn);
  DirectionSeries<2>& axis = path.directions.emplace_back();
  for (const double theta : angle) {
    axis[0].push_back(std::cos(theta));
    axis[1].push_back(std::sin(theta));
  }
}

void follow(Path<3>& path, const Track<3>& track, const ParticleShape<3>& shape, std::size_t axes) {
  const std::vector<Vec3> in_body = body_axes(shape, axes);
  path.directions.resize(in_body.size());
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < track.orientation[0].size(); ++k) {
    const Quaternion orientation = orientation_at(track, k);
    if (k > 0) {
      const Vec3 turn = rotation_vector(orientation * orientation_at(track, k - 1).conjugate());
      path.largest_turn = std::max(path.largest_turn, turn.norm());
      sum += turn;
    }
    for (std::size_t d = 0; d < 3; ++d) path.turn[d].push_back(sum[static_cast<int>(d)]);
    for (std::size_t a = 0; a < in_body.size(); ++a) {
      const Vec3 axis = orientation * in_body[a];
      for (std::size_t d = 0; d < 3; ++d)
        path.directions[a][d].push_back(axis[static_cast<int>(d)]);
    }
  }
}

}  // namespace

Vec3 rotation_vector(Quaternion turn) {
  if (turn.w() < 0) turn.coeffs() *= -1;
  const double sine = turn.vec().norm();
  if (sine == 0) return Vec3::Zero();
  return 2 * std::atan2(sine, turn.w()) / sine * turn.vec();
}

template <>
std::size_t axis_count(const Configuration2&) {
  return 1;
}

template <>
std::size_t axis_count(const Configuration3& configuration) {
  const bool has_spheroids = std::ranges::any_of(
      configuration.shape,
      [](const ParticleShape<3>& shape) { return !shape.is_round() && !shape.is_scalene(); });
  return !has_spheroids && std::ranges::any_of(configuration.shape, &ParticleShape<3>::is_scalene)
             ? 3
             : 1;
}

template <int Dim>
Path<Dim>::Path(Track<Dim> track, const ParticleShape<Dim>& shape, std::size_t axes,
                std::size_t its_stride)
    : stride(its_stride), column((track.position[0].size() + stride - 1) / stride) {
  if (!shape.is_round()) follow(*this, track, shape, axes);
  position = std::move(track.position);
  if (stride == 1) return;
  const auto regroup = [this](FrameSeries& series) {
    FrameSeries grouped(column * stride);
    for (std::size_t k = 0; k < series.size(); ++k) grouped[place(k)] = series[k];
    series = std::move(grouped);
  };
  std::ranges::for_each(position, regroup);
  if (!is_rotor()) return;
  std::ranges::for_each(turn, regroup);
  for (DirectionSeries<Dim>& axis : directions) std::ranges::for_each(axis, regroup);
}

template struct Path<2>;
template struct Path<3>;

}  // namespace vitrel
