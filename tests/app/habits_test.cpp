// Habits that users bring along: help and suggestions, completion, a manual page, colour, lines that fit a terminal.
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "app/terminal/text_lines.h"
#include "core/io/h5md.h"
#include "tests/app/end_to_end.h"

namespace vitrel {
namespace {

using testing::Contains;
using testing::IsSupersetOf;
using testing_program::run_on_terminal;

const std::string small_system =
    "[system]\nparticles = 30\n[dynamics]\nequilibration = 0\nduration = 5\n"
    "[output]\nsamples = { spacing = \"linear\", interval = 0.5 }\n";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The words that begin the entries below a heading of the help.
std::vector<std::string> entries_below(const std::string& heading, const std::string& help) {
  std::vector<std::string> words;
  bool is_below = false;
  for (const std::string& line : lines_of(help)) {
    if (line.empty() || line.front() != ' ') is_below = line == heading;
    const bool begins = line.starts_with("  ") && line[2] != ' ';
    if (is_below && begins) words.push_back(line.substr(2, line.find_first_of(" ", 2) - 2));
  }
  return words;
}

class HabitsTest : public testing::Test {
 protected:
  std::string output_of(const std::string& command) const {
    const Outcome outcome = folder.run(command);
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
    EXPECT_EQ(outcome.errors, "");
    return outcome.output;
  }
  std::string help_of(const std::string& command) const { return output_of("help " + command); }
  /// Those of the program, or of a command that has some.
  std::vector<std::string> commands(const std::string& parent = "") const {
    return entries_below("Commands:", help_of(parent));
  }
  /// Each by its words, such as "pair gap".
  std::vector<std::string> all_commands() const {
    std::vector<std::string> all;
    for (const std::string& command : commands()) {
      all.push_back(command);
      for (const std::string& below : commands(command)) all.push_back(command + " " + below);
    }
    return all;
  }
  /// The names of the options of a command, each dash included.
  std::set<std::string> options_of(const std::string& command) const {
    std::set<std::string> names;
    for (const std::string& entry : entries_below("Options:", help_of(command))) {
      std::istringstream parts(entry);
      for (std::string name; std::getline(parts, name, ',');) names.insert(name);
    }
    return names;
  }
  /// That message alone.
  void expect_refusal(const std::string& command, const std::string& errors) const {
    const Outcome outcome = folder.run(command);
    EXPECT_EQ(outcome.code, 2) << command;
    EXPECT_EQ(outcome.errors, errors + "\n");
    EXPECT_EQ(outcome.output, "");
  }
  std::string shown_on_terminal(const std::string& command,
                                const std::map<std::string, std::string>& environment = {}) const {
    return run_on_terminal(folder.path(), words_of(command), environment).output;
  }

