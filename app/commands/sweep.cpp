#include "workflow/sweep/sweep.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands/common.h"

namespace vitrel {
namespace {

std::filesystem::path this_program() {
  return std::filesystem::read_symlink("/proc/self/exe");
}

void print_table(const Arguments& arguments) {
  std::vector<SweepJob> jobs = sweep_jobs(parameter_source(arguments));
  if (!arguments.job.empty()) jobs = {job_named(jobs, arguments.job)};
  if (arguments.json)
    fmt::print("{}\n", sweep_summary(jobs, arguments.output).dump(2));
  else if (!arguments.quiet)
    fmt::print("{}", sweep_table(jobs, arguments.output));
  flush_output();
}

int export_workflow(const Arguments& arguments) {
  export_sweep(parameter_source(arguments), arguments.output, this_program());
  remark(arguments,
         fmt::format("{}: in this folder, snakemake -j 2 works off the sweep, and snakemake "
                     "--profile slurm hands its jobs to Slurm",
                     arguments.output.string()));
  return success;
}

SweepOutcome work_off(const Arguments& arguments) {
  Session session(arguments.quiet, arguments.wall_time);
  const SweepRequest request{parameter_source(arguments), arguments.output, this_program(),
                             arguments.parallel, arguments.wall_time};
  return arguments.job.empty() ? run_sweep(request, session.say())
                               : run_job(request, arguments.job, session.say());
}

}  // namespace

int sweep_command(const Arguments& arguments) {
  if (!arguments.export_as.empty()) return export_workflow(arguments);
  if (arguments.status) {
    print_table(arguments);
    return success;
  }
  const SweepOutcome outcome = work_off(arguments);
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
