#include "bench/overlap/criterion.h"

#include "bench/overlap/polygon.h"
#include "core/contact/contact_queries.h"
#include "core/contact/ellipse_vieillard_baron.h"
#include "core/contact/perram_wertheim.h"

namespace vitrel::bench {
namespace {

VieillardBaron<double> contact_function(const OverlapCase& asked) {
  return vieillard_baron(asked.one, asked.pose1.angle, asked.two, asked.pose2.angle,
                         asked.between_centres());
}

bool by_support_gap(const OverlapCase& asked) {
  return separated(asked.one, asked.pose1, asked.two, asked.pose2, asked.between_centres(), 0);
}

bool by_perram_wertheim(const OverlapCase& asked) {
  return perram_wertheim(asked.one, asked.pose1.angle, asked.two, asked.pose2.angle,
                         asked.between_centres())
      .disjoint();
}

OverlapCriterion by_polygons(int vertices) {
  return {"polygon_" + std::to_string(vertices),
          "polygons of equal area with " + std::to_string(vertices) + " vertices, separating axis",
          vertices, [shape = RegularPolygon(vertices)](const OverlapCase& asked) {
            return disjoint(shape, asked);
          }};
}

}  // namespace

std::vector<OverlapCriterion> overlap_criteria() {
  std::vector<OverlapCriterion> criteria = {
      {"support_gap", "an axis with a positive support gap", 0, by_support_gap},
      {"perram_wertheim", "max F > 1", 0, by_perram_wertheim},
      {"vieillard_baron", "Ψ > 0 and (G₁ < 0 or G₂ < 0)", 0,
       [](const OverlapCase& asked) { return contact_function(asked).disjoint(); }},
      {"vieillard_baron_incomplete", "Ψ > 0 alone, as a warning", 0,
       [](const OverlapCase& asked) { return contact_function(asked).psi > 0; }}};
  for (int vertices = 8; vertices <= 256; vertices *= 2) criteria.push_back(by_polygons(vertices));
  return criteria;
}

}  // namespace vitrel::bench
