
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "analysis/observables/observable.h"
#include "app/commands/commands.h"
#include "app/terminal/program_command_line.h"
#include "app/terminal/program_description.h"
#include "core/error.h"
#include "core/io/foreign/foreign_formats.h"
#include "workflow/configuration/sections.h"
#include "workflow/export/trajectory_export.h"
#include "workflow/picture/colours.h"
#include "workflow/sweep/sweep_export.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

const std::string exit_codes =
    "Exit codes: 0 done, 2 mistake in parameters or command line, 3 a file cannot be read or "
    "written";
const std::string overlap_code = ", 4 overlap or another broken invariant";
const std::string stopped_code = ", 5 stopped (nothing was written).";
const std::string resumed_code = ", 5 stopped (the same command continues)";

const CLI::Validator names_of_tables = {[](const std::string& names) {
                                          try {
                                            TableChoice{names};
                                          } catch (const UserError& error) {
                                            return std::string(error.what());
                                          }
                                          return std::string();
                                        },
                                        ""};

void add_print(CLI::App& sub, PrintOptions& print) {
  sub.add_flag("-q,--quiet", print.quiet, "No progress and no summary");
  sub.add_flag("--json", print.json, "Summary as JSON on standard output");
}

void add_overrides(CLI::App& sub, std::vector<std::string>& overrides, const std::string& example) {
  sub.add_option("--set", overrides,
                 "Value of a key, instead of that in the file: --set " + example)
      ->take_all()
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
}

void add_wall_time(CLI::App& sub, double& seconds) {
  sub.add_option("--wall-time", seconds, "Stop cleanly after this many seconds (exit code 5)")
      ->check(not_negative);
}

CLI::Option* add_file(CLI::App& sub, const std::string& name, fs::path& file,
                      const std::string& what) {
  return sub.add_option(name, file, what)->type_name(file_value);
}

CLI::Option* add_output(CLI::App& sub, fs::path& output, const std::string& what) {
  return add_file(sub, "-o,--output", output, what)->check(not_empty);
}

void add_parameter_file(CLI::App& sub, ParameterOptions& source) {
  add_file(sub, "params", source.file, "Parameter file (TOML); vitrel params prints one")
      ->required();
  add_overrides(sub, source.overrides, "dynamics.duration=10");
  sub.add_option("--seed", source.seed,
                 "Seed of all random numbers, the same as --set system.seed=")
      ->check(seed_number);
}

void add_start(CLI::App& sub, StartOptions& start) {
  CLI::Option* from =
      add_file(sub, "--from", start.from,
               "State or run whose last frame to start from: " + foreign_format_names() +
                   ". Stages of the parameter file follow if the first of them moves particles");
  sub.add_flag("--shrink", start.shrink,
               "With --from: scale all particles until none overlap, as after single precision")
      ->needs(from);
}

void add_threads(CLI::App& sub, int& threads, const std::string& what) {
  sub.add_option("--threads", threads, what + "; the results do not depend on it")->check(positive);
}

void add_analysis(CLI::App& sub, AnalysisOptions& analysis) {
  add_file(sub, "--params", analysis.file,
           "Parameter file with [analysis], instead of that in the run, and with [import]");
  add_overrides(sub, analysis.overrides, "analysis.longest_lag=0.1");
}

void add_import(CLI::App& sub, AnalysisOptions& import) {
  add_file(sub, "--params", import.file,
           "Parameter file with [import] and [[species]]: what a file of another program does not "
           "say");
  add_overrides(sub, import.overrides, "import.unwrap=nearest");
}

std::vector<std::string> all_formats() {
  std::vector<std::string> names;
  for (const ExportFormat& format : export_formats()) names.push_back(format.name);
  return names;
}

