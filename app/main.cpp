#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <sstream>
#include <system_error>

#include "app/commands/commands.h"
#include "core/error.h"
#include "core/io/provenance.h"

namespace vitrel {
namespace {

// The command that the command line chose, if any.
using Chosen = std::function<int(const Arguments&)>;

const std::string exit_codes =
    "Exit codes: 0 done, 2 mistake in parameters or command line, 3 a file cannot be read or "
    "written";
const std::string overlap_code = ", 4 overlap or another broken invariant";
const std::string resumed_code = ", 5 stopped (the same command continues)";

constexpr std::size_t help_width = 80;

/// Line breaks between words, so that no line is longer than `width`.
std::string wrapped(const std::string& text, std::size_t width) {
  std::istringstream words(text);
  std::string lines, word;
  std::size_t column = 0;
  while (words >> word) {
    const bool fits = column + 1 + word.size() <= width;
    if (column > 0) lines += fits ? ' ' : '\n';
    lines += word;
    column = (column > 0 && fits ? column + 1 : 0) + word.size();
  }
  return lines;
}

/// Help in lines that fit a terminal.
class Help : public CLI::Formatter {
  std::string make_description(const CLI::App* app) const override {
    return wrapped(app->get_description(), help_width) + '\n';
  }
  std::string make_footer(const CLI::App* app) const override {
    const std::string footer = app->get_footer();
    return footer.empty() ? footer : wrapped(footer, help_width) + '\n';
  }
  std::string make_subcommand(const CLI::App* app) const override {
    std::ostringstream text;
    CLI::detail::format_help(text, app->get_name(), in_column(app->get_description()),
                             get_column_width());
    return text.str();
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    return in_column(option->get_description());
  }
  std::string in_column(const std::string& text) const {
    return wrapped(text, help_width - get_column_width());
  }
};

CLI::Validator number_above_zero(bool or_zero, const std::string& wanted) {
  return {[=](const std::string& text) {
            double number = 0;
            const bool fits =
                CLI::detail::lexical_cast(text, number) && (number > 0 || (or_zero && number == 0));
            return fits ? std::string() : text + " is not " + wanted;
          },
          ""};
}
const CLI::Validator positive = number_above_zero(false, "a positive number");
const CLI::Validator not_negative = number_above_zero(true, "a positive number or 0");

class CommandLine {
 public:
  CommandLine()
      : app_("Simulation of hard anisotropic particles, from the liquid to the glass.", "vitrel") {
    app_.formatter(std::make_shared<Help>());
    app_.require_subcommand(1);
    app_.set_version_flag("--version", program_version());
    app_.failure_message([](const CLI::App*, const CLI::Error& error) {
      return "vitrel: " + std::string(error.what()) +
             "; vitrel --help and vitrel <command> --help list what there is\n";
    });
    add_prepare();
    add_run();
    add_check();
    add_analyze();
    add_sweep();
    add_report();
    add_export();
    add_bench();
    add_params();
  }

  /// The exit code if there is nothing left to do (help, or a mistake), else nothing.
  std::optional<int> parse(int count, char** words) {
    for (int k = 0; k < count; ++k)
      arguments_.command_line += (k > 0 ? " " : "") + std::string(words[k]);
    try {
      app_.parse(count, words);
    } catch (const CLI::ParseError& error) {
      return app_.exit(error) == 0 ? success : user_error;
    }
    return std::nullopt;
  }

  int run() const { return chosen_(arguments_); }
  std::string command() const { return app_.get_subcommands().front()->get_name(); }

 private:
  CLI::App& add(const std::string& name, const std::string& sentence, const Chosen& command) {
    return add(app_, name, sentence, command);
  }
  CLI::App& add(CLI::App& parent, const std::string& name, const std::string& sentence,
                const Chosen& command) {
    CLI::App& sub = *parent.add_subcommand(name, sentence);
    sub.callback([this, command] { chosen_ = command; });
    sub.footer(exit_codes + ".");
    return sub;
  }

