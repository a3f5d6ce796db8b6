#pragma once

#include <string>
#include <vector>

#include "bench/studies/runner.h"

namespace vitrel::bench {

struct PairMethodsOptions {
  std::string pair;                  ///< both bodies as TOML text, as vitrel params pair prints it
  std::vector<std::string> methods;  ///< by name; empty: all
};

/// `vitrel-bench pair`: the contact time of one pair by the default method and by others, with their time per call; as
/// JSON also whether it overlaps. Throws UserError for an unknown method or an impossible pair.
int pair(const PairMethodsOptions& options, const OutputOptions& output);

}  // namespace vitrel::bench
