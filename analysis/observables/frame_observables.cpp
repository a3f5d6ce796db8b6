#include "analysis/observables/frame_observable.h"

#include <algorithm>
#include <iterator>

namespace vitrel {

// Each of these has a source file of its own, and a line in the list below.
template <int Dim>
FrameObservableType<Dim> structure_factor_observable();
template <int Dim>
FrameObservableType<Dim> pair_correlation_observable();
template <int Dim>
FrameObservableType<Dim> orientation_observable();
template <int Dim>
FrameObservableType<Dim> order_observable();
template <int Dim>
FrameObservableType<Dim> velocity_observable();
FrameObservableType<3> two_point_observable();

namespace {

/// Returns the list of all observables; a new one is added here.
template <int Dim>
std::vector<FrameObservableType<Dim>> types() {
  std::vector<FrameObservableType<Dim>> all = {
      structure_factor_observable<Dim>(), pair_correlation_observable<Dim>(),
      orientation_observable<Dim>(), order_observable<Dim>(), velocity_observable<Dim>()};
  if constexpr (Dim == 3) all.push_back(two_point_observable());
  return all;
}

template <int Dim>
using FrameObservables = std::vector<std::unique_ptr<FrameObservable<Dim>>>;

template <int Dim>
bool has(const Needs& needs, const Configuration<Dim>& first, const StructureOptions& options) {
  return (!needs.averages || options.max_frames > 0) && (!needs.rotors || rotor_count(first) > 0) &&
         (!needs.velocities || mechanics(first).translational_energy > 0);
}

bool is_wanted(const std::vector<Observable>& tables, const std::vector<std::string>& only) {
  return only.empty() || std::ranges::any_of(tables, [&](const Observable& table) {
           return std::ranges::find(only, table.table) != only.end();
         });
}

template <int Dim>
FrameObservables<Dim> observables_of(const Configuration<Dim>& first,
                                     const StructureOptions& options,
                                     const std::vector<std::string>& only) {
  FrameObservables<Dim> observables;
  for (const FrameObservableType<Dim>& type : types<Dim>())
    if (is_wanted(type.tables, only) && has(type.tables.front().needs, first, options))
      observables.push_back(type.make(first, options));
  return observables;
}

/// Returns the number of frames that the threads share at a time, which is smaller for many particles to save memory.
std::size_t frames_at_once(std::size_t particles) {
  constexpr std::size_t fewest = 4, most = 32, particles_at_once = 1'000'000;
  return std::clamp(particles_at_once / std::max<std::size_t>(1, particles), fewest, most);
}

/// Measures some frames at once.
template <int Dim>
void measure_batch(const std::vector<Configuration<Dim>>& frames,
                   const FrameObservables<Dim>& observables, int threads) {
  std::vector<std::function<void()>> contributions(frames.size() * observables.size());
  each_in_parallel(frames.size(), threads, [&](std::size_t k) {
    for (std::size_t o = 0; o < observables.size(); ++o)
      contributions[k * observables.size() + o] = observables[o]->measure(frames[k]);
  });
  for (const std::function<void()>& add : contributions) add();
}

}  // namespace

std::vector<Observable> frame_observables(int dimension) {
  std::vector<Observable> tables;
  const auto add = [&](const auto& all) {
    for (const auto& type : all)
      tables.insert(tables.end(), type.tables.begin(), type.tables.end());
  };
  dimension == 2 ? add(types<2>()) : add(types<3>());
  return tables;
}

std::size_t frames_for(std::size_t particles, const StructureOptions& options) {
  constexpr std::size_t particles_at_all = 5'000'000, fewest = 64;
  const std::size_t wanted =
      options.max_frames > 0 ? options.max_frames : StructureOptions{}.max_frames;
  return std::min(wanted, std::max(fewest, particles_at_all / std::max<std::size_t>(1, particles)));
}

template <int Dim>
FrameResults measure_frames(Trajectory<Dim>& trajectory, const StructureOptions& options,
                            int threads, const ProgressReport& report,
                            const std::vector<std::string>& only) {
  const Configuration<Dim>& first = trajectory.read(0);
  const FrameObservables<Dim> observables = observables_of(first, options, only);
  if (observables.empty()) return {};
  const std::size_t frames = trajectory.frames();
  const std::size_t max_frames = frames_for(first.size(), options);
  const std::size_t stride = (frames + max_frames - 1) / max_frames;
  const std::size_t at_once = frames_at_once(first.size());
  std::vector<double> times;
  for (std::size_t next = 0; next < frames;) {
    std::vector<Configuration<Dim>> batch;
    for (; next < frames && batch.size() < at_once; next += stride) {
      batch.push_back(trajectory.read(next));
      times.push_back(batch.back().time);
    }
    measure_batch(batch, observables, threads);
    const auto done = static_cast<double>(std::min(next, frames));
    if (report) report({done / static_cast<double>(frames), done, "frames"});
  }
  const bool is_even = evenly_spaced(times);
  FrameResults results;
  for (const auto& observable : observables) {
    std::ranges::move(observable->tables(is_even), std::back_inserter(results.tables));
    observable->add_order(results.order);
  }
  return results;
}

Column averaged(const std::string& name, const std::string& unit, const FrameAverage& rows,
                bool is_even, std::span<const double> slower) {
  Averages averages = rows.averages(is_even, slower);
  return {name, unit, std::move(averages.mean), std::move(averages.error)};
}

template FrameResults measure_frames(Trajectory2&, const StructureOptions&, int,
                                     const ProgressReport&, const std::vector<std::string>&);
template FrameResults measure_frames(Trajectory3&, const StructureOptions&, int,
                                     const ProgressReport&, const std::vector<std::string>&);

}  // namespace vitrel
