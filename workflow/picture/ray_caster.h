#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "workflow/picture/scene.h"

namespace vitrel {

/// Rows from the top, with three bytes per pixel: red, green and blue.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;

  std::uint8_t* pixel(int row, int column) {
    return &pixels[3 * (static_cast<std::size_t>(width) * static_cast<std::size_t>(row) +
                        static_cast<std::size_t>(column))];
  }
};

/// The height of a picture of this width that shows the whole scene. Throws UserError if it has more than 10⁸ pixels.
int height_of(const Scene& scene, int width);

/// Casts parallel rays along z of the view. A ray at (x, y) from the centre of a body with P = Σ⁻¹ lies in the body
/// between the roots of
///
///     P_zz z² + 2 (P_zx x + P_zy y) z + P_xx x² + 2 P_xy x y + P_yy y² − 1 = 0,
///
/// The nearest root of all bodies is visible; if bodies are cut at the box, only the part of the ray in the box
/// counts. Only rays that meet a body are tried: in the row y, those with |x − y Σ_xy/Σ_yy| ≤ √((Σ_xx − Σ_xy²/Σ_yy)(1
/// − y²/Σ_yy)). Each pixel is the mean of 4 × 4 rays.
///
/// In space, bodies have diffuse and ambient light, a highlight and flat cuts, and bodies hide edges of the box
/// behind them. In the plane, bodies have a uniform colour and a darker rim, and everything outside the box is pale.
///
/// Bands of rows are drawn on all cores. The image does not depend on the number of cores.
Image cast_rays(const Scene& scene, int width, int height);

}  // namespace vitrel
