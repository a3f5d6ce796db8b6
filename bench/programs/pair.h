#pragma once

#include <string>
#include <vector>

#include "bench/studies/runner.h"

namespace vitrel::bench {

struct PairMethodsOptions {
  std::string pair;                  ///< both bodies as TOML, as `vitrel params pair` prints them
  std::vector<std::string> methods;  ///< names; all methods if empty
};

/// Runs `vitrel-bench pair`: prints the contact time of one pair by the default method and by others, with their time
/// per call, and as JSON also whether the pair overlaps. Throws UserError for an unknown method or an impossible
/// pair.
int pair(const PairMethodsOptions& options, const OutputOptions& output);

}  // namespace vitrel::bench