/// The options of all commands. Only those of the chosen command are filled.
class CommandLine : public ProgramCommandLine {
 public:
  CommandLine(int count, char** words)
      : ProgramCommandLine(
            "Simulation of hard anisotropic particles, from the liquid to the glass.", "vitrel") {
    prepare_.command_line = run_.command_line = pair_.command_line = impact_.command_line =
        joined(count, words);
    const auto end = words + count;
    const auto called = std::find_if(words + std::min(count, 1), end,
                                     [](const char* word) { return *word != '-'; });
    if (called != end) called_ = *called;
    add_prepare();
    add_run();
    add_check();
    add_analyze();
    add_sweep();
    add_report();
    add_export();
    add_picture();
    add_pair();
    add_bench();
    add_params();
    add_completion();
    add_manual();
    add_help_and_version();
    app_.footer(
        "vitrel help <command> lists the options of a command. On a terminal errors are red, "
        "unless NO_COLOR is set.");
  }

 private:
  template <class Options>
  CLI::App& add(const std::string& name, const std::string& sentence, int (*work)(const Options&),
                const Options& options) {
    return add_below(app_, name, sentence, work, options);
  }
  template <class Options>
  CLI::App& add_below(CLI::App& parent, const std::string& name, const std::string& sentence,
                      int (*work)(const Options&), const Options& options) {
    CLI::App& sub = add_command(parent, name, sentence, [work, &options] { return work(options); });
    sub.footer(exit_codes + ".");
    return sub;
  }

  /// Options take long to create, so those of other commands exist only for texts about all commands.
  bool needs_options(const CLI::App& command) const {
    return command.get_name() == called_ || called_ == "help" || called_ == "man" ||
           called_ == "completion";
  }

  void add_prepare() {
    CLI::App& sub =
        add("prepare", "Make a first state and report how good it is.", prepare_command, prepare_);
    add_work(sub, prepare_,
             "State file to write, with its quality report <state>.quality.json beside it",
             "Threads for Monte Carlo (1)");
  }

  void add_run() {
    CLI::App& sub =
        add("run", "Start or continue an event-driven run; without --from, prepare first.",
            run_command, run_);
    add_work(sub, run_, "Trajectory to write, with its checkpoint beside it",
             "Threads for the Brownian steps and for Monte Carlo in the preparation (1)");
  }

  void add_work(CLI::App& sub, PrepareOptions& options, const std::string& output,
                const std::string& threads) {
    if (!needs_options(sub)) return;
    sub.footer(exit_codes + overlap_code + resumed_code + ".");
    add_parameter_file(sub, options.source);
    add_output(sub, options.output, output)->required();
    add_start(sub, options.start);
    sub.add_flag("--dry-run", options.dry_run, "Print what would be done");
    add_threads(sub, options.threads, threads);
    add_wall_time(sub, options.wall_time);
    add_print(sub, options.print);
  }

  void add_check() {
    CLI::App& sub = add("check", "Exact check of a state or of all frames of a run for overlaps.",
                        check_command, check_);
    if (!needs_options(sub)) return;
    sub.footer(exit_codes + overlap_code + ", 5 stopped (no overlap so far).");
    add_file(sub, "file", check_.input, "State or run")->required();
    add_import(sub, check_.import);
    sub.add_flag("--last", check_.last_only, "The last frame only");
    add_print(sub, check_.print);
  }

  void add_analyze() {
    CLI::App& sub = add("analyze",
                        "Structure, motion, energies and pressure of a run. Of a sweep, relaxation "
                        "times and the glass transition, from the results of its jobs, or with "
                        "--params or --set from their runs.",
                        analyze_command, analyze_);
    if (!needs_options(sub)) return;
    sub.footer(exit_codes + stopped_code);
    CLI::Option* run = add_file(sub, "run", analyze_.input, "Run, or folder of a job or a sweep");
    sub.add_flag("--list", analyze_.list, "All tables as Markdown (docs/observables.md)")
        ->excludes(run);
    add_output(sub, analyze_.output,
               "Results to write (HDF5, with CSV tables in a folder beside it); default "
               "<run>_results.h5 or "
               "<sweep>/results.h5");
    add_analysis(sub, analyze_.analysis);
    sub.add_option_function<std::string>(
           "--only",
           [this](const std::string& tables) {
             analyze_.analysis.overrides.push_back("analysis.only=\"" + tables + '"');
           },
           "Only these tables of --list, separated by commas: msd,fs")
        ->check(names_of_tables)
        ->type_name("TABLES");
    add_print(sub, analyze_.print);
  }

