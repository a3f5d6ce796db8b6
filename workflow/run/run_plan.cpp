#include <fmt/format.h>
#include <unistd.h>

#include "core/state/typical_scales.h"
#include "workflow/configuration/hard_contacts.h"
#include "workflow/configuration/soft_particles.h"
#include "workflow/configuration/start_state.h"
#include "workflow/prepare/preparation_plan.h"
#include "workflow/run/correlations_file.h"
#include "workflow/run/run.h"
#include "workflow/run/run_cost.h"
#include "workflow/run/run_start.h"
#include "workflow/storage/checkpoint_file.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

/// Says where the run starts, with the plan of a preparation. The species of the request become those of the run.
template <int Dim>
std::string start_text(RunRequest& request) {
  const fs::path checkpoint = checkpoint_path(request.output);
  if (checkpoint_exists(checkpoint)) {
    const RunCheckpoint<Dim> run = stored_run<Dim>(request, load_checkpoint(checkpoint).checkpoint);
    return run.complete ? "nothing: the run is complete"
                        : fmt::format("the checkpoint at {}, {} frames",
                                      time_text(run.state.configuration.time, run.state.start_time),
                                      run.state.next_sample);
  }
  refuse_foreign_output(request.output);
  const std::vector<Stage>& stages = request.parameters.stages;
  const bool is_given = start_state(stages) && stages.size() == 1;
  const PrepareRequest preparation = preparation_request(request);
  Configuration<Dim> state =
      start_state(stages) ? read_start<Dim>(request.parameters, preparation.overlaps_allowed, {})
                          : representative_particles<Dim>(request.parameters);
  if (is_given) {
    set_velocities(state, request.parameters);
    return stage_description(stages.front(), 0);
  }
  require_same_preparation<Dim>(preparation);
  const std::string plan = preparation_plan(request.parameters, state);
  // Stages leave the particles at rest, so the velocities of a given state are lost.
  state = representative_particles<Dim>(request.parameters);
  set_velocities(state, request.parameters);
  return fmt::format("a preparation in {} stage{}\n{}", stages.size(),
                     stages.size() == 1 ? "" : "s", plan);
}

/// Returns a warning if the run needs more than is available, else an empty text.
std::string room_text(double needed, double available, const char* what) {
  constexpr double megabyte = 1e6;
  if (needed <= available) return "";
  return fmt::format("warning      needs {:.3g} MB of {}, but there are {:.3g} MB\n",
                     needed / megabyte, what, available / megabyte);
}

double physical_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

double free_disk(const fs::path& output) {
  std::error_code unknown;
  return static_cast<double>(fs::space(fs::absolute(output).parent_path(), unknown).available);
}

/// Returns a warning if the Brownian steps are too long, else an empty text.
template <int Dim>
std::string step_text(const DynamicsParameters& p, const Configuration<Dim>& some) {
  if (p.kind != DynamicsParameters::Kind::brownian) return "";
  const std::string text = long_step_text(p.brownian_step, typical_time(some));
  return text.empty() ? text : fmt::format("warning      {}\n", text);
}

template <int Dim>
std::string cost_text(const RunRequest& request, const Configuration<Dim>& some) {
  const Parameters& p = request.parameters;
  const RunCost cost = run_cost(p, some);
  const double correlations = p.output.correlations ? correlator_bytes(p) : 0;
  const double memory = cost.memory_bytes + correlations;
  const bool slows = (is_dissipative(p.dynamics) || p.dynamics.contact) && !p.dynamics.driving;
  const bool is_bound = slows || p.dynamics.relaxation_times;
  return fmt::format(
             "expects      {}{:.2g} events, {:.2g} s after the preparation, {:.3g} MB of "
             "memory, {:.3g} MB on disk\n",
             is_bound ? "at most " : "", cost.events, cost.seconds, memory / 1e6,
             cost.disk_bytes / 1e6) +
         step_text(p.dynamics, some) + room_text(memory, physical_memory(), "memory") +
         room_text(cost.disk_bytes, free_disk(request.output), "disk");
}

template <int Dim>
std::string plan_text(RunRequest request) {
  const std::string start = start_text<Dim>(request);
  const Parameters& p = request.parameters;
  const Configuration<Dim> some = representative_particles<Dim>(p);
  std::string text = fmt::format("starts from  {}{}", start, start.ends_with('\n') ? "" : "\n");
  text += system_plan(p);
  for (const Species& species : p.species)
    text += fmt::format("species      {}, fraction {:.4g}\n", species.name, species.fraction);
  text += p.dynamics.kind == DynamicsParameters::Kind::brownian
              ? fmt::format("dynamics     brownian, step {}\n", p.dynamics.brownian_step)
              : std::string("dynamics     newtonian\n");
  text += fmt::format("model        {}\n", model_text(p, some));
  text += p.dynamics.contact ? contact_text(*p.dynamics.contact) : hard_contact_text(p.dynamics);
  const auto& times = p.dynamics.relaxation_times;
  text += fmt::format("time         {} to equilibrate, then {}{}\n", p.dynamics.equilibration,
                      times ? fmt::format("{} relaxation times or at most ", *times) : "",
                      p.dynamics.duration);
  text +=
      fmt::format("writes       {}, {} frames; checkpoint every {} s\n", request.output.string(),
                  sample_times(p).size(), p.output.checkpoint_interval);
  if (p.output.correlations)
    text += fmt::format("correlates   every {}, into {}\n", p.output.correlations->interval,
                        correlations_path(request.output).string());
  return text + cost_text(request, some);
}

}  // namespace

std::string run_plan(RunRequest request) {
  return run_dimension(request) == 2 ? plan_text<2>(request) : plan_text<3>(request);
}

}  // namespace vitrel
