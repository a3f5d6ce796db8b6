#pragma once

#include "workflow/pair/impact.h"
#include "workflow/pair/pair.h"
#include "workflow/report/figure_page.h"

/// @file
/// Figures of a pair: its course in free flight, as 3.11 and 3.15 of the thesis (woetzel2012) for any pair; the contact
/// of soft spheres, as 3 to 6 of mueller2013.
namespace vitrel {

/// d: where ellipse 1 is made the unit circle about the origin, by x̄ = diag(1/a₁, 1/b₁) R(θ₁)ᵀ (x − r₁), the distance
/// of ellipse 2 from that circle; negative if they overlap, and below −1 if ellipse 2 contains the origin. It has the
/// sign of the gap. After free flight for `time`, of this image of ellipse 2. Source: woetzel2012, section 3.2.2.
double unit_circle_distance(const Pair<2>& pair, double time,
                            const Shift<2>& image = Shift<2>::Zero());

/// Until when a course is worth showing: until the circumspheres have met and parted; if they never meet, twice as long
/// as the centres approach; if these part from the start or stay as they are, one turn of the faster body, or 1 if none
/// turns. In a box the image is that of the first contact before the horizon of the pair, or else the second body
/// itself.
template <int Dim>
double usual_end(const Pair<Dim>& pair);

/// At `points` ≥ 2 times, evenly spaced from 0 to `end`, of the closest image of body 2: gap and touching scale
/// (pair.h); in the plane d, Ψ, G₁ and G₂; in space η₁ … η₅ (core/contact/ellipsoid_eta.h). The second table has the
/// time of the first contact, if there is one until `end`, which stands for the horizon of the pair. UserError as
/// first_contact_of_images.
template <int Dim>
FigurePage path_of_pair(const Pair<Dim>& pair, double end, int points);

/// `coefficients_on_lattice` as colours over relative speed and impact parameter.
FigurePage coefficient_maps(const Impact& impact, const RestitutionTable& table);

/// The coefficients of all materials and speeds in the scaled variables of the source, by integration: ε_φ, ε_ṙ, ε_r
/// and ε_t on lattices over ln c_φ/c_φ^min and ln l̃/l̃^min (restitution.h), elastic and at five evenly spaced
///
///     ln c_dis   (linear dashpot),   ln c_dis/c_dis^min   (viscoelastic),
///     ln c_φ/c_φ^min = g − g^min,   g = ln(c_φ/l̃),
///     ln l̃/l̃^min = m − m^min,   m = ln l̃ − p ln(1 + (c_φ/l̃)²)   (p of the force),
///     ln c_dis/c_dis^min = c − c^min,   c = ln c_dis − ln l̃ + ½ ln(1 + (c_φ/l̃)²).
///
/// The ranges are those of the source, for equal radii: eccentricities from 0.01 to 0.99, and its tables 1 and 2.
/// Figures 4 and 5, and last figure 3: ε_φ of elastic spheres over ln c_φ and ln l̃.
FigurePage scaled_maps(ContactParameters::Law law);

/// The centres of both spheres before, during and after the contact, in the frame of figure 6 of the source: they meet
/// at time 0, the relative velocity is along y, and the centre of mass moves along x at a quarter of the speed.
/// Integrated from the force; by the rule of hard spheres with ε = −ε_ṙ; and by that of soft ones
/// (edmd/soft/soft_contact.h). `instant` counts sevenths of the duration of the contact.
FigurePage impact_paths(const Impact& impact);

}  // namespace vitrel
