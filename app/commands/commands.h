#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/options.h"
#include "workflow/pair/impact.h"
#include "workflow/pair/pair_parameters.h"

/// @file
/// The commands. Each function returns the exit code, or throws one of the errors of core/error.h.
namespace vitrel {

struct PairOptions {
  PrintOptions print;
  PairSource source;
  std::vector<std::string> methods;  ///< names in vitrel-bench; the engine's own if empty
  bool all_methods = false;          ///< uses all methods of vitrel-bench
  // The following options are for `pair path` only.
  std::optional<double> until;  ///< usual_end by default
  int points = 1000;
  std::filesystem::path output;  ///< nothing is written if empty
  std::string command_line;
};

struct ImpactOptions {
  PrintOptions print;
  ImpactSource source;
  std::filesystem::path table, scaled_table, paths;  ///< files to write; none if empty
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

/// The commands whose template can be printed.
std::vector<std::string> commands_with_templates();

/// Replaces this process by `vitrel-bench` with these words: the program beside this one, that of the build tree, or
/// the first on PATH. Throws UserError if there is none.
[[noreturn]] void become_bench(const std::vector<std::string>& words);

/// Replaces this process by `vitrel-bench` with the words after the first one. Returns an exit code only if there is
/// no such program.
int bench_command(char** words);

/// Runs the command that the command line names and returns the exit code.
int run_command_line(int count, char** words);

}  // namespace vitrel
