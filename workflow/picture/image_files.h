#pragma once

#include <string>

#include "workflow/picture/ray_caster.h"

namespace vitrel {

/// The content of a PNG file.
std::string png_of(const Image& image);

/// The content of an SVG file of a scene in the plane, which looks as its rays do. UserError as of height_of.
std::string svg_of(const Scene& scene, int width);

}  // namespace vitrel
