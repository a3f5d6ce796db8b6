#include "workflow/prepare/prepare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "analysis/structure/orientation_tensor.h"
#include "core/error.h"
#include "core/io/h5md.h"
#include "core/io/number_text.h"
#include "core/state/typical_scales.h"
#include "workflow/configuration/start_state.h"
#include "workflow/stages/stage_state.h"
#include "workflow/storage/checkpoint_file.h"
#include "workflow/storage/checkpoint_items.h"
#include "workflow/storage/state_items.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

/// The content of the checkpoint of a preparation.
template <int Dim>
struct PrepareCheckpoint {
  Preparation<Dim> done;     ///< its `stages` are those that have ended
  StageState state;          ///< of the stage that runs next, if there is one
  double stage_seconds = 0;  ///< wall time that this stage has taken so far
  std::string parameters;    ///< effective parameters as TOML
};

void each_item_of_record(auto& record, auto&& visit) {
  visit("reason", record.report.reason);
  visit("packing_fraction", record.packing_fraction);
  visit("mean_packing_fraction", record.mean_packing_fraction.mean);
  visit("mean_packing_fraction_error", record.mean_packing_fraction.error);
  visit("sweeps", record.sweeps);
  visit("chain_contacts", record.chain_contacts);
  visit.if_recorded("chain_pressure", record.chain_pressure);
  visit.if_recorded("decorrelations", record.decorrelations);
  visit("wall_seconds", record.wall_seconds);
  visit.if_recorded("orientation_tensor", record.orientation_tensor);
  each_item_of_trials(record.trials, visit);
  each_item_of_growth(record.growth, visit);
}

void each_item(auto& stored, auto&& visit) {
  visit("next_sweep", stored.done.next_sweep);
  visit("wall_seconds", stored.done.wall_seconds);
  for (std::size_t k = 0; k < stored.done.stages.size(); ++k)
    each_item_of_record(stored.done.stages[k], visit.below(fmt::format("stage.{}.", k)));
  visit("work.wall_seconds", stored.stage_seconds);
  each_item_of_stage(stored.state, visit);
}

template <int Dim>
Checkpoint to_checkpoint(const PrepareCheckpoint<Dim>& preparation) {
  Checkpoint checkpoint;
  checkpoint.configuration = preparation.done.configuration;
  checkpoint.parameters = preparation.parameters;
  checkpoint.counters["stages"] = preparation.done.stages.size();
  each_item(preparation, ItemWriter(checkpoint));
  return checkpoint;
}

/// `stages` are those of the whole preparation. Throws FileError, naming `file`, if something is missing.
template <int Dim>
PrepareCheckpoint<Dim> preparation_from_checkpoint(const Checkpoint& checkpoint,
                                                   const std::vector<Stage>& stages,
                                                   const fs::path& file) {
  const ItemReader read(checkpoint, file);
  PrepareCheckpoint<Dim> preparation;
  preparation.done.configuration = std::get<Configuration<Dim>>(checkpoint.configuration);
  preparation.parameters = checkpoint.parameters;
  std::uint64_t ended = 0;
  read("stages", ended);
  preparation.done.stages.resize(ended);
  // The items below include the number of the next sweep, so 0 is only a placeholder.
  if (ended < stages.size()) preparation.state = first_state(stages[ended], 0);
  each_item(preparation, read);
  return preparation;
}

fs::path checkpoint_path(const fs::path& output) {
  return output.string() + ".preparation";
}

fs::path stuck_state_path(const fs::path& output) {
  return output.string() + ".stuck.h5";
}

/// Says in words how a stage ended.
std::string end_text(const StageRecord& record) {
  const Estimate& mean = record.mean_packing_fraction;
  std::string text =
      fmt::format("{}; packing fraction {:.6g}", record.report.reason, record.packing_fraction);
  if (!(mean.mean > 0)) return text;
  text += ", in the second half " + with_error(mean.mean, mean.error);
  return std::isfinite(mean.error) ? text : text + ", too few sweeps for an error";
}

template <int Dim>
void bring_to_rest(Configuration<Dim>& configuration) {
  std::ranges::fill(configuration.velocity, Vec<Dim>::Zero());
  std::ranges::fill(configuration.angular_velocity, Motion<Dim>().angular_velocity);
}

