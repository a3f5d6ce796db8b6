#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/commands/options.h"
#include "core/io/foreign/foreign_file.h"
#include "core/io/json.h"

/// @file
/// What the commands share.
namespace vitrel {

struct AnalysisChoice;
struct AnalysisProgress;
struct ParameterSource;
struct SweepProgress;
class ProgressDisplay;

ParameterSource parameter_source(const ParameterOptions& options, const StartOptions& start = {});
/// UserError if --set names anything but a parameter of the analysis or the import.
AnalysisChoice analysis_choice(const AnalysisOptions& options);
/// UserError if --set names anything but a parameter of the import.
KnownSystem import_choice(const AnalysisOptions& options);
/// Shows an analysis on the display.
AnalysisProgress shown_on(ProgressDisplay& display);

/// A run's file or a sweep's folder; of a job's folder, the run in it. FileError if it is not there.
std::filesystem::path run_or_sweep(const std::filesystem::path& input);

// Outputs are checked before the work, which may take long.

/// FileError if the output's folder is missing; UserError if the output is a folder or a device, or
/// one of the files that are read.
void require_output_file(const std::filesystem::path& output,
                         const std::vector<std::filesystem::path>& inputs);
/// Checks a file or folder that must not exist yet: FileError if the folder around it is missing, UserError
/// if it exists.
void require_new(const std::filesystem::path& output);

/// To standard output: as JSON if asked for, else unless quiet as lines "key  value", or "key  value ±
/// error" where `key_error` is in the summary, too.
void print_summary(const PrintOptions& options, const Json& summary);

/// The summary of work that was stopped before there was anything else to say about it, if JSON is asked for. It is printed
/// now, or by whatever ends the program at once (set_summary_of_stop).
void print_stopped(const PrintOptions& options, const std::filesystem::path& output);
void print_stopped_if_ended(const PrintOptions& options, const std::filesystem::path& output);

/// One line on standard error, unless quiet.
void remark(const PrintOptions& options, const std::string& line);
/// How the file of another program was read, a line for each heading; nothing if vitrel wrote it.
void remark_import(const PrintOptions& options, const std::filesystem::path& file,
                   const ImportReport& report);
/// Names the jobs of a sweep that are left out, if any.
void remark_left_out(const PrintOptions& options, const std::filesystem::path& folder,
                     const SweepProgress& sweep);

}  // namespace vitrel
