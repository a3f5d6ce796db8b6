#include "app/workflow/run.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands/common.h"

namespace vitrel {

int run_command(const Arguments& arguments) {
  RunRequest request{load_parameters(parameter_source(arguments)), arguments.output, std::nullopt,
                     arguments.command_line, arguments.threads};
  require_two_dimensions(request.parameters, "vitrel run");
  if (!arguments.from.empty()) request.from = arguments.from;
  require_output_file(arguments.output, {arguments.input, arguments.from});
  if (arguments.dry_run) {
    fmt::print("{}", run_plan(request));
    flush_output();
    return success;
  }
  Session session(arguments);
  const RunOutcome outcome = run(request, session.budget(), session.say());
  session.clear();
  const bool has_begun = outcome.state.configuration.size() > 0;
  if (has_begun) print_summary(arguments, run_summary(request, outcome));
  if (outcome.complete) return success;
  remark(arguments, "stopped; the same command continues");
  return stopped;
}

}  // namespace vitrel