/// The parameters of a preparation that continues. Throws UserError if it was begun with others.
template <int Dim>
Parameters resumed_parameters(Parameters parameters, const Checkpoint& begun,
                              const fs::path& file) {
  const auto* reached = std::get_if<Configuration<Dim>>(&begun.configuration);
  if (start_state(parameters.stages) && reached)
    take_system(parameters, *reached, file.string(), begun.parameters);
  if (const auto change =
          forbidden_change(begun.parameters, effective_parameters(parameters), Work::preparation))
    throw UserError(
        fmt::format("{}: the preparation was begun with {} = {}, but now it is {}; continue it "
                    "with its own parameters, or delete this file",
                    file.string(), change->key, change->first, change->second));
  return parameters;
}

struct MeanAndSpread {
  double mean = 0, spread = 0;
};

/// The mean and the standard deviation of the sizes of one species.
template <int Dim>
MeanAndSpread sizes_of(const Configuration<Dim>& c, std::int32_t species) {
  std::vector<double> sizes;
  for (std::size_t i = 0; i < c.size(); ++i)
    if (c.species[i] == species) sizes.push_back(c.shape[i].size());
  const auto n = static_cast<double>(sizes.size());
  const double mean = std::accumulate(sizes.begin(), sizes.end(), 0.0) / n;
  double squares = 0;
  for (const double size : sizes) squares += (size - mean) * (size - mean);
  constexpr double rounding = 1e-12;
  const double spread = std::sqrt(squares / n);
  return {mean, spread > rounding * mean ? spread : 0};
}

/// The execution of one request.
template <int Dim>
class PrepareJob {
 public:
  PrepareJob(const PrepareRequest& request, const RunControl& control, const Log& log)
      : request_(request),
        log_(log),
        control_(control),
        checkpoint_(checkpoint_path(request.output),
                    request.parameters.output.checkpoint_interval) {
    control_.on_resumable = [this] { save_if_due(); };
    done().parameters = request.parameters;
  }

  Preparation<Dim> run() {
    if (keeps_files() && checkpoint_.exists())
      load();
    else
      begin();
    while (done().stages.size() < parameters().stages.size()) {
      log_line(log_, description());
      if (!run_stage()) {
        if (has_places() && keeps_files()) save();
        return done();
      }
    }
    note_time();
    done().check = exact_check(done().configuration);
    if (!done().check.clean() && !may_overlap())
      throw InvariantError(
          "the prepared state has overlapping particles; this is a defect of the program");
    done().complete = true;
    return done();
  }

 private:
  const Parameters& parameters() const { return done().parameters; }
  const Stage& stage() const { return parameters().stages[done().stages.size()]; }
  Preparation<Dim>& done() { return stored_.done; }
  const Preparation<Dim>& done() const { return stored_.done; }
  std::uint64_t seed() const { return parameters().system.seed; }
  bool is_given() const { return start_state(parameters().stages) != nullptr; }
  bool may_overlap() const {
    return request_.overlaps_allowed && is_given() && parameters().stages.size() == 1;
  }
  bool keeps_files() const { return !request_.output.empty(); }
  /// The first stage places the particles; until it has ended there is nothing worth saving.
  bool has_places() const { return !done().stages.empty(); }

  void begin() {
    done().configuration = is_given()
                               ? read_start<Dim>(done().parameters, request_.overlaps_allowed, log_)
                               : drawn_particles();
    if (!is_given()) say_sizes();
    stored_.parameters = effective_parameters(parameters());
    stored_.state = first_state(stage(), 0);
  }

  Configuration<Dim> drawn_particles() const {
    const SystemParameters& system = parameters().system;
    return draw_particles<Dim>(parameters().species, static_cast<std::size_t>(system.particles),
                               system.packing_fraction, box_proportions<Dim>(system), system.seed,
                               system.draw);
  }

  /// Logs the mean and the standard deviation of the sizes that the particles of each species have drawn.
  void say_sizes() const {
    for (std::size_t k = 0; k < parameters().species.size(); ++k) {
      const MeanAndSpread sizes = sizes_of(done().configuration, static_cast<std::int32_t>(k));
      if (sizes.spread > 0)
        log_line(log_,
                 fmt::format("species {}: sizes with mean {:.4g} and standard deviation {:.4g}",
                             parameters().species[k].name, sizes.mean, sizes.spread));
    }
  }

  void load() {
    const Checkpoint loaded = checkpoint_.load(log_);
    const Parameters now = resumed_parameters<Dim>(parameters(), loaded, checkpoint_.path());
    stored_ = preparation_from_checkpoint<Dim>(loaded, now.stages, checkpoint_.path());
    done().parameters = now;
    timer_ = WorkTimer(done().wall_seconds);
    stage_timer_ = WorkTimer(stored_.stage_seconds);
    log_line(log_, fmt::format("continuing at stage {} of {}",
                               std::min(done().stages.size() + 1, parameters().stages.size()),
                               parameters().stages.size()));
  }

