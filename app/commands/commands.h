#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// The commands of the program: each turns its part of the command line into a call of the workflow
/// and says what came out. They return the exit code, or throw one of the errors of core/error.h.
namespace vitrel {

enum ExitCode {
  success = 0,
  defect = 1,  ///< an error nobody foresaw
  user_error = 2,
  file_error = 3,
  broken_invariant = 4,
  stopped = 5,  ///< on request or for want of time; the same command continues (but for bench)
};

/// What the command line says; every command uses its part.
struct Arguments {
  std::string command_line;            ///< the whole, for the provenance
  std::filesystem::path input;         ///< parameter file, state, run or sweep
  std::filesystem::path output;        ///< empty: the command's default, where it has one
  std::filesystem::path parameters;    ///< analyze, report: instead of those in the run
  std::filesystem::path from;          ///< run: state to start from
  std::vector<std::string> overrides;  ///< --set
  std::optional<std::uint64_t> seed;
  double wall_time = 0;  ///< seconds; 0: no limit
  int parallel = 1;
  int threads = 1;
  bool quiet = false, json = false;
  bool dry_run = false, status = false, last_only = false, reference = false;
  std::string template_command;       ///< params: whose template
  std::string format;                 ///< export: of the output
  std::optional<std::string> frames;  ///< export: which ones
  std::optional<double> shrink;       ///< export: of all lengths of the bodies
  std::optional<std::size_t> voxels;  ///< export: along the longest edge
  std::string job;                    ///< sweep: the only one to work off; empty: all
  std::string export_as;              ///< sweep: what to write it as; empty: work it off
  // bench; what is not given is the benchmark's default
  std::vector<std::string> methods, classes;  ///< by name; empty: all
  std::optional<std::uint64_t> pairs;         ///< of each class
  std::optional<double> seconds;              ///< that a slow method may take
  std::optional<double> tolerance;            ///< of the judge
  std::optional<double> gap_tolerance;        ///< of the judge, if gaps have another one
  std::optional<double> duration;             ///< of whole runs
  std::optional<int> largest;                 ///< number of particles
  std::optional<int> runs;                    ///< that are averaged
};

int prepare_command(const Arguments& arguments);
int run_command(const Arguments& arguments);
int check_command(const Arguments& arguments);
int analyze_command(const Arguments& arguments);
int sweep_command(const Arguments& arguments);
int export_command(const Arguments& arguments);
int report_command(const Arguments& arguments);
int params_command(const Arguments& arguments);
int bench_collision_time_command(const Arguments& arguments);
int bench_collision_time_of_solids_command(const Arguments& arguments);
int bench_overlap_command(const Arguments& arguments);
int bench_thesis_command(const Arguments& arguments);
int bench_whole_run_command(const Arguments& arguments);

}  // namespace vitrel
