#include <fmt/format.h>

#include "app/commands/common.h"
#include "core/error.h"
#include "workflow/configuration/parameters.h"

namespace vitrel {

int params_command(const Arguments& arguments) {
  if (!arguments.reference && arguments.template_command.empty())
    throw UserError("name a command, for example: vitrel params run > params.toml");
  fmt::print("{}",
             arguments.reference ? parameter_page() : command_template(arguments.template_command));
  flush_output();
  return success;
}

}  // namespace vitrel
