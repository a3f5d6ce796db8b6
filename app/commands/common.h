#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/commands/options.h"
#include "core/io/foreign/foreign_file.h"
#include "core/io/json.h"

/// @file
/// Functions that several commands share.
namespace vitrel {

struct AnalysisChoice;
struct AnalysisProgress;
struct ParameterSource;
struct SweepProgress;
class ProgressDisplay;

ParameterSource parameter_source(const ParameterOptions& options, const StartOptions& start = {});
/// Throws UserError if --set names anything but a parameter of the analysis or the import.
AnalysisChoice analysis_choice(const AnalysisOptions& options);
/// Throws UserError if --set names anything but a parameter of the import.
KnownSystem import_choice(const AnalysisOptions& options);
/// Callbacks that show the progress of an analysis on the display.
AnalysisProgress shown_on(ProgressDisplay& display);

/// Resolves the input: the file of a run, the folder of a sweep, or for the folder of a job the run in it. Throws
/// FileError if it does not exist.
std::filesystem::path run_or_sweep(const std::filesystem::path& input);

// Outputs are checked before the work begins, because the work may take long.

/// Throws FileError if the folder of the output is missing, and UserError if the output is a folder, a device, or one
/// of the files that are read.
void require_output_file(const std::filesystem::path& output,
                         const std::vector<std::filesystem::path>& inputs);
/// Checks a file or folder that must not exist yet. Throws FileError if the folder around it is missing, and
/// UserError if it exists.
void require_new(const std::filesystem::path& output);

/// Prints the summary on standard output, as JSON if options.json is set. Otherwise, unless options.quiet is set, it
/// prints lines "key  value", or "key  value ± error" if the summary also has `key_error`.
void print_summary(const PrintOptions& options, const Json& summary);

/// Both print, if options.json is set, the summary of work that was stopped before there was anything else to say
/// about it. The first prints it now. The second leaves it to the code that ends the program at once
/// (set_summary_of_stop).
void print_stopped(const PrintOptions& options, const std::filesystem::path& output);
void print_stopped_if_ended(const PrintOptions& options, const std::filesystem::path& output);

/// Prints one line on standard error, unless options.quiet is set.
void remark(const PrintOptions& options, const std::string& line);
/// Prints how the file of another program was read, in a line for each heading; nothing if vitrel wrote the file.
void remark_import(const PrintOptions& options, const std::filesystem::path& file,
                   const ImportReport& report);
/// Names the jobs of a sweep that are left out, if there are any.
void remark_left_out(const PrintOptions& options, const std::filesystem::path& folder,
                     const SweepProgress& sweep);

}  // namespace vitrel
