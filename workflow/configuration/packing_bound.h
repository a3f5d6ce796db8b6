#pragma once

#include <vector>

#include "core/state/species.h"
#include "workflow/rules.h"

namespace vitrel {

/// The packing fraction that no arrangement of these particles exceeds, as far as that is known:
///
/// - Ellipses of equal area A, whatever their aspect ratios: π/√12. For ellipses that do not overlap lie in as many
///   convex polygons that do not overlap and have six sides on average (fejestoth1950), and a polygon of n sides around
///   an ellipse has at least the area (A/π) n tan(π/n), convex in n.
/// - Equal spheres: π/√18 (hales2005).
/// - All others: 1. Small disks or spheres fill the holes between large ones, and crystals of ellipsoids are denser than
///   those of spheres: 0.7707 at the aspect ratio √3 (donev2004).
///
/// The species must be valid.
PackingBound packing_bound(const std::vector<Species>& species, int dimension);

}  // namespace vitrel
