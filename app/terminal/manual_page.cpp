#include "app/terminal/program_description.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>

namespace vitrel {
namespace {

/// Escapes text for roff, so that a backslash begins no escape sequence and hyphens are the characters that one
/// types.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
  return result;
}

/// A line of text whose first character is not taken for a request.
std::string line(const std::string& text) {
  const bool is_request = text.starts_with('.') || text.starts_with('\'');
  return (is_request ? "\\&" : "") + escaped(text) + '\n';
}

std::string bold(const std::string& text) {
  return "\\fB" + escaped(text) + "\\fR";
}
std::string italic(const std::string& text) {
  return "\\fI" + escaped(text) + "\\fR";
}

/// A tagged paragraph.
std::string entry(const OptionDescription& option, bool is_argument) {
  std::vector<std::string> names;
  for (const std::string& name : option.names)
    names.push_back(is_argument ? italic(name) : bold(name));
  std::string tag = fmt::format("{}", fmt::join(names, ", "));
  if (!is_argument && !option.value.empty()) tag += " " + italic(option.value);
  if (option.required) tag += " (required)";
  std::string text = option.sentence + ".";
  if (option.repeated && !is_argument) text += " May be given several times.";
  if (!option.excludes.empty())
    text += fmt::format(" Excludes {}.", fmt::join(option.excludes, ", "));
  return ".TP\n" + tag + '\n' + line(text);
}

/// The usage of the command with this full name.
std::string usage(const std::string& name, const CommandDescription& command) {
  std::string text = bold(name);
  if (!command.commands.empty()) text += " " + italic("command");
  if (!command.options.empty()) text += " [" + italic("options") + "]";
  for (const OptionDescription& argument : command.arguments) {
    const std::string words = italic(argument.names.front()) + (argument.repeated ? " ..." : "");
    text += argument.required ? " " + words : " [" + words + "]";
  }
  return text + '\n';
}

std::string section(const std::string& name, const CommandDescription& command) {
  std::string text = ".SS " + usage(name, command) + line(command.sentence);
  for (const OptionDescription& argument : command.arguments) text += entry(argument, true);
  // The option for help is described once, for the whole program.
  for (const OptionDescription& option : command.options)
    if (option.names.back() != "--help") text += entry(option, false);
  return command.footer.empty() ? text : text + ".PP\n" + line(command.footer);
}

/// The sections of all commands below the one with this full name.
std::string sections(const std::string& name, const CommandDescription& parent) {
  std::string text;
  for (const CommandDescription& command : parent.commands) {
    const std::string full_name = name + " " + command.name;
    text += section(full_name, command) + sections(full_name, command);
  }
  return text;
}

/// The sentence without its capital letter and full stop, as the indexes of manual pages require.
std::string clause(std::string sentence) {
  sentence.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(sentence.front())));
  if (sentence.ends_with('.')) sentence.pop_back();
  return sentence;
}

}  // namespace

std::string manual_page(const ProgramDescription& program) {
  std::string title = program.name;
  for (char& c : title) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  std::string text = fmt::format(".TH {} 1 \"\" \"{} {}\" \"User Commands\"\n", escaped(title),
                                 program.name, program.version);
  text += ".SH NAME\n" + escaped(program.name) + " \\- " + line(clause(program.sentence));
  text += ".SH SYNOPSIS\n" + usage(program.name, program);
  text += ".SH DESCRIPTION\n" + line(program.sentence) + line(program.footer);
  text += ".SH OPTIONS\n";
  for (const OptionDescription& option : program.options) text += entry(option, false);
  return text + ".SH COMMANDS\n" + sections(program.name, program);
}

}  // namespace vitrel
