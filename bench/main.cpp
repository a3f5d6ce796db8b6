// vitrel-bench: the command line of all subcommands. The only file here that includes CLI11.
#include <functional>

#include "app/terminal/program_command_line.h"
#include "bench/programs/collision_time.h"
#include "bench/programs/overlap.h"
#include "bench/programs/pair.h"
#include "bench/programs/programs.h"
#include "bench/programs/thesis.h"
#include "bench/programs/whole_run.h"

namespace vitrel::bench {
namespace {

const std::string exit_codes =
    "Exit codes: 0 done, 2 mistake in the command line, 3 a file cannot be read or written";

class CommandLine : public ProgramCommandLine {
 public:
  CommandLine(int count, char** words)
      : ProgramCommandLine(
            "Measures the numerical methods of vitrel against references and baselines.",
            "vitrel-bench") {
    output_.command_line = joined(count, words);
    add_collision_time();
    add_overlap();
    add_pair();
    add_whole_run();
    add_thesis();
    add_parts();
    add_others();
    add_manual();
    add_help_and_version();
  }

 private:
  CLI::App& add(const std::string& name, const std::string& sentence,
                const std::function<int()>& run) {
    CLI::App& sub = add_command(app_, name, sentence, run);
    sub.footer(exit_codes + ".");
    return sub;
  }

  void add_output(CLI::App& sub, const std::string& folder) {
    sub.footer(exit_codes + ", 5 stopped (rows of what was done, no files).");
    sub.add_option("-o,--output", output_.folder, folder);
    sub.add_option("--wall-time", output_.wall_time,
                   "Stop cleanly after this many seconds (exit code 5)")
        ->check(not_negative);
    add_print(sub);
  }
  void add_print(CLI::App& sub) {
    sub.add_flag("-q,--quiet", output_.quiet, "No progress and no table");
    sub.add_flag("--json", output_.json, "Rows as JSON on standard output");
  }
  /// Options that several comparisons have, in the struct of this one.
  template <class Options>
  void add_seed(CLI::App& sub, Options& options) {
    sub.add_option("--seed", options.seed, "Seed of all random numbers (1)");
  }
  template <class Options>
  void add_methods(CLI::App& sub, Options& options) {
    sub.add_option("--method", options.methods, "Only these methods, by name");
  }
  template <class Options>
  void add_pairs(CLI::App& sub, Options& options, const std::string& pairs,
                 const std::string& seconds) {
    sub.add_option("--pairs", options.pairs, pairs)->check(positive);
    sub.add_option("--seconds", options.seconds, seconds)->check(positive);
    sub.add_option("--class", options.classes, "Only these classes of pairs, by name");
  }
  template <class Options>
  void add_duration(CLI::App& sub, Options& options, const std::string& what) {
    sub.add_option("--duration", options.duration, what)->check(positive);
  }

  void add_collision_time_options(CLI::App& sub) {
    add_output(sub, "Folder for the page and its data as JSON");
    add_seed(sub, collision_time_);
    add_methods(sub, collision_time_);
    add_pairs(sub, collision_time_,
              "Pairs of each class (2000); slow methods answer what their time allows",
              "Seconds that a method other than the default may predict (4)");
    sub.add_option_function<double>(
           "--tolerance",
           [this](double allowed) {
             collision_time_.allowed = {allowed, allowed};
           },
           "How far off still counts as correct (1e-8): of the horizon for times, of the shortest "
           "semi-axis for gaps")
        ->check(positive)
        ->trigger_on_parse();
    sub.add_option_function<double>(
           "--gap-tolerance", [this](double allowed) { collision_time_.allowed.gap = allowed; },
           "The same for gaps, if they have another one")
        ->check(positive);
  }
  void add_collision_time() {
    CLI::App& ellipses =
        add("collision-time", "Speed, accuracy and failures of every collision-time method.",
            [this] { return collision_time(collision_time_, output_); });
    add_collision_time_options(ellipses);
    add_duration(ellipses, collision_time_, "Simulated time of the whole runs on the page (20)");
    CLI::App& solids =
        add("collision-time-of-ellipsoids", "The same in three dimensions, for ellipsoids.",
            [this] { return collision_time_of_ellipsoids(collision_time_, output_); });
    solids.alias("collision-time-of-solids");
    add_collision_time_options(solids);
  }
  void add_overlap() {
    CLI::App& sub = add("overlap", "Speed and accuracy of every overlap criterion.",
                        [this] { return overlap(overlap_, output_); });
    add_output(sub, "Folder for the page and its data as JSON");
    add_seed(sub, overlap_);
    add_methods(sub, overlap_);
    add_pairs(sub, overlap_, "Pairs of each class (20000)",
              "Seconds that a criterion may take (1)");
  }
  void add_pair() {
    CLI::App& sub = add("pair", "The contact time of one pair by every method.",
                        [this] { return pair(pair_, output_); });
    sub.add_option("pair", pair_.pair,
                   "Both bodies as TOML text; vitrel pair contact-time --all-methods passes it")
        ->required();
    add_methods(sub, pair_);
    add_print(sub);
  }
  void add_whole_run() {
    CLI::App& sub =
        add("whole-run", "The scene of the thesis, run with every method that can complete it.",
            [this] { return whole_run(whole_run_, output_); });
    add_output(sub, "Folder for the page and its data as JSON");
    add_seed(sub, whole_run_);
    add_methods(sub, whole_run_);
    add_duration(sub, whole_run_, "Simulated time of each run (100)");
  }
  void add_thesis() {
    CLI::App& sub = add(
        "thesis", "The figures of chapter 4 of the thesis, compared with a program like its own.",
        [this] { return thesis(thesis_, output_); });
    add_output(sub, "Folder for the data as JSON; scripts/draw_bench draws them");
    add_seed(sub, thesis_);
    sub.add_option("--seconds", thesis_.seconds,
                   "Seconds after which a run of the thesis's program ends (1)")
        ->check(positive);
    sub.add_option("--largest", thesis_.largest, "Largest number of particles (400)")
        ->check(positive);
    sub.add_option("--runs", thesis_.relaxations, "Runs that are averaged in figure 4.7 (32)")
        ->check(positive);
    add_duration(sub, thesis_, "Simulated time of each run (100)");
  }

