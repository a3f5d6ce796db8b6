// vitrel-bench: the command line of all studies. Only this file of bench includes CLI11.
#include <functional>

#include "app/terminal/program_command_line.h"
#include "bench/programs/pair.h"
#include "bench/studies/runner.h"

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
    for (const Study& study : studies()) {
      add_study(study, study.name, study.question, study.defaults);
      for (const Alias& alias : study.aliases) add_alias(study, alias);
    }
    add_pair();
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

  void add_print(CLI::App& sub, const std::string& what) {
    sub.add_flag("-q,--quiet", output_.quiet, "No progress and no table");
    sub.add_flag("--json", output_.json, what + " as JSON on standard output");
  }
  void add_methods(CLI::App& sub, std::vector<std::string>& methods) {
    sub.add_option("--method", methods, "Only these methods, by name");
  }

  void add_alias(const Study& study, const Alias& alias) {
    StudyOptions defaults = study.defaults;
    defaults.parts = alias.parts;
    add_study(
        study, alias.name,
        fmt::format("Older name of {}{}.", study.name,
                    alias.parts.empty() ? "" : fmt::format(" {}", fmt::join(alias.parts, " "))),
        defaults);
  }

  /// Adds a number that has a default, which the sentence states.
  template <class Number>
  void add_number(CLI::App& sub, const std::string& name, Number& number, const std::string& what) {
    if (number > 0)
      sub.add_option(name, number, fmt::format("{} ({:g})", what, static_cast<double>(number)))
          ->check(positive);
  }

  void add_study(const Study& study, const std::string& name, const std::string& sentence,
                 const StudyOptions& defaults) {
    StudyOptions& options = *options_.emplace_back(std::make_unique<StudyOptions>(defaults));
    CLI::App& sub = add(name, sentence,
                        [this, &study, &options] { return run_study(study, options, output_); });
    sub.footer(exit_codes + ", 5 stopped (tables of what was done, no files).");
    std::vector<std::string> parts;
    for (const Part& part : study.parts) parts.push_back(part.name);
    sub.add_option("part", options.parts,
                   fmt::format("What to measure, if not all: {}", fmt::join(parts, ", ")));
    sub.add_option(
        "-o,--output", output_.file,
        "The page (.html), the tables (.md) or the numbers (.json), or a folder for all three");
    sub.add_option("--wall-time", output_.wall_time,
                   "Stop cleanly after this many seconds (exit code 5)")
        ->check(not_negative);
    add_print(sub, "Numbers");
    if (study.has_quick)
      sub.add_flag("--quick", options.quick, "Few particles, short runs: to see that it works");
    sub.add_option("--seed", options.seed, "Seed of all random numbers (1)");
    if (std::ranges::any_of(study.parts,
                            [](const Part& part) { return !part.method_names.empty(); }))
      add_methods(sub, options.methods);
    if (std::ranges::any_of(study.parts,
                            [](const Part& part) { return !part.class_names.empty(); }))
      sub.add_option("--class", options.classes, "Only these classes of cases, by name");
    add_number(sub, "--pairs", options.pairs,
               "Pairs of each class; slow methods answer what their time allows");
    add_number(sub, "--seconds", options.seconds, "Seconds that a method may take");
    add_number(sub, "--duration", options.duration, "Simulated time of a run");
    if (!study.has_tolerance) return;
    sub.add_option("--tolerance", options.tolerance,
                   "How far off still counts as correct: of the horizon for times (1e-8, in space "
                   "1e-12), of the shortest "
                   "semi-axis for gaps (1e-8)")
        ->check(positive);
    sub.add_option("--gap-tolerance", options.gap_tolerance,
                   "The same for gaps, if they have another one")
        ->check(positive);
  }

  void add_pair() {
    CLI::App& sub = add("pair", "The contact time of one pair by every method.",
                        [this] { return pair(pair_, output_); });
    sub.add_option("pair", pair_.pair,
                   "Both bodies as TOML text; vitrel pair contact-time --all-methods passes it")
        ->required();
    add_methods(sub, pair_.methods);
    add_print(sub, "Rows");
  }

  OutputOptions output_;
  PairMethodsOptions pair_;
  std::vector<std::unique_ptr<StudyOptions>> options_;
};

}  // namespace
}  // namespace vitrel::bench

int main(int count, char** words) {
  vitrel::bench::CommandLine command_line(count, words);
  if (count != 1) return command_line.execute(count, words);
  std::string help = "help";  // without a word, help prints the list of the studies
  char* with_help[] = {words[0], help.data(), nullptr};
  return command_line.execute(2, with_help);
}