  void add_sweep() {
    CLI::App& sub =
        add("sweep",
            "Run all jobs of [sweep]: prepare, run, analyze. If no key of [dynamics] is "
            "given, a job is a state (a packing) and there is no run. Jobs that differ "
            "in system.seed only are averaged.",
            sweep_command, sweep_);
    if (!needs_options(sub)) return;
    sub.footer(exit_codes + overlap_code + resumed_code +
               "; of jobs that failed, the first one's.");
    add_parameter_file(sub, sweep_.source);
    add_output(sub, sweep_.output, "Folder of the sweep")->required()->type_name(folder_value);
    CLI::Option* parallel =
        sub.add_option("-j,--jobs", sweep_.parallel, "Jobs at a time")->check(positive);
    CLI::Option* status =
        sub.add_flag("--status", sweep_.status,
                     "Only print how far every job is, and what has changed in the file since");
    CLI::Option* dry_run = sub.add_flag("--dry-run", sweep_.dry_run,
                                        "Print the jobs and what they are expected to cost");
    dry_run->excludes(status);
    CLI::Option* job = sub.add_option(
        "--job", sweep_.job, "Run this job only; other processes may run other jobs meanwhile");
    std::vector<std::string> programs;
    std::string sentence =
        "Run nothing; write the sweep into its folder, where another program runs it";
    for (const SweepExport& to : sweep_exports()) {
      programs.emplace_back(to.name);
      sentence += fmt::format("; {}: {}", to.name, to.use);
    }
    CLI::Option* exported =
        add_choice(sub, "--export", sweep_.export_as, programs, "PROGRAM", sentence);
    job->excludes(parallel)->excludes(status)->excludes(exported);
    exported->excludes(status)->excludes(dry_run);
    add_wall_time(sub, sweep_.wall_time);
    add_print(sub, sweep_.print);
  }

  void add_report() {
    CLI::App& sub = add("report", "One HTML page about a prepared state, a run or a sweep.",
                        report_command, report_);
    if (!needs_options(sub)) return;
    sub.footer(exit_codes + stopped_code);
    add_file(sub, "run", report_.input, "State, run, or folder of a job or a sweep")->required();
    add_output(sub, report_.output,
               "Page to write; default <state>.html, <run>.html or <sweep>/report.html");
    add_analysis(sub, report_.analysis);
    add_print(sub, report_.print);
  }

  void add_export() {
    CLI::App& sub = add("export", "Write a state or a run in the format of another program.",
                        export_command, export_);
    if (!needs_options(sub)) return;
    sub.footer(exit_codes + stopped_code);
    add_file(sub, "file", export_.input, "State or run")->required();
    add_choice(
        sub, "--to", export_.format, all_formats(), "FORMAT",
        "gsd (HOOMD-blue, OVITO), xyz (OVITO, ASE) or csv; in two dimensions also xytheta (plain "
        "text, a line of t and all x, y, angle per frame); in three dimensions also one period "
        "with all images: geo (Gmsh), vti (voxels for VTK) or vtp (points for VTK; of several "
        "frames a folder with a .pvd file for ParaView)")
        ->transform([](std::string name) { return name == "thesis" ? "xytheta" : name; })
        ->required();
    add_import(sub, export_.import);
    add_output(sub, export_.output,
               "File or folder to write, which must not exist; default <file> with the new suffix "
               "(.dat for xytheta), or <file>_vtp for several frames");
    sub.add_option("--frames", export_.frames,
                   "Which frames, as Python's slices: 7, -1 (the last), first:end:step (all; to "
                   "geo, to vti and with --images one, the last)");
    sub.add_flag("--images", export_.images,
                 "To csv in three dimensions: one period of a frame with all images, a line per "
                 "body that meets the box, instead of a line per frame and particle");
    sub.add_option("--shrink", export_.shrink,
                   "With all images: all semi-axes times this (1), for room between bodies")
        ->check(between(1e-3, 1));
    sub.add_option("--voxels", export_.voxels, "To vti: voxels along the longest edge (100)")
        ->check(between(1, 2000));
    add_print(sub, export_.print);
  }

