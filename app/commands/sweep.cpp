#include "app/commands/commands.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands/common.h"
#include "app/terminal/exit_codes.h"
#include "app/terminal/session.h"
#include "workflow/sweep/sweep_export.h"
#include "workflow/sweep/sweep_status.h"

namespace vitrel {
namespace {

std::filesystem::path this_program() {
  return std::filesystem::read_symlink("/proc/self/exe");
}

std::vector<SweepJob> jobs_of(const SweepOptions& options) {
  std::vector<SweepJob> jobs = sweep_jobs(parameter_source(options.source));
  if (!options.job.empty()) jobs = {job_named(jobs, options.job)};
  return jobs;
}

void print_table(const SweepOptions& options, const std::vector<SweepJob>& jobs) {
  if (options.print.json)
    print_text(json_text(sweep_summary(jobs, options.output), 2) + '\n');
  else if (!options.print.quiet)
    print_text(sweep_table(jobs, options.output));
}

int print_status(const SweepOptions& options) {
  const std::vector<SweepJob> jobs = jobs_of(options);
  print_table(options, jobs);
  for (const std::string& change : sweep_changes(jobs, options.output))
    remark(options.print, change);
  return success;
}

SweepRequest request_of(const SweepOptions& options) {
  return {parameter_source(options.source), options.output, this_program(), options.parallel};
}

int export_workflow(const SweepOptions& options) {
  const SweepExport& to = sweep_export(options.export_as);
  export_sweep(request_of(options), to);
  remark(options.print, fmt::format("{}: in this folder, {}", options.output.string(), to.use));
  return success;
}

SweepOutcome run_jobs(const SweepOptions& options) {
  Session session(options.print.quiet, options.wall_time, StopDeadline::none);
  session.begin("sweep");
  const auto say = [&session](const std::string& line) { session.note(line); };
  const SweepRequest request = request_of(options);
  return options.job.empty() ? run_sweep(request, session.control(), say)
                             : run_job(request, options.job, session.control(), say);
}

}  // namespace

int sweep_command(const SweepOptions& options) {
  if (!options.export_as.empty()) return export_workflow(options);
  if (options.status) return print_status(options);
  if (options.dry_run) {
    print_text(sweep_plan(jobs_of(options), options.output, options.parallel));
    return success;
  }
  const SweepOutcome outcome = run_jobs(options);
  print_table(options, jobs_of(options));
  if (outcome.failed > 0) {
    return complain("vitrel sweep",
                    fmt::format("{} job(s) failed; log.txt in their folders says why, and the same "
                                "command tries them again",
                                outcome.failed),
                    outcome.first_failure);
  }
  if (outcome.stopped) remark(options.print, "stopped; the same command continues");
  return outcome.stopped ? stopped : success;
}

}  // namespace vitrel
