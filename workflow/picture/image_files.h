#pragma once

#include <string>

#include "workflow/picture/ray_caster.h"

namespace vitrel {

/// The content of a PNG file.
std::string png_of(const Image& image);

/// The content of an SVG file of a scene in the plane, which looks like the image that cast_rays makes. Throws
/// UserError as height_of does.
std::string svg_of(const Scene& scene, int width);

}  // namespace vitrel
