#pragma once

#include "app/commands/options.h"

namespace vitrel {

struct ExportOptions {
  PrintOptions print;
  std::filesystem::path input;   ///< state, run or results
  std::filesystem::path output;  ///< empty: beside the input
  std::string format;
  std::optional<std::string> frames;  ///< a slice as in Python
  std::optional<double> shrink;       ///< factor of all semi-axes
  std::optional<std::size_t> voxels;  ///< along the longest edge
  bool images = false;                ///< of a packing, to csv
};

/// Returns the exit code, or throws one of the errors of core/error.h.
int export_command(const ExportOptions& options);

}  // namespace vitrel
