#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <sstream>
#include <string>

#include "app/terminal/exit_codes.h"
#include "core/io/provenance.h"

/// @file
/// What the command lines of the programs share. CLI11 takes long to compile: one source file of each
/// program includes this.
namespace vitrel {

inline constexpr std::size_t help_width = 80;

/// Line breaks between words, so that no line is longer than `width`.
inline std::string wrapped(const std::string& text, std::size_t width) {
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

inline CLI::Validator number_above_zero(bool or_zero, const std::string& wanted) {
  return {[=](const std::string& text) {
            double number = 0;
            const bool fits =
                CLI::detail::lexical_cast(text, number) && (number > 0 || (or_zero && number == 0));
            return fits ? std::string() : text + " is not " + wanted;
          },
          ""};
}
inline const CLI::Validator positive = number_above_zero(false, "a positive number");
inline const CLI::Validator not_negative = number_above_zero(true, "a positive number or 0");

/// The whole command line, for the provenance.
inline std::string joined(int count, char** words) {
  std::string line;
  for (int k = 0; k < count; ++k) line += (k > 0 ? " " : "") + std::string(words[k]);
  return line;
}

/// The command line of a program with subcommands, which derived classes add.
class ProgramCommandLine {
 public:
  /// Parses the words and runs the subcommand chosen; returns the exit code.
  int execute(int count, char** words) {
    try {
      app_.parse(count, words);
    } catch (const CLI::ParseError& error) {
      return app_.exit(error) == 0 ? success : user_error;
    }
    return exit_code_of(command_name(), [this] { return chosen_(); });
  }

 protected:
  ProgramCommandLine(const std::string& sentence, const std::string& program)
      : app_(sentence, program) {
    app_.formatter(std::make_shared<Help>());
    app_.require_subcommand(1);
    app_.set_version_flag("--version", program_version());
    app_.failure_message([program](const CLI::App*, const CLI::Error& error) {
      return program + ": " + error.what() + "; " + program + " --help and " + program +
             " <command> --help list what there is\n";
    });
  }

  CLI::App app_;
  std::function<int()> chosen_;  ///< set by the subcommand that the command line names

 private:
  /// The program and the subcommands that the command line names.
  std::string command_name() const {
    std::string name = app_.get_name();
    for (const CLI::App* app = &app_; !app->get_subcommands().empty();) {
      app = app->get_subcommands().front();
      name += " " + app->get_name();
    }
    return name;
  }
};

}  // namespace vitrel
