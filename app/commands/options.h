#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// @file
/// The options of the commands, beginning with those that several commands share.
namespace vitrel {

/// How much a command prints.
struct PrintOptions {
  bool quiet = false;  ///< prints neither progress nor summary
  bool json = false;   ///< prints the summary as JSON
};

/// The parameter file.
struct ParameterOptions {
  std::filesystem::path file;
  std::vector<std::string> overrides;  ///< assignments key=value
  std::optional<std::uint64_t> seed;
};

/// The state to start from. Without a file, the parameters determine it.
struct StartOptions {
  std::filesystem::path from;
  bool shrink = false;
};

/// Parameters of an analysis, or of the import of a file. Without a file, those recorded in the run hold.
struct AnalysisOptions {
  std::filesystem::path file;
  std::vector<std::string> overrides;  ///< assignments key=value
};

struct AnalyzeOptions {
  PrintOptions print;
  AnalysisOptions analysis;
  bool list = false;             ///< only prints what the analysis computes
  std::filesystem::path input;   ///< a run, or the folder of a job or a sweep
  std::filesystem::path output;  ///< beside the input if empty
};

struct CheckOptions {
  PrintOptions print;
  AnalysisOptions import;
  std::filesystem::path input;  ///< a state or a run
  bool last_only = false;       ///< checks the last frame only
};

struct ExportOptions {
  PrintOptions print;
  AnalysisOptions import;
  std::filesystem::path input;   ///< a state, a run or results
  std::filesystem::path output;  ///< beside the input if empty
  std::string format;
  std::optional<std::string> frames;  ///< a slice in the notation of Python
  std::optional<double> shrink;       ///< factor of all semi-axes
  std::optional<std::size_t> voxels;  ///< along the longest edge
  bool images = false;                ///< for csv of a packing: includes images
};

struct ParamsOptions {
  std::string command;     ///< the command whose template is printed
  bool reference = false;  ///< prints docs/parameters.md
  bool python = false;     ///< prints python/vitrel/parameters.py
};

struct PictureOptions {
  PrintOptions print;
  AnalysisOptions import;
  std::filesystem::path input;               ///< a state or a run
  std::filesystem::path output;              ///< a .png beside the input if empty
  std::optional<std::string> frames;         ///< a slice in the notation of Python
  std::string colouring;                     ///< default_colouring if empty
  int width = 1000;                          ///< in pixels
  std::optional<double> azimuth, elevation;  ///< of the camera in space, in degrees
  bool whole = false;                        ///< shows bodies in space whole and without images
  std::optional<double> rate;                ///< pictures per second of a film
};

struct PrepareOptions {
  PrintOptions print;
  ParameterOptions source;
  std::filesystem::path output;
  StartOptions start;
  bool dry_run = false;  ///< only prints what would be done
  int threads = 1;
  double wall_time = 0;      ///< in seconds; 0: no limit
  std::string command_line;  ///< for the provenance
};

using RunOptions = PrepareOptions;

struct ReportOptions {
  PrintOptions print;
  AnalysisOptions analysis;
  std::filesystem::path input;   ///< a state, a run, or the folder of a job or a sweep
  std::filesystem::path output;  ///< beside the input if empty
};

struct SweepOptions {
  PrintOptions print;
  ParameterOptions source;
  std::filesystem::path output;  ///< folder of the sweep
  int parallel = 0;              ///< jobs at a time; 0 if not given
  double wall_time = 0;          ///< in seconds; 0: no limit
  bool status = false;           ///< only prints the progress of every job
  bool dry_run = false;          ///< only prints the jobs and their expected costs
  std::string job;               ///< the only job to run; all if empty
  std::string export_as;  ///< the program to which the sweep is exported; the sweep is run if empty
};

}  // namespace vitrel