  void note_time() {
    done().wall_seconds = timer_.seconds();
    stored_.stage_seconds = stage_timer_.seconds();
  }

  void save() {
    note_time();
    checkpoint_.save(to_checkpoint(stored_));
  }

  void save_if_due() {
    if (keeps_files() && checkpoint_.is_due()) save();
  }

  /// Returns false if the run control requested a stop. A stopped stage keeps its velocities, so that it can
  /// continue.
  bool run_stage() {
    const StageReport report =
        advance_stage(stage(), stored_.state,
                      {&done().configuration, end_of_stage(stage(), parameters().system, reached()),
                       seed(), request_.threads, control_});
    note_time();
    if (report.end == StageEnd::stopped) return false;
    if (!std::holds_alternative<StateStage>(stage())) bring_to_rest(done().configuration);
    if (report.end == StageEnd::stalled) refuse_stuck(report);
    note_stage(report);
    begin_next_stage();
    save_if_due();
    return true;
  }

  /// The packing fraction at which the current stage began.
  double reached() const { return has_places() ? done().stages.back().packing_fraction : 0; }

  void note_stage(const StageReport& report) {
    StageRecord record = record_of(stage(), stored_.state);
    record.report = report;
    record.packing_fraction = packing_fraction(done().configuration);
    record.wall_seconds = stored_.stage_seconds;
    if constexpr (Dim == 3) {
      const Mat3 tensor = orientation_tensor(done().configuration).matrix;
      record.orientation_tensor.assign(tensor.data(), tensor.data() + tensor.size());
    }
    log_line(log_, "  " + end_text(record));
    done().next_sweep += record.sweeps;
    done().stages.push_back(record);
  }

  void begin_next_stage() {
    const bool is_last = done().stages.size() == parameters().stages.size();
    stored_.state = is_last ? StageState() : first_state(stage(), done().next_sweep);
    stage_timer_ = WorkTimer();
  }

  [[noreturn]] void refuse_stuck(const StageReport& report) const {
    std::string kept;
    if (has_places() && keeps_files()) {
      const fs::path path = stuck_state_path(request_.output);
      write_state(path, done().configuration,
                  current_provenance(request_.command_line, stored_.parameters, seed()), true);
      // The same stage with the same parameters would get stuck again, so the preparation is not continued from here.
      forget_preparation(request_.output);
      kept = "; the state is in " + path.string();
    }
    throw UserError(fmt::format("preparation, {}: {}{}", description(), report.reason, kept));
  }

  std::string description() const {
    return stage_description(stage(), end_of_stage(stage(), parameters().system, reached()));
  }

  const PrepareRequest& request_;
  const Log& log_;
  RunControl control_;
  CheckpointFile checkpoint_;
  PrepareCheckpoint<Dim> stored_;
  WorkTimer timer_, stage_timer_;
};

}  // namespace

template <int Dim>
TrialCounts Preparation<Dim>::trials() const {
  TrialCounts all;
  for (const StageRecord& stage : stages) all.add(stage.trials);
  return all;
}

int prepared_dimension(const PrepareRequest& request) {
  const fs::path checkpoint = checkpoint_path(request.output);
  if (!start_state(request.parameters.stages)) return request.parameters.system.dimension;
  if (!request.output.empty() && checkpoint_exists(checkpoint))
    return dimension_of(load_checkpoint(checkpoint).checkpoint);
  return start_dimension(request.parameters);
}

template <int Dim>
Preparation<Dim> prepare(const PrepareRequest& request, const RunControl& control, const Log& log) {
  return PrepareJob<Dim>(request, control, log).run();
}

template <int Dim>
void require_same_preparation(const PrepareRequest& request) {
  const fs::path checkpoint = checkpoint_path(request.output);
  if (checkpoint_exists(checkpoint))
    resumed_parameters<Dim>(request.parameters, load_checkpoint(checkpoint).checkpoint, checkpoint);
}

template void require_same_preparation<2>(const PrepareRequest&);
template void require_same_preparation<3>(const PrepareRequest&);
template struct Preparation<2>;
template struct Preparation<3>;
template Preparation<2> prepare<2>(const PrepareRequest&, const RunControl&, const Log&);
template Preparation<3> prepare<3>(const PrepareRequest&, const RunControl&, const Log&);

void forget_preparation(const fs::path& output) {
  remove_checkpoint(checkpoint_path(output));
}

}  // namespace vitrel
