#include "mc/sampling.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <string>

#include "mc/place_correlation.h"
#include "mc/sampler.h"

namespace vitrel {

namespace {

/// Calls visit(x) for every number that describes the pose of particle i.
void each_number(auto& c, std::size_t i, auto&& visit) {
  for (auto& x : c.position[i]) visit(x);
  for (auto& n : c.image[i]) visit(n);
  if constexpr (requires { c.angle; })
    visit(c.angle[i]);
  else
    for (auto& q : c.orientation[i].coeffs()) visit(q);
}

template <int Dim>
std::vector<double> numbers_of(const Configuration<Dim>& c) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < c.size(); ++i)
    each_number(c, i, [&](const auto& x) { numbers.push_back(static_cast<double>(x)); });
  return numbers;
}

template <int Dim>
Configuration<Dim> with_numbers(Configuration<Dim> c, const std::vector<double>& numbers) {
  auto next = numbers.begin();
  for (std::size_t i = 0; i < c.size(); ++i)
    each_number(c, i, [&]<class X>(X& x) { x = static_cast<X>(*next++); });
  return c;
}

/// Counts how often a configuration has decorrelated (DecorrelationState).
template <int Dim>
class DecorrelationCount {
 public:
  /// Begins with this configuration, or continues from `state`; both must outlive this object.
  DecorrelationCount(const Configuration<Dim>& configuration, DecorrelationState& state,
                     std::uint64_t sweeps)
      : configuration_(configuration), state_(state) {
    if (state.first.empty())
      begin(sweeps);
    else
      correlation_.emplace(with_numbers(configuration, state.first));
  }

  /// Takes note of a sweep; `sweeps` is the number of all sweeps so far.
  void update(std::uint64_t sweeps) {
    if (sweeps < state_.next) return;
    compare();
    if (state_.places && state_.orientations && state_.sizes) {
      ++state_.count;
      begin(sweeps);
    } else {
      state_.next = sweeps + 1 + (sweeps - state_.begin) / 10;
    }
  }

 private:
  void begin(std::uint64_t sweeps) {
    state_.places = state_.orientations = state_.sizes = false;
    state_.begin = sweeps;
    state_.next = sweeps + 1;
    state_.first = numbers_of(configuration_);
    correlation_.emplace(configuration_);
  }
  void compare() {
    constexpr double decayed = 1 / std::numbers::e;
    const PlaceCorrelations now = correlation_->with(configuration_);
    state_.places |= now.places < decayed;
    state_.orientations |= now.orientations < decayed;
    state_.sizes |= now.sizes < decayed;
  }

  const Configuration<Dim>& configuration_;
  DecorrelationState& state_;
  std::optional<PlaceCorrelation<Dim>> correlation_;
};

/// Returns how far the stage is, by its sweeps or its decorrelations.
Progress progress(const SamplingOptions& options, const SamplingState& state) {
  const auto sweeps = static_cast<double>(state.sweeps());
  const double share = sweeps / static_cast<double>(options.sweeps);
  if (options.decorrelations == 0) return {share, sweeps, "sweep"};
  const auto count = static_cast<double>(state.decorrelation.count);
  return {std::max(share, count / static_cast<double>(options.decorrelations)), count,
          "decorrelation"};
}

/// `sampler` is a Sampler or an EventChain, and `own` its part of the state.
template <int Dim, class AnySampler, class State>
StageEnd run_sweeps(const Configuration<Dim>& configuration, AnySampler& sampler, State& own,
                    const SamplingOptions& options, std::uint64_t sweeps_between_tunings,
                    SamplingState& state, const RunControl& control) {
  std::optional<DecorrelationCount<Dim>> count;
  if (options.decorrelations > 0) count.emplace(configuration, state.decorrelation, own.sweeps);
  const auto decorrelated = [&] {
    return count && state.decorrelation.count >= options.decorrelations;
  };
  while (own.sweeps < options.sweeps && !decorrelated()) {
    if (control.stop_requested()) return StageEnd::stopped;
    sampler.sweep();
    if (sampler.state().sweeps % sweeps_between_tunings == 0) sampler.tune();
    own = sampler.state();
    if (count) count->update(own.sweeps);
    control.report_progress(progress(options, state));
    control.notify_resumable();
  }
  return count && !decorrelated() ? StageEnd::stalled : StageEnd::reached;
}

std::string work_text(const SamplingOptions& options, const SamplingState& state) {
  if (options.decorrelations == 0) return "all sweeps were completed";
  return fmt::format("decorrelated {} times in {} sweeps", state.decorrelation.count,
                     state.sweeps());
}

std::string end_text(const SamplingOptions& options, const SamplingState& state) {
  const ChainCounts& counts = state.chains.counts;
  const std::string all = work_text(options, state);
  if (counts.cut_short == 0) return all;
  return fmt::format(
      "{}, but {} of {} chains were cut short in jammed rows, which violates balance", all,
      counts.cut_short, counts.chains);
}

}  // namespace

template <int Dim>
StageReport sample(Configuration<Dim>& configuration, const SamplingOptions& options,
                   std::uint64_t seed, SamplingState& state, const RunControl& control) {
  StageEnd end;
  if (options.moves == Moves::chains) {
    EventChain chains(configuration, {.exchanges = options.exchanges}, seed, state.chains);
    end = run_sweeps(configuration, chains, state.chains, options, 1, state, control);
  } else {
    Sampler sampler(configuration, seed, state.local, options.threads);
    sampler.set_exchanges(options.exchanges);
    end =
        run_sweeps(configuration, sampler, state.local, options, sweeps_per_tuning, state, control);
  }
  if (end == StageEnd::stopped) return {end, "sampling was stopped"};
  if (end == StageEnd::stalled)
    return {end, fmt::format("only {} of {} decorrelations within max_sweeps = {}; raise it, or "
                             "exchange places",
                             state.decorrelation.count, options.decorrelations, options.sweeps)};
  return {end, end_text(options, state)};
}

template StageReport sample(Configuration2&, const SamplingOptions&, std::uint64_t, SamplingState&,
                            const RunControl&);
template StageReport sample(Configuration3&, const SamplingOptions&, std::uint64_t, SamplingState&,
                            const RunControl&);

}  // namespace vitrel
