#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/terminal/style.h"
#include "app/terminal/text_lines.h"

namespace vitrel {

inline std::string heading(const std::string& text) {
  return styled(text, Style::heading, STDOUT_FILENO);
}

/// Help in lines that fit a terminal. The layout is the same for every version of CLI11.
class Help : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    return make_description(app) + make_usage(app, name) + make_positionals(app) +
           make_groups(app, mode) + make_subcommands(app, mode) + make_footer(app);
  }

 private:
  std::string make_description(const CLI::App* app) const override {
    return wrapped(app->get_description(), line_width) + '\n';
  }
  std::string make_usage(const CLI::App* app, std::string name) const override {
    std::string usage = fmt::format("{}: {} [OPTIONS]", heading("Usage"), name);
    const auto is_argument = [](const CLI::Option* option) { return option->get_positional(); };
    for (const CLI::Option* argument : app->get_options(is_argument))
      usage += ' ' + make_option_usage(argument);
    if (!app->get_subcommands({}).empty()) usage += " COMMAND";
    return usage + '\n';
  }
  std::string make_footer(const CLI::App* app) const override {
    const std::string footer = app->get_footer();
    return footer.empty() ? footer : '\n' + wrapped(footer, line_width) + '\n';
  }
  std::string make_group(std::string, bool are_positionals,
                         std::vector<const CLI::Option*> options) const override {
    std::string group = fmt::format("\n{}:\n", heading(are_positionals ? "Arguments" : "Options"));
    for (const CLI::Option* option : options) group += make_option(option, are_positionals);
    return group;
  }
  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    const std::size_t width = get_column_width();
    std::string names = "  " + make_option_name(option, is_positional) + make_option_opts(option);
    if (names.size() >= width) names += '\n' + std::string(width, ' ');
    return fmt::format("{:<{}}{}\n", names, width,
                       indented(in_column(option->get_description()), width));
  }
  std::string make_subcommand(const CLI::App* app) const override {
    const std::size_t width = get_column_width();
    return fmt::format("  {:<{}}{}\n", app->get_name(), width - 2,
                       indented(in_column(app->get_description()), width));
  }
  std::string in_column(const std::string& text) const {
    return wrapped(text, line_width - get_column_width());
  }
};

}  // namespace vitrel