  void add_quiet_and_json(CLI::App& sub) {
    sub.add_flag("-q,--quiet", arguments_.quiet, "No progress and no summary");
    sub.add_flag("--json", arguments_.json, "Summary as JSON on standard output");
  }
  void add_overrides(CLI::App& sub, const std::string& example) {
    sub.add_option("--set", arguments_.overrides,
                   "key=value, instead of the value in the file: --set " + example)
        ->take_all()
        ->allow_extra_args(false);
  }
  void add_wall_time(CLI::App& sub) {
    sub.add_option("--wall-time", arguments_.wall_time,
                   "Stop cleanly after this many seconds (exit code 5)")
        ->check(not_negative);
  }
  void add_parameter_file(CLI::App& sub) {
    sub.add_option("params", arguments_.input, "Parameter file (TOML); vitrel params prints one")
        ->required();
    add_overrides(sub, "dynamics.duration=10");
    sub.add_option("--seed", arguments_.seed,
                   "Seed of all random numbers, the same as --set system.seed=");
  }
  void add_output(CLI::App& sub, const std::string& what, bool required) {
    CLI::Option* option = sub.add_option("-o,--output", arguments_.output, what);
    if (required) option->required();
  }
  void add_threads(CLI::App& sub, const std::string& what) {
    sub.add_option("--threads", arguments_.threads, what + "; the results do not depend on it")
        ->check(positive);
  }
  void add_analysis_parameters(CLI::App& sub) {
    sub.add_option("--params", arguments_.parameters,
                   "Parameter file with [analysis], instead of that in the run");
    add_overrides(sub, "analysis.longest_lag=0.1");
  }

