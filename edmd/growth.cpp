#include "edmd/growth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/elementary.h"
#include "core/error.h"
#include "core/state/typical_scales.h"
#include "core/tolerances.h"
#include "edmd/brownian.h"

namespace vitrel {

namespace {

/// Maximum growth of all lengths in one block, since neighbour lists are made for the sizes at its start.
constexpr double max_block_growth = 0.2;
/// Maximum growth between two rescalings, times Z. It is small, so that kT (which rises by twice as much) and Z change
/// little.
constexpr double max_step_compression = 0.05;
/// Relative growth of the box by which jammed particles become fluid again.
constexpr double retry_expansion = 0.1;
/// Growth that holds enough collisions to measure the pressure, even of a gas.
constexpr double min_pressure_growth = 0.005;
/// From this reduced pressure on, a packing fraction that is higher by more than a share 30/Z is out of reach.
constexpr double nearly_jammed = 1e4, within_reach = 30;

/// Returns the time average of a temperature that rises exponentially from 1 to `end`.
double mean_of_rise(double end) {
  const double rise = end - 1;
  return rise == 0 ? 1 : rise / logarithm_of_one_plus(rise);
}

/// Returns sqrt(target/energy), or 1 if there is no energy to scale.
double scale_to(double target, double energy) {
  return energy > 0 ? std::sqrt(target / energy) : 1;
}

template <int Dim>
class Growth {
 public:
  Growth(Configuration<Dim>& configuration, const GrowthOptions& options, GrowthState& state)
      : configuration_(configuration),
        options_(options),
        state_(state),
        shapes_(configuration.shape),
        typical_time_(typical_time(configuration)),
        start_time_(configuration.time),
        start_fraction_(vitrel::packing_fraction(configuration)),
        translations_(0.5 * Dim * (static_cast<double>(configuration.size()) - 1)),
        rotations_(0.5 * static_cast<double>(rotation_count(configuration))) {
    check();
    make_engine_at_rate();
  }

  StageReport run(const RunControl& control) {
    if (!state_.under_way) begin();
    while (true) {
      if (at_packing_fraction())
        return ended(StageEnd::reached, "the packing fraction was reached" + retries_text());
      if (at_pressure()) return ended(StageEnd::reached, "the reduced pressure was reached");
      if (jammed() && !may_retry()) return ended(StageEnd::stalled, jammed_text());
      if (jammed()) retry();
      if (control.stop_requested()) return {StageEnd::stopped, "growth was stopped"};
      block();
      control.report_progress({progress(), packing_fraction(), "packing fraction"});
      control.notify_resumable();
    }
  }

 private:
  double packing_fraction() const { return vitrel::packing_fraction(configuration_); }
  /// Returns γ of the current try.
  double rate() const {
    return std::ldexp(options_.growth_rate / typical_time_, -static_cast<int>(state_.retries));
  }

  void make_engine_at_rate() {
    EngineOptions engine;
    engine.growth_rate = rate();
    engine_ = make_engine(configuration_, engine);
  }

  void check() const {
    if (!options_.packing_fraction && !options_.reduced_pressure)
      throw UserError("growth has no target: give a packing fraction or a reduced pressure");
    if (rate() == 0 || !std::isfinite(rate()))
      throw UserError("growth at the rate " + std::to_string(options_.growth_rate) +
                      " is impossible: the rate must be finite and not 0");
    if (translations_ + rotations_ == 0)
      throw UserError("growth needs particles that can move; a lone disk or sphere cannot");
    const bool shrinks = rate() < 0;
    const bool away =
        options_.packing_fraction
            ? !at_packing_fraction() && shrinks != (*options_.packing_fraction < start_fraction_)
            : shrinks;
    if (away)
      throw UserError("growth at the rate " + std::to_string(options_.growth_rate) +
                      " leads away from its target, starting at a packing fraction of " +
                      std::to_string(start_fraction_));
  }

  void begin() {
    draw_velocities(configuration_, options_.seed, Purpose::velocities, state_.draws++,
                    Temperature::relative);
    // A single particle would otherwise keep its momentum.
    if (configuration_.size() == 1) configuration_.velocity[0] = Vec<Dim>::Zero();
    state_.under_way = true;
  }

  bool may_retry() const {
    return options_.packing_fraction && rate() > 0 &&
           state_.retries < static_cast<std::uint64_t>(options_.retries);
  }

  void retry() {
    ++state_.retries;
    divide_lengths(1 / (1 + retry_expansion));
    state_.reduced_pressure = 0;
    is_stalled_ = false;
    make_engine_at_rate();
    begin();
  }

  void block() {
    configuration_.time = 0;
    const double end = std::min(time_to_goal(), max_block_growth / std::abs(rate()));
    engine_->load(configuration_, step_end(0, end));
    while (step(step_end(configuration_.time, end)) == Engine<Dim>::Stop::time &&
           configuration_.time < end && !at_pressure())
      engine_->set_velocities(configuration_, step_end(configuration_.time, end), state_.counters);
    is_stalled_ = !(configuration_.time > 0);
    divide_lengths(1 + rate() * configuration_.time);
    rescale_velocities();
    configuration_.time = start_time_;
  }

