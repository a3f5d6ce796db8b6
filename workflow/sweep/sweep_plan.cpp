#include "workflow/sweep/sweep_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "workflow/prepare/preparation_plan.h"
#include "workflow/run/run_cost.h"
#include "workflow/sweep/job_folder.h"
#include "workflow/sweep/text_table.h"

namespace vitrel {
namespace {

struct JobCost {
  StageCost preparation;
  RunCost run;  ///< nothing of a job that only prepares a state

  double seconds() const { return preparation.seconds + run.seconds; }
};

/// `start`: the packing fraction of the state that it starts from, if any.
template <int Dim>
JobCost cost_of(const SweepJob& job, double start) {
  const Configuration<Dim> some = representative_particles<Dim>(job.parameters);
  JobCost cost;
  for (const StageCost& stage : stage_costs(job.parameters, some, start))
    cost.preparation.add(stage);
  if (!job.prepares_only) cost.run = run_cost(job.parameters, some);
  return cost;
}

/// A state on file is taken to be as dense as the job wants it.
double start_of(const SweepJob& job, const std::map<std::string, double>& density_of) {
  if (!start_state(job.parameters.stages)) return 0;
  const auto before = density_of.find(job.predecessor);
  return before == density_of.end() ? job.parameters.system.packing_fraction : before->second;
}

/// Nothing of a job without a run.
std::string number_of_run(double number) {
  return number > 0 ? fmt::format("{:.2g}", number) : missing_cell;
}

}  // namespace

std::string sweep_plan(const std::vector<SweepJob>& jobs, const std::filesystem::path& folder,
                       int parallel) {
  std::vector<std::vector<std::string>> rows = {
      {"job", "stage", "prepare / s", "run / s", "events", "MB on disk"}};
  std::map<std::string, double> density_of;
  double left = 0, disk = 0;
  bool is_foreseen = true;
  for (const SweepJob& job : jobs) {
    density_of[job.id] = job.parameters.system.packing_fraction;
    const double start = start_of(job, density_of);
    const JobCost cost =
        job.parameters.system.dimension == 2 ? cost_of<2>(job, start) : cost_of<3>(job, start);
    const JobStage stage = job_stage(folder / job.id);
    if (stage != JobStage::done) {
      left += cost.seconds();
      disk += cost.run.disk_bytes;
      is_foreseen = is_foreseen && cost.preparation.is_foreseen;
    }
    rows.push_back({job.id, name_of(stage),
                    (cost.preparation.is_foreseen ? "" : "> ") +
                        fmt::format("{:.2g}", cost.preparation.seconds),
                    number_of_run(cost.run.seconds), number_of_run(cost.run.events),
                    number_of_run(cost.run.disk_bytes / 1e6)});
  }
  const int at_a_time = std::max(parallel, 1);
  return text_table(rows, 2) + fmt::format(
                                   "{} jobs; what is left is expected to take {}{:.2g} s with {} "
                                   "job{} at a time, and {:.3g} MB on disk\n",
                                   jobs.size(), is_foreseen ? "" : "more than ", left / at_a_time,
                                   at_a_time, at_a_time == 1 ? "" : "s", disk / 1e6);
}

}  // namespace vitrel
