#pragma once

#include <cmath>
#include <vector>

#include "core/state/configuration.h"
#include "workflow/picture/colours.h"

namespace vitrel {

/// Width of the margin that is shown beyond each edge of the box in the plane, in box lengths. Periodic images there
/// are pale.
constexpr double plane_margin = 0.03;
/// The share of the background in pale colours.
constexpr double pale_share = 0.65;
/// The width of lines, over the longer side of the picture.
constexpr double line_share = 1 / 800.;
constexpr Colour background = {255, 255, 255}, edge_colour = {27, 31, 36};
/// The colour of the rim of a body in the plane.
Colour rim_of(const Colour& colour);

/// How bodies in space are seen, by parallel rays. The camera lies in the direction (cos ε cos α, cos ε sin α, sin ε)
/// from the middle of the box, with azimuth α and elevation ε in degrees; z points upwards.
struct View {
  double azimuth = 304, elevation = 24;
  /// If true, every particle is shown once and whole; if false, all images are shown, cut at the faces of the box.
  bool whole = false;
};

/// Bodies in the axes of the view: x to the right, y upwards, z towards the eye. The middle of the box is at 0.
struct Scene {
  /// The body is the set of all x with (x − centre)ᵀ inverse (x − centre) ≤ 1.
  struct Body {
    Vec3 centre;
    Mat3 shape, inverse;  ///< the shape matrix and its inverse
    Colour colour;

    /// The z of the point nearest to the eye.
    double front() const { return centre.z() + std::sqrt(shape(2, 2)); }
  };
  /// The visible bodies. In space they are sorted from front to back, since those in front hide most others.
  std::vector<Body> bodies;
  Mat3 turn = Mat3::Identity();  ///< turns the axes of the box into those of the view
  Vec3 half_box;                 ///< half the sides of the box; z is 0 in the plane
  Vec2 half;                     ///< half the sides of the visible window
  bool in_space = false;
  bool is_cut = false;  ///< whether bodies are cut at the faces of the box

  double line_width() const { return 2 * line_share * half.maxCoeff(); }
  /// The width of the rim in the plane: that of a line, but at most a quarter of the minor semi-axis.
  double rim_width(const Body& body) const;
};

/// All images of ellipses that reach into the window, which is the box with its margin.
Scene scene_of(const Configuration2& configuration, const std::vector<Colour>& colours);
Scene scene_of(const Configuration3& configuration, const std::vector<Colour>& colours,
               const View& view);

}  // namespace vitrel
