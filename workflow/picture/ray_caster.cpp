#include "workflow/picture/ray_caster.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/parallel.h"

namespace vitrel {
namespace {

constexpr int rays_per_pixel = 4;  // in each direction
constexpr int band_height = 16;    // in pixels
constexpr double most_pixels = 1e8;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double parallel = 1e-9;  // a face with less rise along a ray never meets it

using Light = Eigen::Array3d;  // in sRGB, from 0 to 255

Light light(const Colour& colour) {
  return {static_cast<double>(colour[0]), static_cast<double>(colour[1]),
          static_cast<double>(colour[2])};
}

const Light paper = light(background), ink = light(edge_colour);

/// The share of light that a face receives from a lamp above the left shoulder.
double facing(const Vec3& normal) {
  static const Vec3 lamp = normalized(Vec3(-0.35, 0.45, 0.82));
  return std::clamp(dot(normal, lamp), 0.0, 1.0);
}

Light shaded(const Light& colour, const Vec3& normal) {
  const double diffuse = facing(normal);
  const double square = diffuse * diffuse, eighth = square * square * square * square;
  const double highlight = 0.18 * 255 * eighth * eighth * eighth;
  return ((0.38 + 0.62 * diffuse) * colour + highlight).min(255);
}

Light shaded_cut(const Light& colour, const Vec3& normal, bool is_rim) {
  return (0.88 * colour + 0.12 * 255) * (0.62 + 0.3 * facing(normal)) * (is_rim ? 0.6 : 1);
}

/// The positions of the rays in the units of the scene.
struct Raster {
  int width, height;  // in rays
  double step;

  Raster(const Scene& scene, int pixels_across, int pixels_down)
      : width(rays_per_pixel * pixels_across),
        height(rays_per_pixel * pixels_down),
        step(2 * std::max(scene.half.x() / width, scene.half.y() / height)) {}
  double x(int column) const { return (column + 0.5 - 0.5 * width) * step; }
  double y(int row) const { return (0.5 * height - row - 0.5) * step; }
  /// The first column at or beyond x, and the first row at or below y.
  int column(double x) const { return limited(x / step + 0.5 * width - 0.5, width); }
  int row(double y) const { return limited(0.5 * height - 0.5 - y / step, height); }

 private:
  static int limited(double place, int end) {
    return static_cast<int>(std::clamp(std::ceil(place), 0.0, static_cast<double>(end)));
  }
};

struct Edge {
  Vec3 start, end;
};

std::vector<Edge> edges_of(const Scene& scene) {
  std::vector<Edge> edges;
  for (int axis = 0; axis < 3; ++axis)
    for (const double one : {-1, 1})
      for (const double other : {-1, 1}) {
        Vec3 end = scene.half_box;
        end[(axis + 1) % 3] *= one;
        end[(axis + 2) % 3] *= other;
        Vec3 start = end;
        start[axis] *= -1;
        edges.push_back({scene.turn * start, scene.turn * end});
      }
  return edges;
}

/// Draws some rows of rays.
class Band {
 public:
  Band(const Scene& scene, const Raster& raster, int first_row, int end_row)
      : scene_(scene),
        raster_(raster),
        first_row_(first_row),
        end_row_(end_row),
        rays_(static_cast<std::size_t>(raster.width) *
              static_cast<std::size_t>(end_row - first_row)) {
    if (scene.is_cut) for_each_ray([&](int row, int column) { cut(row, column); });
  }

  void draw(const Scene::Body& body) {
    const double height = body.shape(1, 1), lean = body.shape(0, 1) / height;
    const double width = std::max(body.shape(0, 0) - lean * body.shape(0, 1), 0.0);
    const double front = body.front();
    for_rows(body.centre.y(), std::sqrt(height), [&](int row) {
      const double y = raster_.y(row) - body.centre.y();
      const double reach = std::sqrt(width * std::max(1 - y * y / height, 0.0));
      for_columns(body.centre.x() + lean * y, reach, [&](int column) {
        Ray& ray = this->ray(row, column);
        if (ray.depth >= front) return;
        const Vec2 place(raster_.x(column) - body.centre.x(), y);
        scene_.in_space ? draw_solid(body, place, ray) : draw_flat(body, place, ray);
      });
    });
  }

