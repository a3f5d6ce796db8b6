#pragma once

#include "workflow/pair/impact.h"
#include "workflow/pair/pair.h"
#include "workflow/report/figure_page.h"

/// @file
/// Figures of a pair: the course of any pair in free flight, as figures 3.11 and 3.15 of the thesis (woetzel2012),
/// and the contact of soft spheres, as figures 3 to 6 of mueller2013.
namespace vitrel {

/// The distance d after free flight for `time`, for this image of ellipse 2. The map x̄ = diag(1/a₁, 1/b₁) R(θ₁)ᵀ (x
/// − r₁) turns ellipse 1 into the unit circle about the origin, and d is the distance of ellipse 2 from that circle.
/// It is negative if they overlap, and below −1 if ellipse 2 contains the origin. It has the sign of the gap. Source:
/// woetzel2012, section 3.2.2.
double unit_circle_distance(const Pair<2>& pair, double time,
                            const Shift<2>& image = Shift<2>::Zero());

/// The time at which a course is no longer of interest. It is the time when the circumspheres have met and separated.
/// If they never meet, it is twice the time during which the centres approach. If the centres do not approach at all,
/// it is the time of one turn of the faster body, or 1 if none turns. In a box, the image of body 2 is that of the
/// first contact before the horizon of the pair, or the body itself if there is none.
template <int Dim>
double usual_end(const Pair<Dim>& pair);

/// The course of the closest image of body 2 at `points` ≥ 2 times, evenly spaced from 0 to `end`: gap and touching
/// scale (pair.h); in the plane also d, Ψ, G₁ and G₂; in space η₁ … η₅ (core/contact/ellipsoid_eta.h). The second
/// table has the time of the first contact if there is one before `end`, which takes the place of the horizon of the
/// pair. Throws UserError as first_contact_of_images does.
template <int Dim>
FigurePage path_of_pair(const Pair<Dim>& pair, double end, int points);

/// Maps of `coefficients_on_lattice`, whose colours show the coefficients over relative speed and impact parameter.
FigurePage coefficient_maps(const Impact& impact, const RestitutionTable& table);

/// The coefficients of all materials and speeds in the scaled variables of mueller2013, by integration: ε_φ, ε_ṙ, ε_r
/// and ε_t on lattices over ln c_φ/c_φ^min and ln l̃/l̃^min (restitution.h), for elastic spheres and at five evenly
/// spaced values of
///
///     ln c_dis   (linear dashpot),   ln c_dis/c_dis^min   (viscoelastic),
///     ln c_φ/c_φ^min = g − g^min,   g = ln(c_φ/l̃),
///     ln l̃/l̃^min = m − m^min,   m = ln l̃ − p ln(1 + (c_φ/l̃)²)   (p of the force),
///     ln c_dis/c_dis^min = c − c^min,   c = ln c_dis − ln l̃ + ½ ln(1 + (c_φ/l̃)²).
///
/// The ranges are those of the source for equal radii: eccentricities from 0.01 to 0.99, and its tables 1 and 2. The
/// maps are its figures 4 and 5. The last one is its figure 3: ε_φ of elastic spheres over ln c_φ and ln l̃.
FigurePage scaled_maps(ContactParameters::Law law);

/// The centres of both spheres before, during and after the contact, in the frame of figure 6 of mueller2013: the
/// spheres meet at time 0, the relative velocity is along y, and the centre of mass moves along x at a quarter of the
/// speed. The paths are integrated from the force, and follow from the rule of hard spheres with ε = −ε_ṙ and from
/// that of soft spheres (edmd/soft/soft_contact.h). `instant` counts sevenths of the duration of the contact.
FigurePage impact_paths(const Impact& impact);

}  // namespace vitrel
