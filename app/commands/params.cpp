#include "app/commands/commands.h"

#include "app/terminal/exit_codes.h"
#include "app/terminal/session.h"
#include "core/error.h"
#include "workflow/configuration/parameters.h"
#include "workflow/pair/pair_parameters.h"

namespace vitrel {

std::vector<std::string> commands_with_templates() {
  std::vector<std::string> names = commands_with_parameters();
  names.push_back("pair");
  return names;
}

int params_command(const ParamsOptions& options) {
  if (!options.reference && !options.python && options.command.empty())
    throw UserError("name a command, for example: vitrel params run > params.toml");
  print_text(options.reference           ? parameter_page()
             : options.python            ? parameter_module()
             : options.command == "pair" ? pair_template()
                                         : command_template(options.command));
  return success;
}

}  // namespace vitrel
