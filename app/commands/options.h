#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// @file
/// Options that several commands share.
namespace vitrel {

/// How much is printed.
struct PrintOptions {
  bool quiet = false;  ///< no progress and no summary
  bool json = false;   ///< the summary as JSON
};

/// The parameter file.
struct ParameterOptions {
  std::filesystem::path file;
  std::vector<std::string> overrides;  ///< key=value
  std::optional<std::uint64_t> seed;
};

/// The state to start from; without a file, the parameters say.
struct StartOptions {
  std::filesystem::path from;
  bool shrink = false;
};

/// Parameters of an analysis; without a file, those in the run.
struct AnalysisOptions {
  std::filesystem::path file;
  std::vector<std::string> overrides;  ///< key=value
};

}  // namespace vitrel
