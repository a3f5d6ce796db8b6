#include "workflow/picture/scene.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/state/in_space.h"

namespace vitrel {
namespace {

constexpr double space_margin = 0.02;  // margin around the box, over half its size

/// `turn` turns the axes of the body into those of the view.
Scene::Body seen_body(const Vec3& centre, const Vec3& half_lengths, const Mat3& turn,
                      const Colour& colour) {
  const Vec3 squares = half_lengths.cwiseAbs2();
  return {centre, turn * squares.asDiagonal() * turn.transpose(),
          turn * squares.cwiseInverse().asDiagonal() * turn.transpose(), colour};
}

template <int Dim>
Scene::Body seen_particle(const Configuration<Dim>& configuration, std::size_t i,
                          const Vec<Dim>& centre, const Mat3& turn, const Colour& colour) {
  return seen_body(turn * in_space(centre), half_lengths_in_space(configuration.shape[i]),
                   turn * rotation_matrix(orientation_in_space(configuration, i)), colour);
}

/// Calls visit(i, centre) for all images of particles whose bounding boxes meet a box of these sides around 0.
template <int Dim, class Visit>
void for_each_image_in(const Configuration<Dim>& configuration, const Vec<Dim>& sides,
                       Visit&& visit) {
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const auto [position, orientation] = configuration.pose(i);
    const Vec<Dim> reach = shape_matrix(configuration.shape[i], orientation).diagonal().cwiseSqrt();
    configuration.box.for_each_image(
        position, norm(Vec<Dim>(0.5 * sides + reach)),
        [&](const Shift<Dim>&, const Vec<Dim>& centre) {
          if ((centre.cwiseAbs() - reach - 0.5 * sides).maxCoeff() <= 0) visit(i, centre);
        });
  }
}

/// The rows of the matrix are the directions to the right, upwards, and towards the eye.
Mat3 turn_of(const View& view) {
  constexpr double degree = std::numbers::pi / 180;
  const Vec2 azimuth = direction(view.azimuth * degree),
             elevation = direction(view.elevation * degree);
  const Vec3 right(-azimuth.y(), azimuth.x(), 0);
  const Vec3 toward(elevation.x() * azimuth.x(), elevation.x() * azimuth.y(), elevation.y());
  Mat3 turn;
  turn << right.transpose(), cross(toward, right).transpose(), toward.transpose();
  return turn;
}

}  // namespace

Colour rim_of(const Colour& colour) {
  constexpr double share = 0.6;
  constexpr Colour ink = {20, 25, 30};
  Colour rim;
  for (std::size_t c = 0; c < rim.size(); ++c)
    rim[c] = static_cast<std::uint8_t>(std::lround((1 - share) * colour[c] + share * ink[c]));
  return rim;
}

double Scene::rim_width(const Body& body) const {
  return std::min(line_width(), 0.25 * std::sqrt(body.shape(2, 2)));
}

Scene scene_of(const Configuration2& configuration, const std::vector<Colour>& colours) {
  Scene scene;
  const Vec2& box = configuration.box.lengths();
  scene.half_box = in_space(Vec2(0.5 * box));
  scene.half = (0.5 + plane_margin) * box;
  for_each_image_in(configuration, Vec2(2 * scene.half), [&](std::size_t i, const Vec2& centre) {
    scene.bodies.push_back(seen_particle(configuration, i, centre, scene.turn, colours[i]));
  });
  return scene;
}

Scene scene_of(const Configuration3& configuration, const std::vector<Colour>& colours,
               const View& view) {
  Scene scene;
  scene.in_space = true;
  scene.is_cut = !view.whole;
  scene.turn = turn_of(view);
  scene.half_box = 0.5 * configuration.box.lengths();
  const Vec3 corner = scene.turn.cwiseAbs() * scene.half_box;
  const double room = view.whole ? largest_circumradius(configuration) : 0;
  scene.half = corner.head<2>().array() + room + space_margin * corner.head<2>().maxCoeff();
  const auto add = [&](std::size_t i, const Vec3& centre) {
    scene.bodies.push_back(seen_particle(configuration, i, centre, scene.turn, colours[i]));
  };
  if (view.whole)
    for (std::size_t i = 0; i < configuration.size(); ++i) add(i, configuration.position[i]);
  else
    for_each_image_in(configuration, configuration.box.lengths(), add);
  std::ranges::stable_sort(scene.bodies, std::ranges::greater(), &Scene::Body::front);
  return scene;
}

}  // namespace vitrel
