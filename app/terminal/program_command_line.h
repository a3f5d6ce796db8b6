#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <regex>
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
/// What the command lines of the programs share. CLI11 takes long to compile: one source file of each
/// program includes this.
namespace vitrel {

/// The whole command line, for the provenance.
inline std::string joined(int count, char** words) {
  std::string line;
  for (int k = 0; k < count; ++k) line += (k > 0 ? " " : "") + std::string(words[k]);
  return line;
}

/// The command line of a program with commands, which derived classes add.
class ProgramCommandLine {
 public:
  /// Parses the words and runs the command chosen; returns the exit code.
  int execute(int count, char** words) {
    try {
      app_.parse(count, words);
    } catch (const CLI::Success& asked) {  // for help or the version
      return app_.exit(asked);
    } catch (const CLI::ParseError& error) {
      return complain_about(error);
    }
    return exit_code_of(name_with(app_.get_subcommands().front()), chosen_);
  }

 protected:
  ProgramCommandLine(const std::string& sentence, const std::string& program)
      : app_(sentence, program) {
    app_.formatter(std::make_shared<Help>());
    app_.require_subcommand(1);
    app_.set_version_flag("--version", program_version());
  }

  /// A command that does this work, which returns the exit code.
  CLI::App& add_command(const std::string& name, const std::string& sentence,
                        const std::function<int()>& work) {
    CLI::App& command = *app_.add_subcommand(name, sentence);
    command.group(heading("Commands"));
    command.callback([this, work] { chosen_ = work; });
    return command;
  }

  /// The commands of every program, when it has all others.
  void add_help_and_version() {
    CLI::App& help = add_command("help", "Print the options of a command, or the list of commands.",
                                 [this] { return print(help_text()); });
    add_command("version", "Print the version.", [] { return print(program_version() + '\n'); });
    add_choice(help, "command", topic_, command_names(), "COMMAND", "Which command");
  }

  /// An option, or an argument, with one of a few words for its value.
  CLI::Option* add_choice(CLI::App& command, const std::string& name, std::string& value,
                          const std::vector<std::string>& choices, const std::string& value_name,
                          const std::string& sentence) {
    CLI::Option* option = command.add_option(name, value, sentence);
    choices_[option] = choices;
    return option->type_name(value_name)->check(one_of(choices));
  }

  ProgramDescription description() const {
    ProgramDescription program = {app_.get_name(),         program_version(),
                                  app_.get_description(),  app_.get_footer(),
                                  options_of(app_, false), {}};
    for (const CLI::App* command : app_.get_subcommands({}))
      program.commands.push_back({command->get_name(), command->get_description(),
                                  command->get_footer(), options_of(*command, true),
                                  options_of(*command, false)});
    return program;
  }

  /// To standard output; returns the exit code.
  static int print(const std::string& text) {
    fmt::print("{}", text);
    flush_output();
    return success;
  }

  CLI::App app_;
  std::function<int()> chosen_;  ///< set by the command that the command line names

 private:
  std::string name_with(const CLI::App* command) const {
    return app_.get_name() + " " + command->get_name();
  }

  std::string help_text() const {
    return topic_.empty()
               ? app_.get_formatter()->make_help(&app_, app_.get_name(), CLI::AppFormatMode::Normal)
               : app_.get_subcommand(topic_)->help(app_.get_name());
  }

  /// In one message. A word that nothing takes comes first, as it may be why something is missing.
  int complain_about(const CLI::ParseError& error) const {
    const std::vector<CLI::App*> chosen = app_.get_subcommands();
    const bool is_inside = !chosen.empty() && app_.remaining().empty();
    const CLI::App& place = is_inside ? *chosen.front() : app_;
    const std::vector<std::string> unknown = place.remaining();
    const std::string name = is_inside ? name_with(&place) : app_.get_name();
    std::string message = !unknown.empty() ? refusal(place, unknown.front())
                          : is_inside      ? in_words(error)
                                           : "a command is missing";
    if (!message.ends_with('?')) message += "; " + name + " --help lists what there is";
    return complain(name, message, user_error);
  }

  static std::string in_words(const CLI::ParseError& error) {
    static const std::regex no_value("(.*): 1 required (.*) missing");
    return std::regex_replace(error.what(), no_value, "$1 needs a value: $1 $2");
  }

  /// Why the word may not stand there.
  std::string refusal(const CLI::App& place, const std::string& word) const {
    if (word.starts_with('-')) {
      const std::string name = word.substr(0, word.find('='));
      return fmt::format("'{}' is no option{}", name, suggestion(name, long_names(place)));
    }
    if (&place == &app_)
      return fmt::format("'{}' is no command{}", word, suggestion(word, command_names()));
    return fmt::format("'{}' is one word too many", word);
  }

  std::vector<std::string> command_names() const {
    std::vector<std::string> names;
    for (const CLI::App* command : app_.get_subcommands({})) names.push_back(command->get_name());
    return names;
  }

  static std::vector<std::string> long_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
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

  std::string topic_;  ///< of `help`
  std::map<const CLI::Option*, std::vector<std::string>> choices_;
};

}  // namespace vitrel
