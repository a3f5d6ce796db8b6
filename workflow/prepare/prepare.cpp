#include "workflow/prepare/prepare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <span>
#include <stdexcept>

#include "core/error.h"
#include "core/io/h5md.h"
#include "mc/sampling.h"
#include "workflow/prepare/prepare_checkpoint.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Method = PrepareStage::Method;

fs::path checkpoint_path(const fs::path& output) {
  return output.string() + ".preparation";
}

fs::path stuck_state_path(const fs::path& output) {
  return output.string() + ".stuck.h5";
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// How a stage ended, for a person.
std::string end_text(const StageRecord& record) {
  const Estimate& mean = record.mean_packing_fraction;
  const std::string text =
      fmt::format("{}; packing fraction {:.6g}", record.report.reason, record.packing_fraction);
  if (!(mean.mean > 0)) return text;
  return text +
         (std::isfinite(mean.error)
              ? fmt::format(", in the second half {:.6g} ± {:.2g}", mean.mean, mean.error)
              : fmt::format(", in the second half {:.6g}, too few sweeps for an error", mean.mean));
}

Estimate mean_of_second_half(const std::vector<double>& series) {
  return block_average(std::span(series).subspan(series.size() / 2));
}

template <int Dim>
class Preparer {
 public:
  Preparer(const PrepareRequest& request, const RunControl& control,
           const std::function<void(const std::string&)>& say)
      : request_(request), parameters_(request.parameters), say_(say), control_(control) {
    control_.on_resumable = [this] { save_now_and_then(); };
    stored_.parameters = effective_parameters(parameters_);
  }

  Preparation<Dim> run() {
    if (keeps_files() && checkpoint_exists(checkpoint()))
      load();
    else
      draw();
    while (done().stages.size() < parameters_.stages.size()) {
      say_(description());
      if (!run_stage()) {
        if (has_places() && keeps_files()) save();
        return done();
      }
    }
    keep_time();
    done().check = exact_check(done().configuration);
    if (!done().check.clean())
      throw InvariantError(
          "the prepared state has overlapping particles; this is a defect of the program");
    done().complete = true;
    return done();
  }

 private:
  const PrepareStage& stage() const { return parameters_.stages[done().stages.size()]; }
  Preparation<Dim>& done() { return stored_.done; }
  const Preparation<Dim>& done() const { return stored_.done; }
  std::uint64_t seed() const { return parameters_.system.seed; }
  /// The first stage places the particles; what is not placed is not worth keeping.
  bool has_places() const { return !done().stages.empty(); }

  void draw() {
    const SystemParameters& system = parameters_.system;
    const auto particles = static_cast<std::size_t>(system.particles);
    if constexpr (Dim == 2)
      done().configuration = draw_particles(parameters_.species, particles, system.packing_fraction,
                                            system.box_aspect, system.seed);
    else
      done().configuration =
          draw_solids(parameters_.species, particles, system.packing_fraction, system.seed);
  }

  // ---- files ----------------------------------------------------------------------------------------

  bool keeps_files() const { return !request_.output.empty(); }
  fs::path checkpoint() const { return checkpoint_path(request_.output); }

  void load() {
    const LoadedCheckpoint loaded = load_checkpoint(checkpoint());
    if (!loaded.warning.empty()) say_(loaded.warning);
    if (const auto change =
            forbidden_change(loaded.checkpoint.parameters, stored_.parameters, Work::preparation))
      throw UserError(
          fmt::format("{}: the preparation was begun with {} = {}, but now it is {}; continue it "
                      "with its own parameters, or delete this file",
                      checkpoint().string(), change->key, change->first, change->second));
    stored_ = preparation_from_checkpoint<Dim>(loaded.checkpoint, checkpoint());
    wall_before_ = done().wall_seconds;
    stage_before_ = stored_.work.wall_seconds;
    say_(fmt::format("continuing at stage {} of {}",
                     std::min(done().stages.size() + 1, parameters_.stages.size()),
                     parameters_.stages.size()));
  }

  void keep_time() {
    done().wall_seconds = wall_before_ + seconds_since(start_);
    stored_.work.wall_seconds = stage_before_ + seconds_since(stage_start_);
  }

  void save() {
    keep_time();
    save_checkpoint(checkpoint(), to_checkpoint(stored_));
    saved_ = Clock::now();
  }

  void save_now_and_then() {
    if (keeps_files() && seconds_since(saved_) >= parameters_.output.checkpoint_interval) save();
  }

  // ---- stages ---------------------------------------------------------------------------------------

  /// False if the run control asked to stop.
  bool run_stage() {
    stage_start_ = Clock::now();
    const StageReport report = advance();
    keep_time();
    if (report.end == StageEnd::stopped) return false;
    if (report.end == StageEnd::stalled) refuse_stuck(report);
    note_stage(report);
    stored_.work = StageWork(done().next_sweep);
    stage_before_ = 0;
    save_now_and_then();
    return true;
  }

  StageReport advance() {
    Configuration<Dim>& configuration = done().configuration;
    if (stage().method == Method::insert)
      return insert_particles(configuration, {goal(), stage().attempts, aligned()}, seed(),
                              control_);
    if (stage().method == Method::grow)
      return at_rest(grow(configuration, growth_options(), stored_.work.growth, control_));
    if constexpr (Dim == 2) return advance_ellipses();
    throw std::logic_error("a stage that three dimensions do not have");
  }

  /// What there is in two dimensions only.
  StageReport advance_ellipses() {
    Configuration2& configuration = done().configuration;
    StageWork& work = stored_.work;
    switch (stage().method) {
      case Method::lattice:
        return place_on_lattice(configuration, stage().lattice, seed());
      case Method::swell:
        return swell(configuration, {goal(), stage().most_sweeps, request_.threads}, seed(),
                     work.swelling, control_);
      case Method::compress:
        return compress(configuration, compression_options(), seed(), work.compression, control_);
      case Method::hybrid:
        return at_rest(hybrid(configuration, hybrid_options(), work.hybrid, control_));
      case Method::sample:
        return sample(configuration, sampling_options(stage().sweeps), seed(), work.sampling,
                      control_);
      default:
        return {};
    }
  }

  double goal() const {
    return end_of_stage(stage(), parameters_.system, packing_fraction_before());
  }
  double packing_fraction_before() const {
    return has_places() ? done().stages.back().packing_fraction : 0;
  }
  bool aligned() const { return stage().orientations == PrepareStage::Orientations::aligned; }

  /// Of growth and hybrid: without a pressure there must be a packing fraction.
  std::optional<double> packing_fraction_goal() const {
    return stage().reduced_pressure ? stage().packing_fraction : goal();
  }

  CompressionOptions compression_options() const {
    return {stage().pressure, stage().box, stage().packing_fraction,
            stage().packing_fraction ? stage().most_sweeps : stage().sweeps, request_.threads};
  }

  GrowthOptions growth_options() const {
    return {stage().growth_rate, packing_fraction_goal(), stage().reduced_pressure, seed()};
  }

  HybridOptions hybrid_options() const {
    return {stage().growth_rate, packing_fraction_goal(), stage().reduced_pressure,
            sampling_options(stage().stretch_sweeps), seed()};
  }

  SamplingOptions sampling_options(std::uint64_t sweeps) const {
    return {sweeps, stage().moves, stage().exchanges, request_.threads};
  }

  // A stage that is stopped keeps its velocities, to go on with.
  StageReport at_rest(const StageReport& report) {
    if (report.end == StageEnd::stopped) return report;
    Configuration<Dim>& configuration = done().configuration;
    std::ranges::fill(configuration.velocity, Vec<Dim>::Zero());
    std::ranges::fill(configuration.angular_velocity, Motion<Dim>().angular_velocity);
    return report;
  }

  void note_stage(const StageReport& report) {
    const StageWork& work = stored_.work;
    StageRecord record;
    record.report = report;
    record.packing_fraction = packing_fraction(done().configuration);
    // All but those of the method at work are 0.
    for (const SweepState* moves : {&work.sampling.local, &work.swelling.moves,
                                    &work.compression.moves, &work.hybrid.sampling.local})
      record.sweeps += moves->sweeps, record.trials.add(moves->counts);
    for (const ChainState* chains : {&work.sampling.chains, &work.hybrid.sampling.chains}) {
      record.sweeps += chains->sweeps;
      record.chain_contacts += chains->counts.contacts;
      record.trials.rotations_tried += chains->counts.rotations_tried;
      record.trials.rotations_accepted += chains->counts.rotations_accepted;
    }
    record.growth = stage().method == Method::hybrid ? work.hybrid.growth : work.growth;
    if (stage().method == Method::compress && !stage().packing_fraction)
      record.mean_packing_fraction = mean_of_second_half(work.compression.packing_fraction);
    record.wall_seconds = work.wall_seconds;
    say_("  " + end_text(record));
    done().next_sweep += record.sweeps;
    done().stages.push_back(record);
  }

  [[noreturn]] void refuse_stuck(const StageReport& report) const;

  /// What the stage does, in a few words.
  std::string description() const;
  std::string goal_text() const {
    return stage().reduced_pressure
               ? fmt::format("reduced pressure {:.4g}", *stage().reduced_pressure)
               : fmt::format("packing fraction {:.4g}", goal());
  }

  const PrepareRequest& request_;
  const Parameters& parameters_;
  const std::function<void(const std::string&)>& say_;
  RunControl control_;
  StoredPreparation<Dim> stored_;
  double wall_before_ = 0, stage_before_ = 0;  // seconds that other processes spent
  Clock::time_point start_ = Clock::now(), stage_start_ = start_, saved_ = start_;
};

template <int Dim>
void Preparer<Dim>::refuse_stuck(const StageReport& report) const {
  std::string kept;
  if (has_places() && keeps_files()) {
    const fs::path path = stuck_state_path(request_.output);
    write_state(path, done().configuration,
                current_provenance(request_.command_line, stored_.parameters, seed()), true);
    // To go on from the same place with the same parameters would lead to the same end.
    forget_preparation(request_.output);
    kept = "; the state is in " + path.string();
  }
  throw UserError(fmt::format("preparation, {}: {}{}", description(), report.reason, kept));
}

template <int Dim>
std::string Preparer<Dim>::description() const {
  switch (stage().method) {
    case Method::lattice:
      return fmt::format("lattice at packing fraction {:.4g}", goal());
    case Method::insert:
      return fmt::format("insert at packing fraction {:.4g}", goal());
    case Method::swell:
      return fmt::format("swell to packing fraction {:.4g}", goal());
    case Method::compress:
      return stage().packing_fraction ? fmt::format("compress to packing fraction {:.4g}", goal())
                                      : fmt::format("compress at pressure {:.4g} for {} sweeps",
                                                    stage().pressure, stage().sweeps);
    case Method::grow:
    case Method::hybrid:
      return fmt::format("{} to {}", stage().method == Method::grow ? "grow" : "hybrid",
                         goal_text());
    case Method::sample:
      return fmt::format("sample for {} sweeps", stage().sweeps);
  }
  return "";
}

}  // namespace

template <int Dim>
TrialCounts Preparation<Dim>::trials() const {
  TrialCounts all;
  for (const StageRecord& stage : stages) all.add(stage.trials);
  return all;
}

template <int Dim>
Preparation<Dim> prepare(const PrepareRequest& request, const RunControl& control,
                         const std::function<void(const std::string&)>& say) {
  assert(request.parameters.system.dimension == Dim);
  return Preparer<Dim>(request, control, say).run();
}

template struct Preparation<2>;
template struct Preparation<3>;
template Preparation<2> prepare<2>(const PrepareRequest&, const RunControl&,
                                   const std::function<void(const std::string&)>&);
template Preparation<3> prepare<3>(const PrepareRequest&, const RunControl&,
                                   const std::function<void(const std::string&)>&);

void forget_preparation(const fs::path& output) {
  remove_checkpoint(checkpoint_path(output));
}

}  // namespace vitrel
