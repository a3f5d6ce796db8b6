#include "workflow/run/run.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands/common.h"

namespace vitrel {

namespace {

template <int Dim>
int run_and_print(const Arguments& arguments, const RunRequest& request) {
  Session session(arguments.quiet, arguments.wall_time);
  const RunOutcome<Dim> outcome = run<Dim>(request, session.budget(), session.say());
  session.clear();
  const bool has_begun = outcome.state.configuration.size() > 0;
  if (has_begun) print_summary(arguments, run_summary(request, outcome));
  if (outcome.complete) return success;
  remark(arguments, "stopped; the same command continues");
  return stopped;
}

}  // namespace

int run_command(const Arguments& arguments) {
  RunRequest request{load_parameters(parameter_source(arguments)), arguments.output, std::nullopt,
                     arguments.command_line, arguments.threads};
  if (!arguments.from.empty()) request.from = arguments.from;
  require_output_file(arguments.output, {arguments.input, arguments.from});
  if (arguments.dry_run) {
    fmt::print("{}", run_plan(request));
    flush_output();
    return success;
  }
  return request.parameters.system.dimension == 2 ? run_and_print<2>(arguments, request)
                                                  : run_and_print<3>(arguments, request);
}

}  // namespace vitrel
