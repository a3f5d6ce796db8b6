#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// @file
/// The subcommands of vitrel-bench that answer one written question each, which stands at the head of
/// their source files. They print JSON, calendar a table and first-contact a line, and return the exit
/// code.
namespace vitrel::bench {

/// Of a benchmark in parts.
struct PartsOptions {
  std::vector<std::string> parts;  ///< by name; empty: all
  bool quick = false;              ///< few particles, short runs: to see that it works
};
int event_chain(const PartsOptions& options);
int exchanges(const PartsOptions& options);
int sampler(const PartsOptions& options);
int soft_spheres(const PartsOptions& options);
int ellipsoids(const PartsOptions& options);

struct EngineSpeedOptions : PartsOptions {
  double stretch = 0;       ///< seconds of one repeat; 0: the benchmark's own
  int largest = 1'000'000;  ///< number of particles
};
int engine(const EngineSpeedOptions& options);

struct CalendarOptions {
  std::size_t largest = 1'000'000;  ///< number of particles
  int repeats = 5;                  ///< of every run; the best counts
};
int calendar(const CalendarOptions& options);

struct FirstContactOptions {
  std::string name = "generic";  ///< class of pairs
  double aspect_ratio = 2;       ///< of the class
  std::uint64_t pairs = 4000;
  int repeats = 15;  ///< of which the fastest counts
};
int first_contact_time(const FirstContactOptions& options);

struct PairArraysOptions {
  std::string file;     ///< 8 doubles a body: a, b, x, y, angle, v_x, v_y, angular velocity
  double horizon = 10;  ///< of first contacts
};
int pair_arrays(const PairArraysOptions& options);

int structure_factor();
int analysis_growth(bool quick);  ///< quick: a tenth of the frames
int restitution(bool quick);      ///< quick: few points

}  // namespace vitrel::bench
