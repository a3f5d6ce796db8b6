#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/workflow/bench/chart.h"

/// The scene of the thesis's appendix B.1: two ellipses with a = 1, b = 0.5, one at rest at the
/// origin, the other coming from (1, 1) at (−1, 0), turning at π. They touch first at
/// t = 0.0847, overlap, and touch again from inside the overlap at t = 1, a trap for root finders
/// and optimisers.
namespace vitrel {

/// d(t), thesis fig. 3.11: the distance of the second ellipse from the first after the map that
/// makes the first one the unit circle; negative if they overlap.
Chart scene_gap_chart();

/// Ψ(t), thesis fig. 3.15: the contact function of Vieillard-Baron.
Chart scene_psi_chart();

/// When a method says that the two touch first.
struct SceneAnswer {
  std::string method;
  double tolerance = 0;
  std::optional<double> time;  ///< nothing if it finds no contact
};

/// The guaranteed reference, with the name "reference", and every method at its usual tolerance but
/// for those that are not made for such a pair.
std::vector<SceneAnswer> scene_answers();
nlohmann::ordered_json scene_json(const std::vector<SceneAnswer>& answers);

}  // namespace vitrel
