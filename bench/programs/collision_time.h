#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/programs/report.h"
#include "bench/surveys/verdict.h"

namespace vitrel::bench {

struct CollisionTimeOptions {
  std::uint64_t pairs = 2000;  ///< of each class
  double seconds = 4;          ///< that a method other than the default may predict
  std::uint64_t seed = 1;
  AllowedError allowed;
  std::vector<std::string> methods;  ///< by name; empty: all
  std::vector<std::string> classes;  ///< likewise
  double duration = 20;              ///< simulated time of the whole runs on the page
};

/// `vitrel-bench collision-time`: every method of predicting a collision of ellipses, asked about the same
/// pairs; on its page also overlap criteria and whole runs. Throws UserError for an unknown method or class.
int collision_time(const CollisionTimeOptions& options, const OutputOptions& output);

/// `vitrel-bench collision-time-of-ellipsoids`: the same in three dimensions.
int collision_time_of_ellipsoids(const CollisionTimeOptions& options, const OutputOptions& output);

}  // namespace vitrel::bench
