#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// @file
/// The options of the commands, those that several share first.
namespace vitrel {

/// How much is printed.
struct PrintOptions {
  bool quiet = false;  ///< no progress and no summary
  bool json = false;   ///< the summary as JSON
};

/// The parameter file.
struct ParameterOptions {
  std::filesystem::path file;
  std::vector<std::string> overrides;  ///< key=value
  std::optional<std::uint64_t> seed;
};

/// The state to start from; without a file, the parameters say.
struct StartOptions {
  std::filesystem::path from;
  bool shrink = false;
};

/// Parameters of an analysis, or of the import of a file; without a file, those in the run.
struct AnalysisOptions {
  std::filesystem::path file;
  std::vector<std::string> overrides;  ///< key=value
};

struct AnalyzeOptions {
  PrintOptions print;
  AnalysisOptions analysis;
  bool list = false;             ///< what it computes, and nothing else
  std::filesystem::path input;   ///< run, or folder of a job or a sweep
  std::filesystem::path output;  ///< empty: beside the input
};

struct CheckOptions {
  PrintOptions print;
  AnalysisOptions import;
  std::filesystem::path input;  ///< state or run
  bool last_only = false;       ///< the last frame only
};

struct ExportOptions {
  PrintOptions print;
  AnalysisOptions import;
  std::filesystem::path input;   ///< state, run or results
  std::filesystem::path output;  ///< empty: beside the input
  std::string format;
  std::optional<std::string> frames;  ///< a slice as in Python
  std::optional<double> shrink;       ///< factor of all semi-axes
  std::optional<std::size_t> voxels;  ///< along the longest edge
  bool images = false;                ///< of a packing, to csv
};

struct ParamsOptions {
  std::string command;     ///< whose template is printed
  bool reference = false;  ///< print docs/parameters.md
  bool python = false;     ///< print python/vitrel/parameters.py
};

struct PictureOptions {
  PrintOptions print;
  AnalysisOptions import;
  std::filesystem::path input;               ///< state or run
  std::filesystem::path output;              ///< empty: a .png beside the input
  std::optional<std::string> frames;         ///< a slice as in Python
  std::string colouring;                     ///< empty: as the particles suggest
  int width = 1000;                          ///< pixels
  std::optional<double> azimuth, elevation;  ///< of the camera in space, degrees
  bool whole = false;                        ///< bodies in space, without images
  std::optional<double> rate;                ///< pictures per second of a film
};

struct PrepareOptions {
  PrintOptions print;
  ParameterOptions source;
  std::filesystem::path output;
  StartOptions start;
  bool dry_run = false;  ///< print what would be done
  int threads = 1;
  double wall_time = 0;      ///< seconds; 0: no limit
  std::string command_line;  ///< for the provenance
};

using RunOptions = PrepareOptions;

struct ReportOptions {
  PrintOptions print;
  AnalysisOptions analysis;
  std::filesystem::path input;   ///< state, run, or folder of a job or a sweep
  std::filesystem::path output;  ///< empty: beside the input
};

struct SweepOptions {
  PrintOptions print;
  ParameterOptions source;
  std::filesystem::path output;  ///< folder of the sweep
  int parallel = 0;              ///< jobs at a time; 0: not given
  double wall_time = 0;          ///< seconds; 0: no limit
  bool status = false;           ///< only print how far every job is
  bool dry_run = false;          ///< only print the jobs and what they are expected to cost
  std::string job;               ///< the only job to run; empty: all
  std::string export_as;  ///< program to write the sweep for instead of running it; empty: run
};

}  // namespace vitrel
