#include "app/commands/commands.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands/common.h"
#include "app/terminal/exit_codes.h"
#include "app/terminal/session.h"
#include "workflow/configuration/parameters.h"
#include "workflow/run/run.h"

namespace vitrel {

namespace {

template <int Dim>
int run_and_print(const RunOptions& options, const RunRequest& request, Session& session) {
  const RunOutcome<Dim> outcome = run_simulation<Dim>(request, session.control(), session.say());
  session.clear();
  set_summary_of_stop("");
  const bool has_begun = outcome.state.configuration.size() > 0;
  if (has_begun)
    print_summary(options.print, run_summary(request, outcome));
  else
    print_stopped(options.print, options.output);
  if (has_begun && outcome.state.counters.collisions == 0)
    remark(options.print,
           fmt::format("no particle collided in {:g} units of time, in which a particle moves by "
                       "about as many units of length; if those of the state are others, "
                       "import.length_unit converts them",
                       outcome.state.configuration.time - outcome.state.start_time));
  if (outcome.complete) return success;
  remark(options.print, "stopped; the same command continues");
  return stopped;
}

}  // namespace

int run_command(const RunOptions& options) {
  const RunRequest request{load_parameters(parameter_source(options.source, options.start)),
                           options.output, options.command_line, options.threads};
  std::vector<std::filesystem::path> inputs = {options.source.file};
  if (const StateStage* start = start_state(request.parameters.stages); start && start->file)
    inputs.emplace_back(*start->file);
  require_output_file(options.output, inputs);
  if (options.dry_run) {
    print_text(run_plan(request));
    return success;
  }
  Session session(options.print.quiet, options.wall_time);
  print_stopped_if_ended(options.print, options.output);
  return run_dimension(request) == 2 ? run_and_print<2>(options, request, session)
                                     : run_and_print<3>(options, request, session);
}

}  // namespace vitrel
