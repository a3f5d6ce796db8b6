#include "app/workflow/sweep.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands/common.h"

namespace vitrel {
namespace {

void print_table(const Arguments& arguments) {
  const std::vector<SweepJob> jobs = sweep_jobs(parameter_source(arguments));
  if (arguments.json)
    fmt::print("{}\n", sweep_summary(jobs, arguments.output).dump(2));
  else
    fmt::print("{}", sweep_table(jobs, arguments.output));
  flush_output();
}

}  // namespace

int sweep_command(const Arguments& arguments) {
  if (arguments.status) {
    print_table(arguments);
    return success;
  }
  Session session(arguments);
  const SweepRequest request{parameter_source(arguments), arguments.output,
                             std::filesystem::read_symlink("/proc/self/exe"), arguments.parallel,
                             arguments.wall_time};
  const SweepOutcome outcome = run_sweep(request, session.say());
  print_table(arguments);
  if (outcome.failed > 0) {
    fmt::print(stderr,
               "vitrel sweep: {} job(s) failed; log.txt in their folders says why, and the same "
               "command tries them again\n",
               outcome.failed);
    return outcome.first_failure;
  }
  if (outcome.stopped) remark(arguments, "stopped; the same command continues");
  return outcome.stopped ? stopped : success;
}

}  // namespace vitrel
