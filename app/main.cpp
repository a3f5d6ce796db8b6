#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include "app/commands/commands.h"
#include "app/terminal/help.h"
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
    arguments_.command_line = joined(count, words);
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
    CLI::App& sub = *app_.add_subcommand(name, sentence);
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
  void add_bench() {  // for the help alone: main passes it on before anything is parsed
    app_.add_subcommand("bench",
                        "Measure the numerical methods against a guaranteed reference: runs "
                        "vitrel-bench, which is built beside this program.");
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

}  // namespace
}  // namespace vitrel

int main(int count, char** words) {
  if (count > 1 && std::string_view(words[1]) == "bench") return vitrel::bench_command(words + 1);
  vitrel::CommandLine line;
  if (const std::optional<int> code = line.parse(count, words)) return *code;
  return vitrel::exit_code_of("vitrel " + line.command(), [&] { return line.run(); });
}
