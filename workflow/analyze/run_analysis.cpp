#include "workflow/analyze/run_analysis.h"

#include <algorithm>

#include "analysis/dynamics/four_point.h"
#include "analysis/dynamics/time_axis.h"
#include "analysis/dynamics/van_hove.h"
#include "analysis/glass/glass_data.h"
#include "analysis/structure/orientation_tensor.h"
#include "core/special_values.h"
#include "workflow/configuration/hard_contacts.h"

namespace vitrel {
namespace {

void begin(const AnalysisProgress& progress, const char* phase) {
  if (progress.begin) progress.begin(phase);
}

/// Whether any requested table needs more than single frames.
bool wants_motion(const TableChoice& wanted) {
  return wanted.has({"summary", "displacements", "self_scattering", "orientation", "cage_relative",
                     "collective_scattering", "wave_numbers", "susceptibility", "ageing",
                     "waiting_times", "relaxation", "relaxation_times", "viscosity"});
}

/// Collective scattering comes first: it is short and refuses wave numbers that do not fit into the box.
template <int Dim>
RunDynamics measure_dynamics(TrajectoryFile<Dim>& trajectory, DisplacementOptions options,
                             const TableChoice& wanted, const AnalysisProgress& progress) {
  options.wave_numbers = wave_numbers_or_main(std::move(options.wave_numbers), trajectory.read(0));
  options.parts = {
      .displacement = wanted.has({"displacements", "summary", "relaxation", "viscosity"}),
      .scattering = wanted.has({"self_scattering", "relaxation_times", "relaxation"}),
      .orientation = wanted.has({"orientation", "relaxation_times", "relaxation"}),
      .overlap = wanted.has({"susceptibility"})};
  RunDynamics dynamics;
  if (wanted.has({"collective_scattering", "wave_numbers"})) {
    begin(progress, "collective scattering");
    dynamics.collective = collective_scattering(trajectory, options.wave_numbers, options.axis,
                                                progress.report, options.threads);
  }
  if constexpr (Dim == 2)
    if (wanted.has({"cage_relative", "relaxation_times", "relaxation"})) {
      begin(progress, "cage-relative displacements");
      dynamics.cage_relative = cage_relative(trajectory, options, progress.report);
    }
  begin(progress, "displacements");
  dynamics.displacements = displacements(trajectory, options, progress.report);
  if (!options.waiting_times.empty() && wanted.has({"ageing", "waiting_times"})) {
    begin(progress, "ageing");
    dynamics.ageing = ageing(trajectory, options, progress.report);
  }
  return dynamics;
}

/// Measures velocity correlations and functions of two times; measure_dynamics does the rest of the motion.
template <int Dim>
RunMotion measure_motion(TrajectoryFile<Dim>& trajectory, const Parameters& parameters,
                         const TableChoice& wanted, const AnalysisProgress& progress) {
  RunMotion motion{.dimension = Dim};
  if (wanted.has({"velocity_autocorrelation", "velocity_spectrum"}) &&
      mechanics(trajectory.read(0)).translational_energy > 0) {
    begin(progress, "velocities");
    motion.velocities = velocity_correlations(trajectory, parameters.analysis, progress.report);
  }
  if (!wanted.has({"van_hove_self", "van_hove_distinct", "four_point_structure"})) return motion;
  begin(progress, "functions of two times");
  const Configuration<Dim> first = trajectory.read(0);
  const DisplacementOptions& options = parameters.analysis;
  const PairCorrelationOptions& pairs = parameters.structure.pairs;
  TimeAxisOptions axis = options.axis;
  axis.max_origins = std::min(axis.max_origins, origins_for(first.size(), few_origins));
  motion.lags = few_lags_of_motion(trajectory, axis);
  motion.two_times = average_two_times<Dim>(
      trajectory, motion.lags,
      {van_hove_self<Dim>(pairs), van_hove_distinct(first, motion.lags, pairs),
       four_point_structure(first.box, options.overlap_distance)},
      progress.report, options.threads);
  return motion;
}

/// The coefficient from the long-time slope of a mean squared displacement or rotation with `dimension` components.
DiffusionCoefficient long_time_diffusion(const Displacements& found, const Correlation& square,
                                         int dimension, const std::vector<double>& times) {
  const double duration = evenly_spaced(times) ? times.back() - times.front() : 0;
  return diffusion_coefficient({found.lag, square.value, square.error, duration}, dimension);
}

/// Returns NaN if the file does not store collisions.
double collisions_between_frames(const TrajectoryReader& reader) {
  if (!reader.has_observable("collisions")) return unknown;
  const std::vector<double> collisions = reader.observable("collisions");
  return collisions.back() - collisions.front();
}

/// Returns the judged run, or no value if the run lacks the data.
template <int Dim>
std::optional<GlassRun> measure_glass(TrajectoryFile<Dim>& trajectory, const std::string& name,
                                      const RunAnalysis& run, const Parameters& parameters,
                                      const AnalysisProgress& progress) {
  const auto& cage = run.dynamics->cage_relative;
  const GlassSource source{.name = name,
                           .seed = trajectory.reader().provenance().seed,
                           .packing_fraction = run.packing_fraction,
                           .rotors = run.rotors,
                           .starts_in_equilibrium = end_in_equilibrium(parameters.stages),
                           .displacements = run.dynamics->displacements,
                           .cage_relative = cage ? &*cage : nullptr,
                           .compressibility = run.compressibility,
                           .order = run.structure.order,
                           .diffusion = run.diffusion,
                           .rotational_diffusion = run.rotational_diffusion};
  begin(progress, "relaxation and halves");
  const auto data = glass_run_data(trajectory, source, parameters.analysis, progress.report);
  if (!data) return std::nullopt;
  return judge_glass_run(*data);
}

/// A time within which the stress decays: by then particles have moved by a unit of length, which takes them out of
/// their cages in a liquid, and each has collided ten times.
double stress_relaxation_time(const RunAnalysis& run) {
  const Displacements& found = run.dynamics->displacements;
  const std::vector<double>& square = found.groups.front().translation.value;
  const auto moved = std::ranges::find_if(square, [](double value) { return value >= 1; });
  if (moved == square.end()) return unknown;
  const double ten_collisions =
      5 * static_cast<double>(run.particles) * run.duration / run.collisions;
  return std::max(found.lag[static_cast<std::size_t>(moved - square.begin())], ten_collisions);
}

template <int Dim>
std::optional<Viscosity> measure_viscosity(TrajectoryFile<Dim>& trajectory, const RunAnalysis& run,
                                           const TimeAxisOptions& axis) {
  const auto moments = helfand_moments(trajectory.reader());
  // A file of another program may have moments without energies, and a single particle has no temperature.
  if (moments.empty() || run.energy.time.empty() || run.particles < 2) return std::nullopt;
  const Configuration<Dim>& state = trajectory.read(0);
  const double temperature = mean_temperature(run.energy, run.particles, run.rotations, Dim);
  return shear_viscosity(trajectory.times(), moments,
                         {state.box.volume(), temperature, stress_relaxation_time(run)}, axis);
}

DiffusionCoefficient rotational_diffusion(const Displacements& found, std::size_t rotors,
                                          int dimension, const std::vector<double>& times) {
  if (rotors == 0) return no_coefficient("no particle can turn");
  if (!found.unknown_turns.empty()) return no_coefficient(found.unknown_turns);
  // Bodies of revolution do not spin about their axes: ⟨|Δφ|²⟩ = 4 D_r t.
  const int rotations = dimension == 2 ? 1 : found.axes == 3 ? 3 : 2;
  return long_time_diffusion(found, found.groups.front().rotation, rotations, times);
}

/// Columns of the summary that describe a single configuration; only three dimensions have some.
std::vector<Column> state_columns(const Configuration2&) {
  return {};
}

std::vector<Column> state_columns(const Configuration3& state) {
  const OrientationTensor tensor = orientation_tensor(state);
  const IsotropicRatio isotropic = isotropic_ratio(tensor.axes);
  const Vec3& box = state.box.lengths();
  return {{"box_x", "length", {box.x()}},
          {"box_y", "length", {box.y()}},
          {"box_z", "length", {box.z()}},
          {"orientation_ratio", "1", {tensor.ratio()}},
          {"isotropic_ratio", "1", {isotropic.mean}},
          {"isotropic_ratio_deviation", "1", {isotropic.standard_deviation}}};
}

/// Contacts are taken to be smooth if the file does not record them.
Contacts recorded_contacts(const TrajectoryReader& reader) {
  const std::string recorded = reader.provenance().parameters;
  if (recorded.empty()) return Contacts::smooth;
  return contacts_of(recorded_parameters(recorded, reader.path().string()).dynamics);
}

template <int Dim>
void describe_run(RunAnalysis& run, TrajectoryFile<Dim>& trajectory) {
  const std::vector<double>& times = trajectory.times();
  const Configuration<Dim>& state = trajectory.read(trajectory.frames() - 1);
  run.particles = state.size();
  run.rotors = rotor_count(state);
  run.rotations = rotation_count(state, recorded_contacts(trajectory.reader()));
  run.packing_fraction = packing_fraction(state);
  run.state = state_columns(state);
  run.frames = trajectory.frames();
  run.duration = times.back() - times.front();
  run.collisions = collisions_between_frames(trajectory.reader());
}

}  // namespace

template <int Dim>
RunAnalysis run_analysis(TrajectoryFile<Dim>& trajectory, const std::string& name,
                         const Parameters& parameters, const TableChoice& wanted,
                         const AnalysisProgress& progress) {
  const TrajectoryReader& reader = trajectory.reader();
  const std::vector<double>& times = trajectory.times();
  RunAnalysis run{};
  describe_run(run, trajectory);
  run.obstacle = reader.obstacle_to_motion();
  if (run.obstacle.empty() && !reader.doubtful_frames().empty() &&
      time_axis_of_motion(trajectory).empty())
    run.obstacle =
        "between any two frames some particle moved by more than a quarter of a box length, so "
        "that its box crossings are in doubt";
  if (run.obstacle.empty() && wants_motion(wanted))
    run.dynamics = measure_dynamics(trajectory, parameters.analysis, wanted, progress);
  if (run.obstacle.empty()) run.motion = measure_motion(trajectory, parameters, wanted, progress);
  begin(progress, "structure");
  std::vector<std::string> of_frames = wanted.tables();
  if (!of_frames.empty() && wanted.has({"relaxation"})) of_frames.emplace_back("order");
  run.structure =
      measure_frames(trajectory, parameters.structure, all_cores, progress.report, of_frames);
  if (wanted.has({"energies", "compressibility_factor", "summary", "relaxation", "viscosity"})) {
    run.energy = observed_energies(reader);
    if (run.energy.time.empty() && reader.has("velocity")) run.energy = energies(trajectory);
  }
  run.compressibility = stored_compressibility(reader, run.energy, run.rotations);
  run.diffusion = run.rotational_diffusion = no_coefficient(run.obstacle);
  if (!run.dynamics || !run.dynamics->displacements.parts.displacement) return run;
  const Displacements& found = run.dynamics->displacements;
  run.diffusion = long_time_diffusion(found, found.groups.front().translation, Dim, times);
  run.rotational_diffusion = rotational_diffusion(found, run.rotors, Dim, times);
  if (wanted.has({"viscosity", "summary"}))
    run.motion->viscosity = measure_viscosity(trajectory, run, parameters.analysis.axis);
  if (wanted.has({"relaxation"}))
    run.glass = measure_glass(trajectory, name, run, parameters, progress);
  return run;
}

template RunAnalysis run_analysis(TrajectoryFile<2>&, const std::string&, const Parameters&,
                                  const TableChoice&, const AnalysisProgress&);
template RunAnalysis run_analysis(TrajectoryFile<3>&, const std::string&, const Parameters&,
                                  const TableChoice&, const AnalysisProgress&);

}  // namespace vitrel
