#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "app/terminal/exit_codes.h"
#include "app/terminal/help.h"
#include "app/terminal/program_description.h"
#include "app/terminal/session.h"
#include "app/terminal/validators.h"
#include "core/io/provenance.h"
#include "core/io/suggestion.h"

/// @file
/// The common part of the command lines of the programs. CLI11 takes long to compile, so only one source file of each
/// program includes this header.
namespace vitrel {

/// The whole command line for the provenance. The name of the program has no folder.
inline std::string joined(int count, char** words) {
  std::string line = std::filesystem::path(words[0]).filename().string();
  for (int k = 1; k < count; ++k) line += " " + std::string(words[k]);
  return line;
}

/// The command line of a program with commands. Derived classes add the commands.
class ProgramCommandLine {
 public:
  /// Parses the words, runs the chosen command and returns the exit code.
  int execute(int count, char** words) {
    try {
      app_.parse(count, words);
    } catch (const CLI::Success& asked) {  // help or the version was requested
      std::ostringstream text;
      const int code = app_.exit(asked, text, text);
      return exit_code_of(app_.get_name(), [&] { return print(text.str(), code); });
    } catch (const CLI::ParseError& error) {
      return complain_about(error);
    }
    const CLI::App& command = named_command();
    return exit_code_of(full_name(command), work_.at(&command));
  }

 protected:
  ProgramCommandLine(const std::string& sentence, const std::string& program)
      : app_(sentence, program) {
    app_.formatter(std::make_shared<Help>());
    app_.require_subcommand(1);
    app_.set_version_flag("--version", program_version());
  }

  /// Adds a command to the program or to another command. `work` runs it and returns the exit code.
  CLI::App& add_command(CLI::App& parent, const std::string& name, const std::string& sentence,
                        const std::function<int()>& work) {
    CLI::App& command = *parent.add_subcommand(name, sentence);
    command.group(heading("Commands"));
    work_[&command] = work;
    return command;
  }

  void add_manual() {
    const std::string name = app_.get_name();
    add_command(app_, "man", fmt::format("Print the manual page: {0} man | man -l -", name),
                [this] { return print(manual_page(description())); });
  }

  /// Adds the commands that every program has. Call it after all others are added.
  void add_help_and_version() {
    CLI::App& help =
        add_command(app_, "help", "Print the options of a command, or the list of commands.",
                    [this] { return print_help(); });
    add_command(app_, "version", "Print the version.",
                [] { return print(program_version() + '\n'); });
    CLI::Option* topic = help.add_option("command", topic_, "Which command");
    choices_[topic->type_name("COMMAND")] = command_names(app_);
  }

  /// Adds an option or an argument whose value is one of a few words.
  CLI::Option* add_choice(CLI::App& command, const std::string& name, std::string& value,
                          const std::vector<std::string>& choices, const std::string& value_name,
                          const std::string& sentence) {
    CLI::Option* option = command.add_option(name, value, sentence);
    choices_[option] = choices;
    return option->type_name(value_name)->check(one_of(choices));
  }

  ProgramDescription description() const { return {described(app_), program_version()}; }

  /// Prints on standard output and returns the exit code.
  static int print(const std::string& text, int code = success) {
    print_text(text);
    return code;
  }

  CLI::App app_;

 private:
  /// The full name of a command, such as "vitrel pair gap".
  static std::string full_name(const CLI::App& command) {
    const CLI::App* parent = command.get_parent();
    return (parent ? full_name(*parent) + " " : "") + command.get_name();
  }

  /// The command that the words name, or the first one on the way to it that has a word which it does not accept.
  const CLI::App& named_command() const {
    const CLI::App* command = &app_;
    while (command->remaining().empty() && !command->get_subcommands().empty())
      command = command->get_subcommands().front();
    return *command;
  }

  int print_help() const {
    const CLI::App* command = &app_;
    for (const std::string& word : topic_) {
      const auto named =
          command->get_subcommands([&](const CLI::App* below) { return below->check_name(word); });
      if (named.empty()) return complain_about(*command, refusal(*command, word));
      command = named.front();
    }
    return print(
        app_.get_formatter()->make_help(command, full_name(*command), CLI::AppFormatMode::Normal));
  }

  /// Reports the error in one message. A word that is not accepted comes first, because it may be why something is
  /// missing.
  int complain_about(const CLI::ParseError& error) const {
    const CLI::App& command = named_command();
    const std::vector<std::string> unknown = command.remaining();
    return complain_about(command, !unknown.empty()        ? refusal(command, unknown.front())
                                   : has_commands(command) ? "a command is missing"
                                                           : in_words(error));
  }

  static int complain_about(const CLI::App& command, std::string message) {
    const std::string name = full_name(command);
    if (!message.ends_with('?')) message += "; " + name + " --help lists what there is";
    return complain(name, message, user_error);
  }

  static std::string in_words(const CLI::ParseError& error) {
    static const std::regex no_value("(.*): 1 required (.*) missing");
    return std::regex_replace(error.what(), no_value, "$1 needs a value: $1 $2");
  }

  /// Says why the word is not accepted.
  static std::string refusal(const CLI::App& command, const std::string& word) {
    if (word.starts_with('-')) {
      const std::string name = word.substr(0, word.find('='));
      return fmt::format("'{}' is no option{}", name, suggestion(name, long_names(command)));
    }
    if (has_commands(command))
      return fmt::format("'{}' is no command{}", word, suggestion(word, command_names(command)));
    return fmt::format("'{}' is one word too many", word);
  }

  static bool has_commands(const CLI::App& app) { return !app.get_subcommands({}).empty(); }

  static std::vector<std::string> command_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    return names;
  }

  static std::vector<std::string> long_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
  }

  CommandDescription described(const CLI::App& app) const {
    CommandDescription result = {app.get_name(),        app.get_description(),  app.get_footer(),
                                 options_of(app, true), options_of(app, false), {}};
    for (const CLI::App* command : app.get_subcommands({}))
      result.commands.push_back(described(*command));
    return result;
  }

  std::vector<OptionDescription> options_of(const CLI::App& app, bool are_arguments) const {
    std::vector<OptionDescription> options;
    for (const CLI::Option* option : app.get_options())
      if (option->get_positional() == are_arguments) options.push_back(described(*option));
    return options;
  }

  OptionDescription described(const CLI::Option& option) const {
    OptionDescription result;
    if (option.get_positional()) result.names = {option.get_name(true, false)};
    for (const std::string& name : option.get_snames()) result.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) result.names.push_back("--" + name);
    if (option.get_type_size_max() > 0) result.value = option.get_type_name();
    if (const auto found = choices_.find(&option); found != choices_.end())
      result.choices = found->second;
    for (const CLI::Option* other : option.get_excludes())
      result.excludes.push_back(other->get_name());
    std::ranges::sort(result.excludes);
    result.sentence = option.get_description();
    result.required = option.get_required();
    result.repeated = !result.value.empty() && option.get_expected_max() > 1;
    return result;
  }

  std::map<const CLI::App*, std::function<int()>> work_;
  std::vector<std::string> topic_;  ///< argument of `help`
  std::map<const CLI::Option*, std::vector<std::string>> choices_;
};

}  // namespace vitrel
