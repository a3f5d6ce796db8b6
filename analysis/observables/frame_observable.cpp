#include "analysis/observables/frame_observable.h"

#include <algorithm>

namespace vitrel {

namespace {

/// Frames shared by the threads at a time.
constexpr std::size_t frames_at_once = 32;

/// Measures some frames at once.
template <int Dim>
void measure_batch(const std::vector<Configuration<Dim>>& frames,
                   const FrameObservables<Dim>& observables, int threads) {
  std::vector<std::function<void()>> contributions(frames.size() * observables.size());
  in_parallel(frames.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      for (std::size_t o = 0; o < observables.size(); ++o)
        contributions[k * observables.size() + o] = observables[o]->measure(frames[k]);
  });
  for (const std::function<void()>& add : contributions) add();
}

}  // namespace

template <int Dim>
FrameObservables<Dim> frame_observables(const Configuration<Dim>& first,
                                        const StructureOptions& options) {
  FrameObservables<Dim> observables;
  const bool has_rotors = rotor_count(first) > 0;
  if (options.max_frames > 0) {
    observables.push_back(structure_factor_observable(first, options.shells));
    observables.push_back(pair_correlation_observable(first, options.pairs));
    if (has_rotors) observables.push_back(orientation_observable(first));
  }
  if (Dim == 2 || has_rotors) observables.push_back(order_observable(first));
  if (options.max_frames == 0) return observables;
  if (mechanics(first).translational_energy > 0) observables.push_back(velocity_observable<Dim>());
  return observables;
}

template <int Dim>
std::vector<Table> structure_tables(Trajectory<Dim>& trajectory, const StructureOptions& options,
                                    int threads, const ProgressReport& report) {
  const FrameObservables<Dim> observables = frame_observables(trajectory.read(0), options);
  if (observables.empty()) return {};
  const std::size_t frames = trajectory.frames();
  const std::size_t max_frames =
      options.max_frames > 0 ? options.max_frames : StructureOptions{}.max_frames;
  const std::size_t stride = (frames + max_frames - 1) / max_frames;
  std::vector<double> times;
  for (std::size_t next = 0; next < frames;) {
    std::vector<Configuration<Dim>> batch;
    for (; next < frames && batch.size() < frames_at_once; next += stride) {
      batch.push_back(trajectory.read(next));
      times.push_back(batch.back().time);
    }
    measure_batch(batch, observables, threads);
    const auto done = static_cast<double>(std::min(next, frames));
    if (report) report({done / static_cast<double>(frames), done, "frames"});
  }
  const bool is_even = evenly_spaced(times);
  std::vector<Table> tables;
  for (const auto& observable : observables)
    for (Table& table : observable->tables(is_even)) tables.push_back(std::move(table));
  return tables;
}

Column averaged(const std::string& name, const std::string& unit, const FrameAverage& rows,
                bool is_even) {
  Averages averages = rows.averages(is_even);
  return {name, unit, std::move(averages.mean), std::move(averages.error)};
}

template FrameObservables<2> frame_observables(const Configuration2&, const StructureOptions&);
template FrameObservables<3> frame_observables(const Configuration3&, const StructureOptions&);
template std::vector<Table> structure_tables(Trajectory2&, const StructureOptions&, int,
                                             const ProgressReport&);
template std::vector<Table> structure_tables(Trajectory3&, const StructureOptions&, int,
                                             const ProgressReport&);

}  // namespace vitrel
