#pragma once

#include "workflow/pair/impact.h"
#include "workflow/report/figure_page.h"

/// @file
/// Figures 3 to 6 of mueller2013, and maps of one pair of spheres.
namespace vitrel {

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
