#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/options.h"
#include "workflow/pair/impact.h"
#include "workflow/pair/pair_parameters.h"

/// @file
/// The commands. Each returns the exit code, or throws one of the errors of core/error.h.
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

int analyze_command(const AnalyzeOptions& options);
int check_command(const CheckOptions& options);
int export_command(const ExportOptions& options);
int pair_overlap_command(const PairOptions& options);
int pair_gap_command(const PairOptions& options);
int pair_contact_time_command(const PairOptions& options);
int pair_path_command(const PairOptions& options);
int pair_restitution_command(const ImpactOptions& options);
int params_command(const ParamsOptions& options);
int picture_command(const PictureOptions& options);
int prepare_command(const PrepareOptions& options);
int report_command(const ReportOptions& options);
int run_command(const RunOptions& options);
int sweep_command(const SweepOptions& options);

/// Those whose template can be printed.
std::vector<std::string> commands_with_templates();

/// Becomes `vitrel-bench` with these words: the program beside this one, that of the build tree, or the first on PATH.
/// UserError if there is none.
[[noreturn]] void become_bench(const std::vector<std::string>& words);

/// The same with the words after the first one; returns an exit code only if there is none.
int bench_command(char** words);

/// Runs the command that the command line names and returns the exit code.
int run_command_line(int count, char** words);

}  // namespace vitrel
