#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "bench/programs/programs.h"
#include "bench/surveys/engine_speed.h"
#include "core/error.h"
#include "core/io/json.h"
#include "core/io/provenance.h"

/// @file
/// A benchmark in parts that can be asked for by name, and the JSON that it prints.
namespace vitrel::bench {

inline Json scene_json(const FluidScene& scene) {
  return {{"particles", scene.particles},
          {"aspect_ratio", scene.aspect_ratio},
          {"packing_fraction", scene.packing_fraction}};
}

template <class Effort>
using BenchParts = std::vector<std::pair<std::string, Json (*)(const Effort&)>>;

/// Throws UserError for a name that no part has.
template <class Effort>
void require_known(const BenchParts<Effort>& parts, const std::vector<std::string>& wanted) {
  for (const std::string& name : wanted) {
    std::string known;
    for (const auto& [part, measure] : parts) known += " " + part;
    if (std::ranges::none_of(parts, [&](const auto& part) { return part.first == name; }))
      throw UserError("there is no part \"" + name + "\"; known are" + known);
  }
}

/// What is being measured, on standard error.
void say(const std::string& what);
/// On standard output.
void print(const Json& result);

/// Measures the parts that are wanted, all if none is named, and prints them as JSON; before and after
/// them the calibration, ns per Ψ, each in so many seconds.
template <class Effort>
int measure_parts(const BenchParts<Effort>& parts, const Effort& effort,
                  const std::vector<std::string>& wanted, double calibration_seconds) {
  require_known(parts, wanted);
  Json result = {
      {"commit", program_commit()}, {"compiler", "g++ " __VERSION__}, {"flags", VITREL_FLAGS}};
  result["ns_per_psi"] = ns_per_psi(calibration_seconds);
  for (const auto& [name, measure] : parts)
    if (wanted.empty() || std::ranges::count(wanted, name) > 0) result[name] = measure(effort);
  result["ns_per_psi_at_the_end"] = ns_per_psi(calibration_seconds);
  print(result);
  return 0;
}

}  // namespace vitrel::bench
