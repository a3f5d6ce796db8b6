#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/terminal/exit_codes.h"

/// The commands of the program: each turns its part of the command line into a call of the workflow
/// and says what came out. They return the exit code, or throw one of the errors of core/error.h.
namespace vitrel {

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
};

int prepare_command(const Arguments& arguments);
int run_command(const Arguments& arguments);
int check_command(const Arguments& arguments);
int analyze_command(const Arguments& arguments);
int sweep_command(const Arguments& arguments);
int export_command(const Arguments& arguments);
int report_command(const Arguments& arguments);
int params_command(const Arguments& arguments);

/// Becomes `vitrel-bench` with the words after the first one: the program beside this one, that of the
/// build tree, or the first on PATH. Returns only if there is none.
int bench_command(char** words);

}  // namespace vitrel