  void add_picture() {
    CLI::App& sub = add("picture", "Draw a state or a frame of a run, or make a film of a run.",
                        picture_command, picture_);
    if (!needs_options(sub)) return;
    sub.footer(exit_codes + stopped_code);
    add_file(sub, "file", picture_.input, "State or run")->required();
    add_import(sub, picture_.import);
    add_output(sub, picture_.output,
               "Picture to write: .png or, in two dimensions, .svg; or a film, .mp4, for which the "
               "program ffmpeg must be installed; default <file>.png");
    sub.add_option("--frames,--frame", picture_.frames,
                   "Which frames, as Python's slices: 7, -1 (the last), first:end:step; a picture "
                   "shows one (the last), a film several (all)");
    add_choice(sub, "--colour", picture_.colouring, colourings(), "COLOURING",
               "What colours mean: orientation, species, size, displacement (from the first "
               "frame), or in two dimensions psi6 (hexatic order); default orientation, or species "
               "if all particles are round");
    sub.add_option("--width", picture_.width, "Pixels (1000)")->check(between(2, 20'000));
    sub.add_option("--azimuth", picture_.azimuth,
                   "In three dimensions: where the camera is, degrees from x about z (304)")
        ->check(between(-360, 360));
    sub.add_option("--elevation", picture_.elevation, "The same, degrees above the xy plane (24)")
        ->check(between(-90, 90));
    sub.add_flag("--whole", picture_.whole,
                 "In three dimensions: every particle once and whole, instead of all images cut at "
                 "the faces of the box");
    sub.add_option("--rate", picture_.rate, "Of a film: frames per second (25)")
        ->check(between(0.1, 1000));
    add_print(sub, picture_.print);
  }

  CLI::App& add_pair_question(CLI::App& pair, const std::string& name, const std::string& sentence,
                              int (*work)(const PairOptions&)) {
    CLI::App& sub = add_below(pair, name, sentence, work, pair_);
    CLI::Option* file =
        add_file(sub, "file", pair_.source.file,
                 "Both bodies (TOML), instead of --body; vitrel params pair prints one");
    sub.add_option("--body", pair_.source.bodies,
                   "A body, given twice: 'semi_axes=2,1 position=3,0 angle=0.5 velocity=-1,0 "
                   "angular_velocity=0.2', or in space three semi-axes and orientation=w,x,y,z")
        ->take_all()
        ->allow_extra_args(false)
        ->excludes(file);
    sub.add_option("--box", pair_.source.box,
                   "Sides Lx,Ly or Lx,Ly,Lz of a periodic box, for all images of the second body");
    add_overrides(sub, pair_.source.overrides, "body.1.angle=0.3");
    add_print(sub, pair_.print);
    return sub;
  }

  void add_pair() {
    CLI::App& pair = add_command(
        app_, "pair",
        "Two bodies: overlap, gap, contact time and path of ellipses or ellipsoids, and the "
        "restitution coefficients of soft spheres.",
        {});
    if (!needs_options(pair)) return;
    pair.require_subcommand(1);
    add_pair_question(pair, "overlap", "Do two bodies overlap? The exact criterion.",
                      pair_overlap_command);
    add_pair_question(pair, "gap", "Distance of two bodies, its direction and its ends.",
                      pair_gap_command);
    CLI::App& contact = add_pair_question(pair, "contact-time",
                                          "When and where two bodies in free flight first touch.",
                                          pair_contact_time_command);
    contact.add_option("--horizon", pair_.source.horizon, "Search until this time (100)");
    add_rotation(contact);
    contact.add_option("--method", pair_.methods, "Compare this method of vitrel-bench")
        ->take_all()
        ->allow_extra_args(false);
    contact.add_flag("--all-methods", pair_.all_methods, "Compare all methods of vitrel-bench");
    CLI::App& path = add_pair_question(
        pair, "path",
        "Gap and contact functions of two bodies in free flight against time, with their first "
        "contact: a table or a page of charts.",
        pair_path_command);
    path.add_option("--until", pair_.until,
                    "From 0 to this time (until the bodies have met and parted)")
        ->check(positive);
    path.add_option("--points", pair_.points, "Evenly spaced times (1000)")->check(between(2, 1e6));
    add_rotation(path);
    add_output(path, pair_.output, "File to write: .csv, .h5 or .html");
    add_restitution(pair);
  }

  void add_rotation(CLI::App& sub) {
    add_choice(sub, "--rotation", pair_.source.rotation,
               {std::begin(rotation_names), std::end(rotation_names)}, "ROTATION",
               "Of ellipsoids with three different semi-axes: euler, or constant for a "
               "constant angular velocity");
  }

  void add_restitution(CLI::App& pair) {
    CLI::App& sub = add_below(
        pair, "restitution",
        "Restitution coefficients of an impact of two soft spheres, integrated and from the table.",
        pair_restitution_command, impact_);
    add_file(sub, "params", impact_.source.file, "Parameter file with [dynamics.contact]");
    add_overrides(sub, impact_.source.overrides,
                  "youngs_modulus='1 GPa'; keys of [dynamics.contact]");
    sub.add_option("--speed", impact_.source.speed,
                   "Relative speed, '5 m/s' (the thermal_speed of the parameters)");
    sub.add_option("--impact-parameter", impact_.source.impact_parameter,
                   "Over the sum of the radii, the sine of the impact angle: from 0, head-on (0), "
                   "to below 1");
    sub.add_option("--second-radius", impact_.source.second_radius,
                   "Radius of the second sphere, '0.12 m' (that of the first)");
    add_file(sub, "--table", impact_.table,
             "File to write the tabulated coefficients of this pair to, for many speeds and "
             "impact parameters: .csv, .h5, or .html for a page of colour maps");
    add_file(
        sub, "--scaled-table", impact_.scaled_table,
        "The same of all materials of this law in scaled variables, elastic and at five values "
        "of the damping: .csv, .h5 or .html");
    add_file(
        sub, "--paths", impact_.paths,
        "Paths of both spheres, integrated and by the rules of hard and of soft spheres: .csv, "
        ".h5 or .html");
    add_print(sub, impact_.print);
  }

  // This entry is for the help only: run_command_line passes the words after `bench` on without parsing them.
  void add_bench() {
    add_command(
        app_, "bench",
        "Measure the numerical methods against an independent reference: runs vitrel-bench, "
        "which is built beside this program.",
        {})
        .footer("vitrel bench --help lists what it measures.");
  }

  void add_params() {
    CLI::App& sub = add("params", "Print a commented template of a command's parameters.",
                        params_command, params_);
    if (!needs_options(sub)) return;
    CLI::Option* of = add_choice(sub, "command", params_.command, commands_with_templates(),
                                 "COMMAND", "prepare, run, analyze, sweep or pair");
    CLI::Option* reference = sub.add_flag("--reference", params_.reference,
                                          "All parameters as Markdown (docs/parameters.md)");
    sub.add_flag("--python", params_.python, "All parameters as classes of the Python package")
        ->excludes(of)
        ->excludes(reference->excludes(of));
  }

  void add_completion() {
    CLI::App& sub = add_command(app_, "completion",
                                "Print a script by which a shell completes what you type.", [this] {
                                  return print(shell_ == "bash" ? bash_completion(description())
                                                                : zsh_completion(description()));
                                });
    if (!needs_options(sub)) return;
    sub.footer(
        "For the running shell: source <(vitrel completion bash). For all, put that line into "
        "~/.bashrc, or into ~/.zshrc with zsh instead of bash, after compinit.");
    add_choice(sub, "shell", shell_, {"bash", "zsh"}, "SHELL", "bash or zsh")->required();
  }

  PrepareOptions prepare_;
  RunOptions run_;
  CheckOptions check_;
  AnalyzeOptions analyze_;
  SweepOptions sweep_;
  ReportOptions report_;
  ExportOptions export_;
  PictureOptions picture_;
  PairOptions pair_;
  ImpactOptions impact_;
  ParamsOptions params_;
  std::string shell_;   ///< argument of `completion`
  std::string called_;  ///< name of the command; empty if there is none
};

}  // namespace

int run_command_line(int count, char** words) {
  if (count > 1 && std::string_view(words[1]) == "bench") return bench_command(words + 1);
  return CommandLine(count, words).execute(count, words);
}

}  // namespace vitrel
