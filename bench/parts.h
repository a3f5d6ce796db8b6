#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <functional>
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

/// What is being measured, on standard error.
inline void say(const std::string& what) {
  fmt::print(stderr, "{}\n", what);
}

/// The main program: the parts named on the command line, with less effort if it says --quick, as JSON on
/// standard output. `app` has the question, the name of the program and options of its own, which
/// `apply` carries out; it returns the seconds of a calibration.
template <class Effort>
int measure_command(CLI::App& app, int argc, char** argv, const BenchParts<Effort>& parts,
                    const Effort& quick, const std::function<double(Effort&)>& apply) {
  std::vector<std::string> wanted;
  bool is_quick = false;
  app.add_option("part", wanted, "what to measure; all parts if none is named")
      ->check(CLI::IsMember(part_names(parts)));
  app.add_flag("--quick", is_quick, "few particles, short runs: to see that it works");
  CLI11_PARSE(app, argc, argv);
  try {
    Effort effort = is_quick ? quick : Effort{};
    const double calibration_seconds = apply(effort);
    fmt::print("{}\n", measure_parts(parts, effort, wanted, calibration_seconds).dump(2));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", app.get_name(), error.what());
    return 1;
  }
  return 0;
}

}  // namespace vitrel::lab