  const Folder folder{"habits", small_system};
};

// ---- help, version, suggestions ---------------------------------------------------------------------

TEST_F(HabitsTest, HelpAndVersionAreCommandsAndOptions) {
  EXPECT_EQ(output_of("help"), output_of("--help"));
  EXPECT_EQ(output_of("version"), output_of("--version"));
  EXPECT_THAT(commands(),
              IsSupersetOf({"prepare", "run", "check", "analyze", "sweep", "report", "export",
                            "pair", "params", "picture", "completion", "man", "help", "version"}));
  EXPECT_THAT(commands("pair"),
              ElementsAre("overlap", "gap", "contact-time", "path", "restitution"));
  for (const std::string& command : all_commands()) {
    const std::string help = help_of(command);
    EXPECT_THAT(help, HasSubstr("Usage: vitrel " + command));
    if (!command.starts_with("bench")) {  // whose own help is that of vitrel-bench
      EXPECT_EQ(help, output_of(command + " --help"));
    }
    for (const std::string& line : lines_of(help)) EXPECT_LE(columns(line), line_width) << line;
  }
}

TEST_F(HabitsTest, TextThatCannotBePrintedIsAnError) {
  for (const char* command : {"--help", "--version", "run --help", "help", "help run", "version",
                              "man", "completion bash", "analyze --list", "params run",
                              "params --reference", "params --python"}) {
    SCOPED_TRACE(command);
    testing_program::expect_refusal(
        testing_program::run_on_full_disk(folder.path(), words_of(command)), 3,
        "standard output: cannot be written: No space left on device");
  }
}

TEST_F(HabitsTest, AMisspeltWordComesWithTheNearest) {
  for (const auto& [command, errors] :
       {std::pair("anaylze run.h5 -o a.h5",
                  "vitrel: 'anaylze' is no command; did you mean 'analyze'?"),
        {"pair overlp --body semi_axes=2,1",
         "vitrel pair: 'overlp' is no command; did you mean 'overlap'?"},
        {"help reprot", "vitrel: 'reprot' is no command; did you mean 'report'?"},
        {"help pair overlp", "vitrel pair: 'overlp' is no command; did you mean 'overlap'?"},
        {"--versoin", "vitrel: '--versoin' is no option; did you mean '--version'?"},
        // Rather than that the output is missing.
        {"run p.toml --ouput run.h5",
         "vitrel run: '--ouput' is no option; did you mean '--output'?"},
        {"run p.toml --ouput=run.h5",
         "vitrel run: '--ouput' is no option; did you mean '--output'?"},
        {"pair gap --bdoy semi_axes=2,1",
         "vitrel pair gap: '--bdoy' is no option; did you mean '--body'?"},
        {"pair contact-time --rotation eular",
         "vitrel pair contact-time: --rotation: 'eular' is none of euler, constant; did you mean "
         "'euler'?"},
        {"export run.h5 --to xythet",
         "vitrel export: --to: 'xythet' is none of gsd, xyz, csv, xytheta, geo, vti, vtp; did you "
         "mean 'xytheta'?"}})
    expect_refusal(command, errors);
}

TEST_F(HabitsTest, WhereNothingIsNearTheMessageSaysWhoListsWhatThereIs) {
  for (const auto& [command, who, complaint] :
       {std::tuple("", "vitrel", "a command is missing"),
        {"pair", "vitrel pair", "a command is missing"},
        {"frobnicate", "vitrel", "'frobnicate' is no command"},
        {"check run.h5 -x", "vitrel check", "'-x' is no option"},
        {"check a.h5 b.h5", "vitrel check", "'b.h5' is one word too many"},
        {"pair gap a.toml b.toml", "vitrel pair gap", "'b.toml' is one word too many"},
        {"run p.toml", "vitrel run", "--output is required"},
        {"run p.toml -o", "vitrel run", "--output needs a value: --output FILE"}})
    expect_refusal(command,
                   fmt::format("{}: {}; {} --help lists what there is", who, complaint, who));
}

// ---- completion -------------------------------------------------------------------------------------

/// What a command of the shell prints, which runs in that folder with the program first on PATH.
std::string shell(const Folder& folder, const std::string& command) {
  const std::string program = fs::path(VITREL_PROGRAM).parent_path().string();
  const std::string whole = "cd '" + folder.path().string() + "' && PATH='" + program +
                            "':\"$PATH\" && " + command + " 2>&1";
  FILE* pipe = popen(whole.c_str(), "r");
  std::string printed;
  for (int c = 0; (c = std::fgetc(pipe)) != EOF;) printed += static_cast<char>(c);
  EXPECT_EQ(pclose(pipe), 0) << whole << '\n' << printed;
  return printed;
}

bool is_installed(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

/// What bash offers for the last of the words; as the shell does, `=` is a word of its own.
std::vector<std::string> offered(const Folder& folder, const std::string& command) {
  const std::vector<std::string> words = words_of(command);
  std::string script = "source <(vitrel completion bash)\nCOMP_WORDS=(vitrel";
  for (const std::string& word : words) script += " \"" + word + "\"";
  script += ")\nCOMP_CWORD=" + std::to_string(words.size()) +
            "\n_vitrel\n((${#COMPREPLY[@]})) && printf '%s\\n' \"${COMPREPLY[@]}\" || true\n";
  folder.write("complete.bash", script);
  return lines_of(shell(folder, "bash --norc complete.bash"));
}

TEST_F(HabitsTest, BashCompletesCommandsOptionsChoicesAndFiles) {
  folder.write("run.h5", "");
  folder.write("ru n.h5", "");
  fs::create_directory(folder / "runs");
  EXPECT_THAT(offered(folder, "''"), testing::UnorderedElementsAreArray(commands()));
  EXPECT_THAT(offered(folder, "export --to ="), Contains("xytheta"));
  EXPECT_THAT(offered(folder, "pair ''"), testing::UnorderedElementsAreArray(commands("pair")));
  const std::vector<std::pair<std::string, std::vector<std::string>>> expected = {
      {"ex", {"export"}},
      {"-", {"-h", "--help", "--version"}},
      {"export --to ''", {"gsd", "xyz", "csv", "xytheta", "geo", "vti", "vtp"}},
      {"export run.h5 --to = g", {"gsd", "geo"}},
      {"params ''", {"prepare", "run", "analyze", "sweep", "pair"}},
      {"help pre", {"prepare"}},
      {"completion ''", {"bash", "zsh"}},
      {"sweep p.toml --export ''", {"snakemake", "slurm"}},
      {"check ru", {"run.h5", "ru n.h5", "runs"}},
      {"run p.toml --from run.", {"run.h5"}},
      {"sweep p.toml -o r", {"runs"}},
      {"run --threads ''", {}},
      {"pair ov", {"overlap"}},
      {"pair gap --b", {"--body", "--box"}},
      {"pair contact-time --rotation ''", {"euler", "constant"}},
      {"pair gap run.", {"run.h5"}}};
  for (const auto& [words, offers] : expected)
    EXPECT_THAT(offered(folder, words), testing::UnorderedElementsAreArray(offers)) << words;
  for (const std::string& command : all_commands())
    EXPECT_THAT(offered(folder, command + " -"),
                testing::UnorderedElementsAreArray(options_of(command)))
        << command;
}

// Whoever has the package bash-completion gets it from there; the script is right without it.
TEST_F(HabitsTest, TheCompletionOfBashIsRegistered) {
  EXPECT_EQ(shell(folder, "bash --norc -uc 'source <(vitrel completion bash); complete -p vitrel'"),
            "complete -F _vitrel vitrel\n");
}

std::string part_between(const std::string& text, const std::string& first,
                         const std::string& end) {
  const auto begin = text.find(first);
  EXPECT_NE(begin, text.npos) << first;
  return begin == text.npos ? "" : text.substr(begin, text.find(end, begin) - begin);
}

/// The function of a command that has commands, or of the program.
std::string zsh_function(const std::string& script, const std::string& command) {
  std::string name = "_vitrel";
  for (const std::string& word : words_of(command)) name += "_" + word;
  return part_between(script, "\n" + name + "() {", "\n}");
}

TEST_F(HabitsTest, TheCompletionOfZshNamesAllCommandsAndOptions) {
  const std::string script = output_of("completion zsh");
  EXPECT_THAT(script, StartsWith("#compdef vitrel\n"));
  for (const std::string& command : all_commands()) {
    const std::size_t blank = command.rfind(' ');  // none in most commands, npos + 1 is 0
    const std::string name = command.substr(blank + 1);
    const std::string parent =
        zsh_function(script, blank == command.npos ? "" : command.substr(0, blank));
    EXPECT_THAT(parent, HasSubstr("'" + name + ":"));
    const std::string specifications =
        commands(command).empty() ? part_between(parent, "    " + name + ") _arguments", ";;")
                                  : zsh_function(script, command);
    for (const std::string& option : options_of(command)) {
      const bool is_there = specifications.find(")" + option) != specifications.npos ||
                            specifications.find("*" + option) != specifications.npos;
      EXPECT_TRUE(is_there) << command << " " << option;
    }
  }
  for (const char* part :
       {"    pair) _vitrel_pair ;;", ":FORMAT:(gsd xyz csv xytheta geo vti vtp)'",
        "':params:_files'", "Run all jobs of [sweep]"})
    EXPECT_THAT(script, HasSubstr(part));
  folder.write("_vitrel", script);
  if (is_installed("zsh")) {
    EXPECT_EQ(shell(folder, "zsh -n _vitrel"), "");
  }
}

// ---- the manual page --------------------------------------------------------------------------------

/// As the page has text that one types.
std::string bold_in_manual(const std::string& text) {
  std::string typed;
  for (const char c : text) typed += c == '-' ? "\\-" : std::string(1, c);
  return "\\fB" + typed + "\\fR";
}

TEST_F(HabitsTest, TheManualPageHasEveryCommandWithItsOptions) {
  const std::string page = output_of("man");
  EXPECT_THAT(page, StartsWith(".TH VITREL 1 "));
  EXPECT_THAT(page, HasSubstr("\n.SH NAME\nvitrel \\- simulation of hard anisotropic particles"));
  std::map<std::string, std::string> sections;
  std::string current;
  for (const std::string& line : lines_of(page)) {
    std::istringstream words(line);
    std::string request;
    words >> request;
    if (line.starts_with('.')) {
      EXPECT_THAT((std::set<std::string>{".TH", ".SH", ".SS", ".TP", ".PP"}), Contains(request));
    }
    EXPECT_FALSE(line.starts_with('\'') || line.empty()) << line;
    if (request == ".SS") current = line;
    sections[current] += line + '\n';
  }
  for (const std::string& command : all_commands()) {
    const auto found = std::ranges::find_if(sections, [&](const auto& section) {
      return section.first.starts_with(".SS " + bold_in_manual("vitrel " + command));
    });
    ASSERT_NE(found, sections.end()) << command;
    for (const std::string& option : options_of(command))
      if (option != "-h" && option != "--help") {
        EXPECT_THAT(found->second, HasSubstr(bold_in_manual(option))) << command;
      }
  }
}

TEST_F(HabitsTest, TheManualPageIsShown) {
  folder.write("vitrel.1", output_of("man"));
  const std::vector<std::pair<std::string, std::string>> viewers = {
      {"man", "MANWIDTH=100 man -l vitrel.1"},
      {"groff", "groff -man -ww -Tascii -P-c vitrel.1"},
      {"mandoc", "mandoc -Tascii -Werror vitrel.1"}};
  for (const auto& [viewer, command] : viewers) {
    if (!is_installed(viewer)) continue;
    // On paper terminals bold is a letter over itself.
    const std::string shown = shell(folder, command + " 2>&1 | sed 's/.\\x08//g'");
    for (const std::string& name : all_commands()) EXPECT_THAT(shown, HasSubstr("vitrel " + name));
    EXPECT_THAT(shown, Not(HasSubstr("warning")));
    EXPECT_THAT(shown, Not(HasSubstr("\\")));
  }
}

// ---- colour -----------------------------------------------------------------------------------------

constexpr const char* red = "\033[1;31m";
constexpr const char* bold = "\033[1m";

TEST_F(HabitsTest, ErrorsAreRedOnATerminal) {
  const Outcome shown = run_on_terminal(folder.path(), {"check", "nothere.h5"});
  EXPECT_EQ(shown.code, 3);
  EXPECT_THAT(shown.output, HasSubstr(red + std::string("vitrel check:\033[0m nothere.h5: ")));
  EXPECT_THAT(shown_on_terminal("anaylze"),
              StartsWith(red + std::string("vitrel:\033[0m 'anaylze' is no command")));
  EXPECT_THAT(shown_on_terminal("help"), HasSubstr(bold + std::string("Commands\033[0m:")));
}

TEST_F(HabitsTest, NoColourWhereNobodySeesItOrWantsIt) {
  for (const char* command : {"check nothere.h5", "anaylze", "help run"}) {
    const auto shown = [&](const std::map<std::string, std::string>& environment) {
      return shown_on_terminal(command, environment);
    };
    EXPECT_THAT(shown({}), HasSubstr("\033["));
    // no-color.org: an empty value does not count.
    EXPECT_THAT(shown({{"NO_COLOR", ""}}), HasSubstr("\033["));
    EXPECT_THAT(shown({{"NO_COLOR", "1"}}), Not(HasSubstr("\033[")));
    EXPECT_THAT(shown({{"TERM", "dumb"}}), Not(HasSubstr("\033[")));
    EXPECT_THAT(shown({{"TERM", ""}}), Not(HasSubstr("\033[")));
    const Outcome piped = folder.run(command);
    EXPECT_THAT(piped.output + piped.errors, Not(HasSubstr("\033[")));
  }
}

TEST_F(HabitsTest, OverlapsAreRedOnATerminal) {
  folder.succeed("prepare p.toml -o state.h5 -q");
  Configuration2 state = read_state(folder / "state.h5");
  EXPECT_THAT(shown_on_terminal("check state.h5"), Not(HasSubstr(red)));
  state.position[7] = state.position[3];
  write_state(folder / "overlap.h5", state, Provenance{});
  EXPECT_THAT(shown_on_terminal("check overlap.h5"),
              testing::ContainsRegex("overlaps +\033\\[1;31m[1-9]"));
  EXPECT_THAT(folder.run("check overlap.h5").output, testing::ContainsRegex("overlaps +[1-9]"));
}

// ---- tables -----------------------------------------------------------------------------------------

TEST_F(HabitsTest, TheOutputOfPreparationsFitsEightyColumns) {
  folder.write("plane.toml", small_system);
  folder.write("jammed.toml",
               "[system]\nparticles = 30\n[[species]]\naspect_ratio = 1.4\n[[prepare.stage]]\n"
               "[[prepare.stage]]\nmethod = \"grow\"\nreduced_pressure = 1e6\n");
  folder.write("space.toml",
               "[system]\ndimension = 3\nparticles = 20\npacking_fraction = 0.2\n[[species]]\n"
               "aspect_ratio = 3\n[[prepare.stage]]\norientations = \"tensor\"\n"
               "orientation_tensor = [0.7, 0.2, 0.1]\n[[prepare.stage]]\nmethod = \"grow\"\n"
               "growth_rate = 0.1\n");
  const std::map<std::string, std::string> expected = {{"plane", "hexatic order ψ₆"},
                                                       {"jammed", "rattlers"},
                                                       {"space", "orientation tensor ⟨w wᵀ⟩"}};
  for (const auto& [name, row] : expected) {
    const Outcome outcome = folder.run(fmt::format("prepare {}.toml -o {}.h5", name, name));
    ASSERT_EQ(outcome.code, 0) << outcome.errors;
    EXPECT_THAT(outcome.output, HasSubstr("\n" + row));
    for (const std::string& text : {outcome.output, outcome.errors})
      for (const std::string& line : lines_of(text)) EXPECT_LE(columns(line), 80u) << line;
  }
}

// ---- refusals ---------------------------------------------------------------------------------------

TEST_F(HabitsTest, AMissingStartIsNamedRatherThanTheOutput) {
  folder.write("existing.h5", "");
  const std::string command = "run p.toml --from nothere.h5 -o existing.h5 -q";
  const Outcome missing = folder.run(command);
  EXPECT_EQ(missing.code, 3);
  EXPECT_THAT(missing.errors, StartsWith("vitrel run: nothere.h5: cannot open the file"));
  folder.succeed("prepare p.toml -o nothere.h5 -q");
  const Outcome in_the_way = folder.run(command);
  EXPECT_EQ(in_the_way.code, 2);
  EXPECT_THAT(in_the_way.errors, StartsWith("vitrel run: existing.h5: exists, but has no check"));
  EXPECT_EQ(folder.read("existing.h5"), "");
}

// Small disks fill the holes between large ones.
TEST_F(HabitsTest, AMixtureMayBeDenserThanEqualDisks) {
  const auto plan = [&](const std::string& fraction, const std::string& small_disks) {
    folder.write("p.toml", "[system]\npacking_fraction = " + fraction +
                               "\n[[species]]\nname = \"large\"\naspect_ratio = 1\nfraction = 0.5\n"
                               "[[species]]\nname = \"small\"\naspect_ratio = 1\nfraction = 0.5\n" +
                               small_disks);
    return folder.run("run p.toml -o run.h5 --dry-run");
  };
  EXPECT_EQ(plan("0.91", "size = 0.2\n").code, 0);
  EXPECT_THAT(
      plan("0.91", "").errors,
      HasSubstr("p.toml:2:20: key 'system.packing_fraction' is 0.91, but a packing fraction "
                "lies between 0 and π/√12 = 0.9069 where all particles have the same area"));
  EXPECT_EQ(plan("0.91", "").code, 2);
  EXPECT_EQ(plan("1.0", "size = 0.2\n").code, 2);
}

// ---- plain text of t, x, y and θ ----------------------------------------------------------------------

TEST_F(HabitsTest, ARunBecomesALinePerFrame) {
  folder.succeed("run p.toml -o run.h5 -q");
  folder.succeed("export run.h5 --to xytheta -q");
  const std::vector<std::string> lines = lines_of(folder.read("run.dat"));
  const TrajectoryReader reader(folder / "run.h5");
  ASSERT_EQ(lines.size(), reader.frames());
  for (std::uint64_t k = 0; k < reader.frames(); ++k) {
    const Configuration2 state = reader.read(k);
    std::vector<double> expected = {state.time};
    for (std::size_t i = 0; i < state.size(); ++i)
      expected.insert(expected.end(),
                      {state.position[i].x(), state.position[i].y(), state.angle[i]});
    std::istringstream line(lines[k]);
    EXPECT_EQ(std::vector<double>(std::istream_iterator<double>(line), {}), expected) << k;
  }
  // Positions are those in the box, also of particles that have left it.
  const Configuration2 last = reader.read(reader.frames() - 1);
  EXPECT_TRUE(std::ranges::any_of(last.image, [](const auto& image) { return image.any(); }));
  // Its former name.
  folder.succeed("export run.h5 --to thesis -o former -q");
  EXPECT_EQ(folder.read("former"), folder.read("run.dat"));
}

TEST_F(HabitsTest, ALinePerFrameIsForThePlane) {
  folder.write("p.toml",
               "[system]\ndimension = 3\nparticles = 5\npacking_fraction = 0.01\n[[species]]\n"
               "aspect_ratio = 1\n[[prepare.stage]]\n");
  folder.succeed("prepare p.toml -o state.h5 -q");
  expect_refusal("export state.h5 --to xytheta -q",
                 "vitrel export: state.h5: is three-dimensional, for which --to takes gsd, xyz, "
                 "csv, geo, vti, vtp, but not xytheta");
  EXPECT_FALSE(fs::exists(folder / "state.dat"));
}

}  // namespace
}  // namespace vitrel