  /// Draws a line as if it were nearer by its width, so that faces in the same place do not hide it.
  void draw(const Edge& edge) {
    const double reach = 0.5 * scene_.line_width();
    const Vec3 middle = 0.5 * (edge.start + edge.end), half = 0.5 * (edge.end - edge.start);
    const double length = norm(half.head<2>()), high = std::abs(half.y());
    for_rows(middle.y(), high + reach, [&](int row) {
      const double y = raster_.y(row) - middle.y();
      // A line along the row may cover all of it. Any other line covers what an infinite line would.
      const bool flat = high <= reach;
      const double at = flat ? 0 : y * half.x() / half.y();
      const double wide = flat ? std::abs(half.x()) + reach : reach * length / high;
      for_columns(middle.x() + at, wide, [&](int column) {
        const Vec2 place(raster_.x(column) - middle.x(), y);
        const double share =
            length > 0 ? std::clamp(dot(place, half.head<2>()) / (length * length), -1.0, 1.0) : 1;
        if (norm(Vec2(place - share * half.head<2>())) > reach) return;
        const double depth = middle.z() + share * half.z() + 2 * reach;
        Ray& ray = this->ray(row, column);
        if (depth > ray.depth) ray.depth = depth, ray.seen = ink;
      });
    });
  }

  /// In the plane, makes everything outside the box pale, and draws the edges of the box.
  void frame() {
    const double reach = 0.5 * scene_.line_width();
    for_each_ray([&](int row, int column) {
      const Vec2 place(raster_.x(column), raster_.y(row));
      const double outside = (place.cwiseAbs() - scene_.half_box.head<2>()).maxCoeff();
      Light& seen = ray(row, column).seen;
      if (outside > 0) seen = (1 - pale_share) * seen + pale_share * paper;
      if (std::abs(outside) <= reach) seen = ink;
    });
  }

  void write(Image& image) {
    for (int row = first_row_; row < end_row_; row += rays_per_pixel)
      for (int column = 0; column < raster_.width; column += rays_per_pixel) {
        Light sum = Light::Zero();
        for (int k = 0; k < rays_per_pixel; ++k)
          for (int l = 0; l < rays_per_pixel; ++l) sum += ray(row + k, column + l).seen;
        std::uint8_t* pixel = image.pixel(row / rays_per_pixel, column / rays_per_pixel);
        for (int c = 0; c < 3; ++c)
          pixel[c] =
              static_cast<std::uint8_t>(std::lround(sum[c] / (rays_per_pixel * rays_per_pixel)));
      }
  }

 private:
  struct Ray {
    double depth = -infinity;                   ///< of the visible point; larger is nearer
    double front = infinity, back = -infinity;  ///< the ray is in the box between these
    Light seen = paper;
    int face = 0;  ///< axis of the face of the box where the ray enters
  };

  Ray& ray(int row, int column) {
    return rays_[static_cast<std::size_t>(row - first_row_) *
                     static_cast<std::size_t>(raster_.width) +
                 static_cast<std::size_t>(column)];
  }

  void for_each_ray(auto&& visit) {
    for (int row = first_row_; row < end_row_; ++row)
      for (int column = 0; column < raster_.width; ++column) visit(row, column);
  }
  void for_rows(double middle, double reach, auto&& visit) {
    const int end = std::min(raster_.row(middle - reach), end_row_);
    for (int row = std::max(raster_.row(middle + reach), first_row_); row < end; ++row) visit(row);
  }
  void for_columns(double middle, double reach, auto&& visit) {
    const int end = raster_.column(middle + reach);
    for (int column = raster_.column(middle - reach); column < end; ++column) visit(column);
  }

  /// Finds the part of the ray that lies in the box.
  void cut(int row, int column) {
    Ray& ray = this->ray(row, column);
    const Vec3 origin = scene_.turn.transpose() * Vec3(raster_.x(column), raster_.y(row), 0);
    for (int axis = 0; axis < 3; ++axis) {
      const double rise = scene_.turn(2, axis), half = scene_.half_box[axis];
      if (std::abs(rise) < parallel) {
        if (std::abs(origin[axis]) > half) ray.front = -infinity;
        continue;
      }
      const double middle = -origin[axis] / rise, reach = half / std::abs(rise);
      if (middle + reach < ray.front) ray.front = middle + reach, ray.face = axis;
      ray.back = std::max(ray.back, middle - reach);
    }
  }

