#pragma once

#include <string>
#include <vector>

#include "app/commands/options.h"

/// @file
/// The commands. Each returns the exit code, or throws one of the errors of core/error.h.
namespace vitrel {

int analyze_command(const AnalyzeOptions& options);
int check_command(const CheckOptions& options);
int export_command(const ExportOptions& options);
int params_command(const ParamsOptions& options);
int picture_command(const PictureOptions& options);
int prepare_command(const PrepareOptions& options);
int report_command(const ReportOptions& options);
int run_command(const RunOptions& options);
int sweep_command(const SweepOptions& options);

/// Those whose template can be printed.
std::vector<std::string> commands_with_templates();

}  // namespace vitrel