  /// Runs to `end` or the end of the block, records the pressure and rescales.
  typename Engine<Dim>::Stop step(double end) {
    const double start = configuration_.time, virial = state_.counters.virial;
    const double size = 1 + rate() * start;
    const auto stop = engine_->advance(end, state_.counters);
    engine_->write(configuration_);
    const double time = configuration_.time - start;
    // The last step may be too short to hold enough collisions.
    const double grown = std::abs(rate()) * time / size;
    const bool is_significant = stop == Engine<Dim>::Stop::block_end ||
                                state_.reduced_pressure == 0 ||
                                grown >= std::min(0.5 * step_growth(), min_pressure_growth);
    if (time > 0 && is_significant) record_pressure(state_.counters.virial - virial, time);
    state_.time += logarithm_of_one_plus(rate() * time / size) / rate();
    rescale_velocities();
    return stop;
  }

  /// Returns the growth of all lengths in one step.
  double step_growth() const {
    return max_step_compression / std::max(state_.reduced_pressure, 1.0);
  }

  double step_end(double start, double end) const {
    const double size = 1 + rate() * start;
    return std::min(end, start + step_growth() * size / std::abs(rate()));
  }

  double time_to_goal() const {
    if (!options_.packing_fraction) return std::numeric_limits<double>::infinity();
    return (root(*options_.packing_fraction / packing_fraction(), Dim) - 1) / rate();
  }

  void record_pressure(double virial, double time) {
    const auto sums = mechanics(configuration_);
    const double temperature =
        (sums.translational_energy + sums.rotational_energy) / (translations_ + rotations_);
    const double n = static_cast<double>(configuration_.size());
    state_.reduced_pressure = 1 + virial / (Dim * n * mean_of_rise(temperature) * time);
  }

  void divide_lengths(double size) {
    configuration_.shape = shapes_;
    configuration_.box = PeriodicBox<Dim>(configuration_.box.lengths() / size);
    for (std::size_t i = 0; i < configuration_.size(); ++i) {
      configuration_.position[i] /= size;
      configuration_.box.wrap(configuration_.position[i], configuration_.image[i]);
    }
  }

  void rescale_velocities() {
    const auto sums = mechanics(configuration_);
    const double translation = scale_to(translations_, sums.translational_energy);
    const double rotation = scale_to(rotations_, sums.rotational_energy);
    for (Vec<Dim>& v : configuration_.velocity) v *= translation;
    for (AngularVelocity<Dim>& omega : configuration_.angular_velocity) omega *= rotation;
  }

  bool at_packing_fraction() const {
    return options_.packing_fraction && std::abs(packing_fraction() / *options_.packing_fraction -
                                                 1) <= tolerance::given_fraction;
  }
  bool at_pressure() const {
    return options_.reduced_pressure && rate() > 0 &&
           state_.reduced_pressure >= *options_.reduced_pressure;
  }
  bool jammed() const {
    return is_stalled_ || out_of_reach() || state_.reduced_pressure > max_reduced_pressure;
  }
  bool out_of_reach() const {
    const double z = state_.reduced_pressure;
    return options_.packing_fraction && !options_.reduced_pressure && z >= nearly_jammed &&
           *options_.packing_fraction > packing_fraction() * (1 + within_reach / z);
  }

  // Progress is measured in logarithms, in which growth is nearly uniform.
  double progress() const {
    double done = 0;
    if (options_.packing_fraction)
      done = logarithm(packing_fraction() / start_fraction_) /
             logarithm(*options_.packing_fraction / start_fraction_);
    if (options_.reduced_pressure)
      done = std::max(done, logarithm(std::max(1.0, state_.reduced_pressure)) /
                                logarithm(*options_.reduced_pressure));
    return std::clamp(done, 0.0, 1.0);
  }

  StageReport ended(StageEnd end, const std::string& reason) {
    state_.under_way = false;
    return {end, reason};
  }

  std::string jammed_text() const {
    return "the particles are jammed, at a packing fraction of " +
           std::to_string(packing_fraction()) + " and a reduced pressure of " +
           std::to_string(state_.reduced_pressure) + retries_text() +
           "; slower growth reaches higher packing fractions";
  }

  std::string retries_text() const {
    if (state_.retries == 0) return "";
    return " after " + std::to_string(state_.retries) +
           (state_.retries == 1 ? " retry" : " retries");
  }

  Configuration<Dim>& configuration_;
  const GrowthOptions& options_;
  GrowthState& state_;
  const std::vector<ParticleShape<Dim>> shapes_;
  const double typical_time_;
  const double start_time_, start_fraction_;
  const double translations_, rotations_;  // energies at kT = 1: half the degrees of freedom
  std::unique_ptr<Engine<Dim>> engine_;
  bool is_stalled_ = false;
};

}  // namespace

template <int Dim>
StageReport grow(Configuration<Dim>& configuration, const GrowthOptions& options,
                 GrowthState& state, const RunControl& control) {
  return Growth<Dim>(configuration, options, state).run(control);
}

template StageReport grow(Configuration2&, const GrowthOptions&, GrowthState&, const RunControl&);
template StageReport grow(Configuration3&, const GrowthOptions&, GrowthState&, const RunControl&);

}  // namespace vitrel