  void add_prepare() {
    CLI::App& sub =
        add("prepare", "Make a first state, and report how good it is.", prepare_command);
    sub.footer(exit_codes + overlap_code + resumed_code + ".");
    add_parameter_file(sub);
    add_output(sub, "State file to write; its quality report <state>.quality.json lies beside it",
               true);
    add_threads(sub, "Threads for Monte Carlo (1)");
    add_wall_time(sub);
    add_quiet_and_json(sub);
  }
  void add_run() {
    CLI::App& sub =
        add("run", "Start or continue an event-driven run; without --from, prepare first.",
            run_command);
    sub.footer(exit_codes + overlap_code + resumed_code + ".");
    add_parameter_file(sub);
    add_output(sub, "Trajectory to write; its checkpoint lies beside it", true);
    sub.add_option("--from", arguments_.from, "State or run whose last frame to start from");
    sub.add_flag("--dry-run", arguments_.dry_run, "Print what would be done");
    add_threads(sub, "Threads for the Brownian steps and for Monte Carlo in the preparation (1)");
    add_wall_time(sub);
    add_quiet_and_json(sub);
  }
  void add_check() {
    CLI::App& sub = add("check", "Exact check of a state or of all frames of a run for overlaps.",
                        check_command);
    sub.footer(exit_codes + overlap_code + ", 5 stopped (no overlap so far).");
    sub.add_option("file", arguments_.input, "State or run")->required();
    sub.add_flag("--last", arguments_.last_only, "The last frame only");
    add_quiet_and_json(sub);
  }
  void add_analyze() {
    CLI::App& sub = add(
        "analyze",
        "Structure, motion, energies and pressure of a run; relaxation times and the glass "
        "transition of a sweep, from the results of its jobs, or with --params or --set from their "
        "runs.",
        analyze_command);
    sub.add_option("run", arguments_.input, "Run, or folder of a job or a sweep")->required();
    add_output(sub,
               "Results to write (HDF5, and CSV tables beside it); default <run>_results.h5 or "
               "<sweep>/results.h5",
               false);
    add_analysis_parameters(sub);
    add_quiet_and_json(sub);
  }
  void add_sweep() {
    CLI::App& sub =
        add("sweep", "Work off all jobs of [sweep]: prepare, run, analyze.", sweep_command);
    sub.footer(exit_codes + overlap_code + resumed_code +
               "; of jobs that failed, the first one's.");
    add_parameter_file(sub);
    add_output(sub, "Folder of the sweep", true);
    CLI::Option* parallel =
        sub.add_option("-j,--jobs", arguments_.parallel, "Jobs at a time")->check(positive);
    CLI::Option* status =
        sub.add_flag("--status", arguments_.status, "Only print how far every job is");
    CLI::Option* job =
        sub.add_option("--job", arguments_.job,
                       "Work off the job of this name only, beside other processes that "
                       "work on others");
    CLI::Option* exported =
        sub.add_option("--export", arguments_.export_as,
                       "Work off nothing, but write the sweep into its folder as a workflow of "
                       "snakemake, which runs it here or on Slurm")
            ->check(CLI::IsMember({"snakemake"}));
    job->excludes(parallel)->excludes(status)->excludes(exported);
    exported->excludes(parallel)->excludes(status);
    add_wall_time(sub);
    add_quiet_and_json(sub);
  }
  void add_report() {
    CLI::App& sub =
        add("report", "One HTML page about a prepared state, a run or a sweep.", report_command);
    sub.add_option("run", arguments_.input, "State, run, or folder of a job or a sweep")
        ->required();
    add_output(sub, "Page to write; default <state>.html, <run>.html or <sweep>/report.html",
               false);
    add_analysis_parameters(sub);
    add_quiet_and_json(sub);
  }
  void add_export() {
    CLI::App& sub =
        add("export", "Write a state, a run or results in the format of another program.",
            export_command);
    sub.footer(exit_codes + ", 5 stopped (nothing was written).");
    sub.add_option("file", arguments_.input, "State or run, or results of vitrel analyze")
        ->required();
    sub.add_option(
           "--to", arguments_.format,
           "gsd (HOOMD-blue, OVITO), xyz (OVITO, ASE) or csv; in three dimensions, one period "
           "with all images: geo (Gmsh), vti (voxels for VTK), vtp (points for VTK) or csv; of "
           "results: gnuplot (a folder of data and scripts)")
        ->required();
    add_output(
        sub,
        "File or folder to write, which must not exist; default <file> with the new suffix, or "
        "<results>_gnuplot",
        false);
    sub.add_option("--frames", arguments_.frames,
                   "Which frames, as Python's slices: 7, -1 (the last), first:end:step (all; in "
                   "three dimensions one, the last)");
    sub.add_option("--shrink", arguments_.shrink,
                   "In three dimensions: all semi-axes times this (1), for room between bodies")
        ->check(CLI::Range(1e-3, 1.0));
    sub.add_option("--voxels", arguments_.voxels, "To vti: voxels along the longest edge (100)")
        ->check(CLI::Range(1, 2000));
    add_quiet_and_json(sub);
  }
  void add_bench() {
    CLI::App& bench = *app_.add_subcommand(
        "bench", "Measure the numerical methods against a guaranteed reference.");
    bench.require_subcommand(1);
    CLI::App& time = add(bench, "collision-time",
                         "Speed, accuracy and failures of every way to predict a collision.",
                         bench_collision_time_command);
    add_benchmark(time);
    add_pairs(time, "Pairs of each class (2000); slow methods answer what their time allows",
              "Seconds that a method other than the default may predict (4)");
    add_judging_tolerance(time);
    add_duration(time, "Simulated time of the whole runs on the page (20)");
    CLI::App& solids =
        add(bench, "collision-time-of-solids",
            "The same in three dimensions: ways to predict a collision of ellipsoids.",
            bench_collision_time_of_solids_command);
    add_benchmark(solids, "Folder for the charts and the data as JSON");
    add_pairs(solids, "Pairs of each class (2000); slow methods answer what their time allows",
              "Seconds that a method other than the default may predict (4)");
    add_judging_tolerance(solids);
    CLI::App& overlap = add(bench, "overlap", "Speed and accuracy of every criterion of overlap.",
                            bench_overlap_command);
    add_benchmark(overlap);
    add_pairs(overlap, "Pairs of each class (20000)", "Seconds that a criterion may take (1)");
    CLI::App& thesis =
        add(bench, "thesis", "The figures of the thesis, chapter 4, beside a program like its own.",
            bench_thesis_command);
    add_measured(thesis, "Folder for the charts and the data as JSON");
    thesis
        .add_option("--seconds", arguments_.seconds,
                    "Seconds after which a run of the thesis's program is cut short (1)")
        ->check(positive);
    thesis.add_option("--largest", arguments_.largest, "Largest number of particles (400)")
        ->check(positive);
    thesis.add_option("--runs", arguments_.runs, "Runs that are averaged in figure 4.7 (32)")
        ->check(positive);
    add_duration(thesis, "Simulated time of each run (100)");
    CLI::App& run = add(bench, "whole-run",
                        "The scene of the thesis, run with every method that can carry a run.",
                        bench_whole_run_command);
    add_benchmark(run);
    add_duration(run, "Simulated time of each run (100)");
  }
  void add_judging_tolerance(CLI::App& sub) {
    sub.add_option("--tolerance", arguments_.tolerance,
                   "How far off still counts as correct (1e-8): of the horizon for times, of the "
                   "shortest semi-axis for gaps")
        ->check(positive);
    sub.add_option("--gap-tolerance", arguments_.gap_tolerance,
                   "The same for gaps, if they have another one")
        ->check(positive);
  }
  void add_benchmark(CLI::App& sub, const std::string& folder =
                                        "Folder for the page, its pictures and the rows as JSON") {
    add_measured(sub, folder);
    sub.add_option("--method", arguments_.methods, "Only these methods, by name");
  }
  void add_measured(CLI::App& sub, const std::string& folder) {
    sub.footer(exit_codes + ", 5 stopped (rows of what was done, no files).");
    add_output(sub, folder, false);
    sub.add_option("--seed", arguments_.seed, "Seed of all random numbers (1)");
    add_wall_time(sub);
    add_quiet_and_json(sub);
  }
  void add_pairs(CLI::App& sub, const std::string& pairs, const std::string& seconds) {
    sub.add_option("--pairs", arguments_.pairs, pairs)->check(positive);
    sub.add_option("--seconds", arguments_.seconds, seconds)->check(positive);
    sub.add_option("--class", arguments_.classes, "Only these classes of pairs, by name");
  }
  void add_duration(CLI::App& sub, const std::string& what) {
    sub.add_option("--duration", arguments_.duration, what)->check(positive);
  }
  void add_params() {
    CLI::App& sub =
        add("params", "Print a commented template of a command's parameters.", params_command);
    CLI::Option* of =
        sub.add_option("command", arguments_.template_command, "prepare, run, analyze or sweep");
    sub.add_flag("--reference", arguments_.reference,
                 "All parameters as Markdown (docs/parameters.md)")
        ->excludes(of);
  }

  CLI::App app_;
  Arguments arguments_;
  Chosen chosen_;
};

int complain(const std::string& command, const char* message, ExitCode code) {
  std::cerr << "vitrel " << command << ": " << message << '\n';
  return code;
}

int run_command_line(const CommandLine& line) {
  const std::string command = line.command();
  try {
    return line.run();
  } catch (const UserError& error) {
    return complain(command, error.what(), user_error);
  } catch (const FileError& error) {
    return complain(command, error.what(), file_error);
  } catch (const InvariantError& error) {
    return complain(command, error.what(), broken_invariant);
  } catch (const std::system_error& error) {
    return complain(command, error.what(), file_error);
  } catch (const std::bad_alloc&) {
    return complain(command,
                    "out of memory; fewer particles or a smaller analysis.memory need less",
                    user_error);
  } catch (const std::exception& error) {
    return complain(command, error.what(), defect);
  }
}

}  // namespace
}  // namespace vitrel

int main(int count, char** words) {
  vitrel::CommandLine line;
  if (const std::optional<int> code = line.parse(count, words)) return *code;
  return vitrel::run_command_line(line);
}
