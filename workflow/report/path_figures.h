#pragma once

#include "workflow/pair/pair.h"
#include "workflow/report/figure_page.h"

/// @file
/// The course of a pair in free flight, as figures: 3.11 and 3.15 of the thesis (woetzel2012) for any pair.
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

}  // namespace vitrel