  /// Whether the outline, of the body or of its cut by a face, is nearer than `width` to first order. The point x in
  /// the body has q = xᵀ P x and the gradient P x.
  bool is_rim(double q, const Vec3& gradient, double width) const {
    const double rho = std::sqrt(q);
    return (1 - rho) * rho < width * norm(gradient);
  }

  void draw_solid(const Scene::Body& body, const Vec2& place, Ray& ray) const {
    const Mat3& p = body.inverse;
    const double linear = p(2, 0) * place.x() + p(2, 1) * place.y();
    const double rest = p(0, 0) * place.x() * place.x() + 2 * p(0, 1) * place.x() * place.y() +
                        p(1, 1) * place.y() * place.y() - 1;
    const double root = std::sqrt(std::max(linear * linear - p(2, 2) * rest, 0.0));
    const double front = body.centre.z() + (root - linear) / p(2, 2);
    const double back = body.centre.z() - (root + linear) / p(2, 2);
    const double depth = std::min(front, ray.front);
    if (depth <= ray.depth || depth < std::max(back, ray.back)) return;
    const Vec3 x(place.x(), place.y(), depth - body.centre.z());
    const Vec3 gradient = p * x;
    const Light colour = light(body.colour);
    ray.depth = depth;
    if (depth == front) {
      ray.seen = shaded(colour, normalized(gradient));
    } else {
      const Vec3 normal = std::copysign(1, scene_.turn(2, ray.face)) * scene_.turn.col(ray.face);
      const Vec3 in_face = gradient - dot(gradient, normal) * normal;
      ray.seen = shaded_cut(colour, normal, is_rim(dot(x, gradient), in_face, scene_.line_width()));
    }
  }

  void draw_flat(const Scene::Body& body, const Vec2& place, Ray& ray) const {
    const Vec3 x(place.x(), place.y(), 0), gradient = body.inverse * x;
    const bool rim = is_rim(dot(x, gradient), gradient, scene_.rim_width(body));
    ray.seen = light(rim ? rim_of(body.colour) : body.colour);
  }

  const Scene& scene_;
  const Raster& raster_;
  int first_row_, end_row_;
  std::vector<Ray> rays_;
};

/// For each band, the bodies that reach into it, in ascending order.
std::vector<std::vector<std::uint32_t>> bodies_by_band(const Scene& scene, const Raster& raster,
                                                       std::size_t bands) {
  constexpr int rows = band_height * rays_per_pixel;
  std::vector<std::vector<std::uint32_t>> result(bands);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Scene::Body& body = scene.bodies[i];
    const double reach = std::sqrt(body.shape(1, 1));
    const int end = raster.row(body.centre.y() - reach);
    for (int row = raster.row(body.centre.y() + reach) / rows; row * rows < end; ++row)
      result[static_cast<std::size_t>(row)].push_back(static_cast<std::uint32_t>(i));
  }
  return result;
}

}  // namespace

int height_of(const Scene& scene, int width) {
  const double height = std::max(1.0, std::round(width * scene.half.y() / scene.half.x()));
  if (height * width > most_pixels)
    throw UserError(fmt::format(
        "a picture {} pixels wide would be {:.0f} high; at most {:.0f} pixels in all are possible",
        width, height, most_pixels));
  return static_cast<int>(height);
}

Image cast_rays(const Scene& scene, int width, int height) {
  Image image{width, height, {}};
  image.pixels.resize(3UL * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const Raster raster(scene, width, height);
  const auto bands = static_cast<std::size_t>((height + band_height - 1) / band_height);
  const std::vector<Edge> edges = scene.in_space ? edges_of(scene) : std::vector<Edge>{};
  const auto bodies = bodies_by_band(scene, raster, bands);
  each_in_parallel(bands, all_cores, [&](std::size_t k) {
    const int first_row = static_cast<int>(k) * band_height * rays_per_pixel;
    Band band(scene, raster, first_row,
              std::min(first_row + band_height * rays_per_pixel, raster.height));
    for (const std::uint32_t i : bodies[k]) band.draw(scene.bodies[i]);
    for (const Edge& edge : edges) band.draw(edge);
    if (!scene.in_space) band.frame();
    band.write(image);
  });
  return image;
}

}  // namespace vitrel
