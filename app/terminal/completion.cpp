#include "app/terminal/program_description.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <string_view>

#include "workflow/sweep/process.h"

namespace vitrel {
namespace {

using Descriptions = std::vector<OptionDescription>;

std::string with_backslashes(const std::string& text, std::string_view before) {
  std::string result;
  for (const char c : text) {
    if (before.find(c) != before.npos) result += '\\';
    result += c;
  }
  return result;
}

// ---- bash -------------------------------------------------------------------------------------------

/// The argument with which `compgen` lists the possible values of an option: words, or an option for files or
/// folders.
std::string offer(const OptionDescription& option) {
  if (!option.choices.empty()) return fmt::format("{}", fmt::join(option.choices, " "));
  return option.value == file_value ? "-f" : option.value == folder_value ? "-d" : "";
}

std::string all_names(const Descriptions& options) {
  std::vector<std::string> names;
  for (const OptionDescription& option : options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  return fmt::format("{}", fmt::join(names, " "));
}

/// Lines that offer the values of the options of a command, one line for all options with the same values.
std::string value_cases(const std::string& path, const CommandDescription& command) {
  std::map<std::string, std::vector<std::string>> patterns;
  for (const OptionDescription& option : command.options)
    if (!option.value.empty())
      for (const std::string& name : option.names)
        patterns[offer(option)].push_back(path + ":" + name);
  std::string cases;
  for (const auto& [offered, names] : patterns)
    cases += fmt::format("    {}) offer={} ;;\n", fmt::join(names, " | "), shell_word(offered));
  return cases;
}

/// The commands below this command or, if there are none, the possible values of its first argument.
std::string offer_of_words(const CommandDescription& command) {
  std::vector<std::string> names;
  for (const CommandDescription& below : command.commands) names.push_back(below.name);
  if (!names.empty()) return fmt::format("{}", fmt::join(names, " "));
  return command.arguments.empty() ? "" : offer(command.arguments.front());
}

std::string word_cases(const std::string& path, const CommandDescription& command) {
  return fmt::format("        {0}:-*) offer={1} ;;\n        {0}:*) offer={2} ;;\n", path,
                     shell_word(all_names(command.options)), shell_word(offer_of_words(command)));
}

/// The cases for a command and all commands below it, each with its path, such as vitrel/pair/gap.
struct BashCases {
  std::vector<std::string> parents;
  std::string values, words;

  void add(const std::string& path, const CommandDescription& command) {
    values += value_cases(path, command);
    words += word_cases(path, command);
    if (!command.commands.empty()) parents.push_back(path);
    for (const CommandDescription& below : command.commands) add(path + "/" + below.name, below);
  }
};

// ---- zsh --------------------------------------------------------------------------------------------

std::string action(const OptionDescription& option) {
  if (!option.choices.empty()) return fmt::format("({})", fmt::join(option.choices, " "));
  return option.value == file_value ? "_files" : option.value == folder_value ? "_files -/" : " ";
}

/// The specifications of an option for `_arguments`, one for each of its names.
std::string option_specifications(const OptionDescription& option) {
  const std::string others =
      option.repeated ? "*" : fmt::format("({})", fmt::join(option.names, " "));
  std::string text = fmt::format("[{}]", with_backslashes(option.sentence, "[]\\"));
  if (!option.value.empty()) text += fmt::format(":{}:{}", option.value, action(option));
  std::string lines;
  for (const std::string& name : option.names) {
    const char* joined = option.value.empty() ? "" : name.starts_with("--") ? "=" : "+";
    lines += " \\\n      " + shell_word(others + name + joined + text);
  }
  return lines;
}

std::string specifications(const CommandDescription& command) {
  std::string lines;
  for (const OptionDescription& option : command.options) lines += option_specifications(option);
  for (const OptionDescription& argument : command.arguments)
    lines += " \\\n      " + shell_word(fmt::format("{}:{}:{}", argument.required ? "" : ":",
                                                    argument.names.front(), action(argument)));
  return lines;
}

/// The function that completes a command with commands below it, after the functions of those commands.
std::string zsh_function(const std::string& name, const CommandDescription& command) {
  std::string functions, commands, cases;
  for (const CommandDescription& below : command.commands) {
    const bool has_function = !below.commands.empty();
    const std::string function = name + "_" + below.name;
    if (has_function) functions += zsh_function(function, below);
    commands += fmt::format("    {}\n", shell_word(below.name + ":" + below.sentence));
    cases += fmt::format("    {}) {} ;;\n", below.name,
                         has_function ? function : "_arguments" + specifications(below));
  }
  return functions + fmt::format(R"({0}() {{
  local curcontext=$curcontext state line
  local -a commands=(
{1}  )
  _arguments -C{2} \
      '1:command:->command' '*::argument:->argument'
  [[ $state == command ]] && _describe command commands
  [[ $state == argument ]] || return
  case $words[1] in
{3}  esac
}}
)",
                                 name, commands, specifications(command), cases);
}

}  // namespace

std::string bash_completion(const ProgramDescription& program) {
  BashCases cases;
  cases.add(program.name, program);
  return fmt::format(
      R"(# Completion of {0} for bash, printed by `{0} completion bash`.
_{0}() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} path={0} offer='' k
  # Bash takes --option=value for three words.
  [[ $word == = ]] && word=''
  [[ $before == = ]] && before=${{COMP_WORDS[COMP_CWORD - 2]}}
  for ((k = 1; k < COMP_CWORD; ++k)); do
    case $path in
      {1}) path+=/${{COMP_WORDS[k]}} ;;
    esac
  done
  case $path:$before in
{2}    *)
      case $path:$word in
{3}      esac
      ;;
  esac
  case $offer in
    -f | -d)
      compopt -o filenames 2>/dev/null
      mapfile -t COMPREPLY < <(compgen "$offer" -- "$word")
      ;;
    *) mapfile -t COMPREPLY < <(compgen -W "$offer" -- "$word") ;;
  esac
}}
complete -F _{0} {0}
)",
      program.name, fmt::join(cases.parents, " | "), cases.values, cases.words);
}

std::string zsh_completion(const ProgramDescription& program) {
  return fmt::format(
      R"(#compdef {0}
# Completion of {0} for zsh, printed by `{0} completion zsh`.
{1}# The file of the function runs as its first call; sourced, it only defines it.
if [[ $funcstack[1] == _{0} ]]; then
  _{0} "$@"
else
  compdef _{0} {0}
fi
)",
      program.name, zsh_function("_" + program.name, program));
}

}  // namespace vitrel
