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

/// Help in lines that fit a terminal.
class Help : public CLI::Formatter {
 public:
  Help() {
    label("Usage", heading("Usage"));
    label("Positionals", "Arguments");
    label("SUBCOMMAND", "COMMAND");
  }

 private:
  std::string make_description(const CLI::App* app) const override {
    return wrapped(app->get_description(), line_width) + '\n';
  }
  std::string make_footer(const CLI::App* app) const override {
    const std::string footer = app->get_footer();
    return footer.empty() ? footer : wrapped(footer, line_width) + '\n';
  }
  std::string make_group(std::string group, bool are_positionals,
                         std::vector<const CLI::Option*> options) const override {
    return Formatter::make_group(heading(group), are_positionals, options);
  }
  std::string make_subcommand(const CLI::App* app) const override {
    const std::size_t width = get_column_width();
    return fmt::format("  {:<{}}{}\n", app->get_name(), width - 2,
                       indented(in_column(app->get_description()), width));
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    return in_column(option->get_description());
  }
  std::string in_column(const std::string& text) const {
    return wrapped(text, line_width - get_column_width());
  }
};

}  // namespace vitrel
