#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "workflow/picture/scene.h"

namespace vitrel {

/// Rows from the top, of three bytes per pixel: red, green, blue.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;

  std::uint8_t* pixel(int row, int column) {
    return &pixels[3 * (static_cast<std::size_t>(width) * static_cast<std::size_t>(row) +
                        static_cast<std::size_t>(column))];
  }
};

/// The height of a picture of this width that shows all of the scene. UserError above 10⁸ pixels.
int height_of(const Scene& scene, int width);

/// Casts parallel rays along z of the view. A ray at (x, y) from the centre of a body with P = Σ⁻¹ is in it between the
/// roots of
///
///     P_zz z² + 2 (P_zx x + P_zy y) z + P_xx x² + 2 P_xy x y + P_yy y² − 1 = 0,
///
/// and the nearest root of all bodies is seen, in the part of the ray that is in the box if bodies are cut there. Only
/// rays that meet a body are tried: in the row y those with |x − y Σ_xy/Σ_yy| ≤ √((Σ_xx − Σ_xy²/Σ_yy)(1 − y²/Σ_yy)).
/// Each pixel is the mean of 4 × 4 rays.
///
/// In space bodies have diffuse and ambient light, a highlight, and flat cuts; edges of the box are hidden where they
/// are behind. In the plane bodies have their colour and a darker rim, and what is outside of the box is pale.
///
/// Bands of rows are drawn on all cores; the image does not depend on their number.
Image cast_rays(const Scene& scene, int width, int height);

}  // namespace vitrel
