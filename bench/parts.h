#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "bench/lab/engine_speed.h"
#include "core/io/provenance.h"

/// A benchmark in parts that can be asked for by name, and the JSON that it prints.
namespace vitrel::lab {

using Json = nlohmann::ordered_json;

inline Json scene_json(const FluidScene& scene) {
  return {{"particles", scene.particles},
          {"aspect_ratio", scene.aspect_ratio},
          {"packing_fraction", scene.packing_fraction}};
}

template <class Effort>
using BenchParts = std::vector<std::pair<std::string, Json (*)(const Effort&)>>;

template <class Effort>
std::vector<std::string> part_names(const BenchParts<Effort>& parts) {
  std::vector<std::string> names;
  for (const auto& [name, measure] : parts) names.push_back(name);
  return names;
}

/// What the parts that are wanted measure, all if none is named; before and after it the calibration,
/// ns per Ψ, each in so many seconds.
template <class Effort>
Json measure_parts(const BenchParts<Effort>& parts, const Effort& effort,
                   const std::vector<std::string>& wanted, double calibration_seconds) {
  Json result = {
      {"commit", program_commit()}, {"compiler", "g++ " __VERSION__}, {"flags", VITREL_FLAGS}};
  result["ns_per_psi"] = ns_per_psi(calibration_seconds);
  for (const auto& [name, measure] : parts)
    if (wanted.empty() || std::ranges::count(wanted, name) > 0) result[name] = measure(effort);
  result["ns_per_psi_at_the_end"] = ns_per_psi(calibration_seconds);
  return result;
}

}  // namespace vitrel::lab
