#include "workflow/picture/image_files.h"

#include <fmt/format.h>
#include <png.h>

#include <cmath>
#include <iterator>
#include <numbers>
#include <stdexcept>

namespace vitrel {
namespace {

std::string hexadecimal(const Colour& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
}

}  // namespace

std::string png_of(const Image& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&png, bytes.data(), &size, 0, image.pixels.data(), 0, nullptr))
    throw std::runtime_error(fmt::format("the picture cannot be compressed: {}", png.message));
  bytes.resize(size);
  return bytes;
}

std::string svg_of(const Scene& scene, int width) {
  const int height = height_of(scene, width);
  const double scale = 0.5 * width / scene.half.x(), line = scale * scene.line_width();
  const Vec2 middle(0.5 * width, 0.5 * height), half = scale * scene.half_box.head<2>();
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"{2}\"/>\n",
      width, height, hexadecimal(background));
  for (const Scene::Body& body : scene.bodies) {
    // The ellipse is drawn along the principal axes of the shape matrix; y points downwards in SVG.
    const double mean = 0.5 * (body.shape(0, 0) + body.shape(1, 1));
    const double gap = 0.5 * (body.shape(0, 0) - body.shape(1, 1)), mixed = body.shape(0, 1);
    const double a = scale * std::sqrt(mean + std::hypot(gap, mixed));
    const double b = scale * std::sqrt(body.shape(2, 2));
    const double rim = scale * scene.rim_width(body);
    fmt::format_to(std::back_inserter(svg),
                   "<ellipse rx=\"{:.6g}\" ry=\"{:.6g}\" transform=\"translate({:.6g} {:.6g}) "
                   "rotate({:.6g})\" fill=\"{}\" stroke=\"{}\" stroke-width=\"{:.4g}\"/>\n",
                   a - 0.5 * rim, b - 0.5 * rim, middle.x() + scale * body.centre.x(),
                   middle.y() - scale * body.centre.y(),
                   -90 / std::numbers::pi * std::atan2(mixed, gap), hexadecimal(body.colour),
                   hexadecimal(rim_of(body.colour)), rim);
  }
  return svg +
         fmt::format(
             "<path fill=\"{0}\" fill-opacity=\"{1}\" fill-rule=\"evenodd\" d=\"M0 "
             "0h{2}v{3}h-{2}zM{4:.6g} {5:.6g}h{6:.6g}v{7:.6g}h-{6:.6g}z\"/>\n<rect x=\"{4:.6g}\" "
             "y=\"{5:.6g}\" width=\"{6:.6g}\" height=\"{7:.6g}\" fill=\"none\" stroke=\"{8}\" "
             "stroke-width=\"{9:.4g}\"/>\n</svg>\n",
             hexadecimal(background), pale_share, width, height, middle.x() - half.x(),
             middle.y() - half.y(), 2 * half.x(), 2 * half.y(), hexadecimal(edge_colour), line);
}

}  // namespace vitrel
