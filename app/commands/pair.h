#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/options.h"
#include "workflow/pair/impact.h"
#include "workflow/pair/pair_parameters.h"

namespace vitrel {

struct PairOptions {
  PrintOptions print;
  PairSource source;
  std::vector<std::string> methods;  ///< names in vitrel-bench; empty: that of the engine
  bool all_methods = false;          ///< all those of vitrel-bench
  // What `pair path` alone reads:
  std::optional<double> until;  ///< none: usual_end
  int points = 1000;
  std::filesystem::path output;  ///< empty: none
  std::string command_line;
};

struct ImpactOptions {
  PrintOptions print;
  ImpactSource source;
  std::filesystem::path table, scaled_table, paths;  ///< to write; empty: none
  std::string command_line;
};

// Each returns the exit code, or throws one of the errors of core/error.h.

int pair_overlap_command(const PairOptions& options);
int pair_gap_command(const PairOptions& options);
int pair_contact_time_command(const PairOptions& options);
int pair_path_command(const PairOptions& options);
int pair_restitution_command(const ImpactOptions& options);

}  // namespace vitrel
