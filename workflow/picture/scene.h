#pragma once

#include <cmath>
#include <vector>

#include "core/state/configuration.h"
#include "workflow/picture/colours.h"

namespace vitrel {

/// How much of the plane is shown beyond each edge of the box, in box lengths; there the periodic images are pale.
constexpr double plane_margin = 0.03;
/// The share of the background in the colour of what lies there.
constexpr double pale_share = 0.65;
/// The width of lines over the longer side of the picture.
constexpr double line_share = 1 / 800.;
constexpr Colour background = {255, 255, 255}, edge_colour = {27, 31, 36};
/// The colour of the rim of a body in the plane.
Colour rim_of(const Colour& colour);

/// How bodies in space are shown, by parallel rays. The camera is at (cos ε cos α, cos ε sin α, sin ε) from the middle
/// of the box, with the azimuth α and the elevation ε in degrees; z is upwards.
struct View {
  double azimuth = 304, elevation = 24;
  /// Every particle once and whole, not all images cut at the faces of the box.
  bool whole = false;
};

/// Bodies as they are seen: x to the right, y upwards, z to the eye; the middle of the box is at 0.
struct Scene {
  /// All x with (x − centre)ᵀ inverse (x − centre) ≤ 1.
  struct Body {
    Vec3 centre;
    Mat3 shape, inverse;  ///< the shape matrix and its inverse
    Colour colour;

    /// The largest z.
    double front() const { return centre.z() + std::sqrt(shape(2, 2)); }
  };
  std::vector<Body> bodies;      ///< in space those in front first, which hide most of the others
  Mat3 turn = Mat3::Identity();  ///< from the axes of the box to those of the view
  Vec3 half_box;                 ///< half the sides of the box; 0 in z in the plane
  Vec2 half;                     ///< half the sides of what is shown
  bool in_space = false;
  bool is_cut = false;  ///< at the faces of the box

  double line_width() const { return 2 * line_share * half.maxCoeff(); }
  /// In the plane: of a line, but at most a quarter of the minor semi-axis.
  double rim_width(const Body& body) const;
};

/// All images of ellipses that reach into the window: the box with its margin.
Scene scene_of(const Configuration2& configuration, const std::vector<Colour>& colours);
Scene scene_of(const Configuration3& configuration, const std::vector<Colour>& colours,
               const View& view);

}  // namespace vitrel