  void add_in_parts(CLI::App& sub, PartsOptions& options) {
    sub.add_option("part", options.parts, "What to measure; all parts if none is named");
    sub.add_flag("--quick", options.quick, "Short test run");
  }
  void add_parts() {
    CLI::App& speed =
        add("engine", "How fast is the engine, and what is the speed-up by each optimisation?",
            [this] { return engine(engine_); });
    add_in_parts(speed, engine_);
    speed.add_option("--stretch", engine_.stretch, "Seconds of one repeat")->check(positive);
    speed.add_option("--largest", engine_.largest, "Number of particles (1000000)")
        ->check(positive);
    for (const auto& [name, sentence, run] :
         {std::tuple("event-chain", "Do event chains decorrelate states faster than local moves?",
                     &event_chain),
          std::tuple("exchanges",
                     "How long does each method take to forget a dense polydisperse liquid?",
                     &exchanges),
          std::tuple("sampler", "How fast is Monte Carlo sampling?", &sampler),
          std::tuple("soft-spheres",
                     "Dynamics of soft spheres: accuracy, speed, cooling, conservation.",
                     &soft_spheres),
          std::tuple("ellipsoids", "Speed and pressure of the engine in three dimensions.",
                     &ellipsoids)})
      add_in_parts(add(name, sentence, [this, run = run] { return run(parts_); }), parts_);
    app_.get_subcommand("ellipsoids")->alias("solids");
  }
  void add_others() {
    CLI::App& queue = add("calendar", "What does an event cost with each calendar?",
                          [this] { return calendar(calendar_); });
    queue.add_option("largest", calendar_.largest, "Largest number of particles (1000000)");
    queue
        .add_option("--repeats", calendar_.repeats, "Repetitions of every run; the best counts (5)")
        ->check(positive);
    CLI::App& prediction =
        add("first-contact", "What does a prediction of the default method cost?",
            [this] { return first_contact_time(first_contact_); });
    prediction.add_option("class", first_contact_.name, "Class of pairs (generic)");
    prediction.add_option("aspect_ratio", first_contact_.aspect_ratio,
                          "Aspect ratio of the class (2)");
    prediction.add_option("--pairs", first_contact_.pairs, "Number of pairs (4000)")
        ->check(positive);
    prediction
        .add_option("--repeats", first_contact_.repeats, "Repetitions; the fastest counts (15)")
        ->check(positive);
    CLI::App& arrays = add("pair-arrays", "How fast are overlaps and first contacts of many pairs?",
                           [this] { return pair_arrays(pair_arrays_); });
    arrays.add_option("file", pair_arrays_.file, "8 doubles for each body, two bodies a pair")
        ->required();
    arrays.add_option("--horizon", pair_arrays_.horizon, "Of first contacts (10)")->check(positive);
    add("structure-factor", "The structure factor by Fourier transform beside the direct sum.",
        structure_factor);
    add("analysis-growth", "How does the cost of analysing motion grow?", [this] {
      return analysis_growth(parts_.quick);
    }).add_flag("--quick", parts_.quick, "A tenth of the frames: to see that it works");
    add("restitution", "How accurate and how fast is the restitution matrix?", [this] {
      return restitution(parts_.quick);
    }).add_flag("--quick", parts_.quick, "Few points: to see that it works");
  }

  OutputOptions output_;
  CollisionTimeOptions collision_time_;
  OverlapOptions overlap_;
  PairMethodsOptions pair_;
  WholeRunOptions whole_run_;
  ThesisOptions thesis_;
  PartsOptions parts_;
  EngineSpeedOptions engine_;
  CalendarOptions calendar_;
  FirstContactOptions first_contact_;
  PairArraysOptions pair_arrays_;
};

}  // namespace
}  // namespace vitrel::bench

int main(int count, char** words) {
  return vitrel::bench::CommandLine(count, words).execute(count, words);
}
