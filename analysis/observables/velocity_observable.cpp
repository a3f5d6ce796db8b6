#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "analysis/observables/frame_observable.h"

namespace vitrel {

namespace {

/// Range and width of the bins of the density of a velocity component, in units of its standard deviation.
constexpr double widest = 5, width = 0.1;
constexpr std::size_t bins = 100;

/// The velocities in one frame, relative to its centre of mass.
struct Velocities {
  double temperature = 0, sonine = 0;
  std::vector<double> density;
};

template <int Dim>
Vec<Dim> mean_velocity(const Configuration<Dim>& frame) {
  const Mechanics<Dim> sums = mechanics(frame);
  double mass = 0;
  for (const double m : frame.mass) mass += m;
  return sums.momentum / mass;
}

/// Evaluates velocities times √m, whose distribution in equilibrium does not depend on the masses. With s = m v² in
/// units of the temperature, T = ⟨s⟩/d and a₂ = d ⟨s²⟩/((d + 2) ⟨s⟩²) − 1.
template <int Dim>
Velocities velocities(const Configuration<Dim>& frame) {
  const Vec<Dim> drift = mean_velocity(frame);
  const auto n = static_cast<double>(frame.size());
  std::vector<Vec<Dim>> reduced = velocities_after_contact(frame);
  double square = 0, quartic = 0;
  for (std::size_t i = 0; i < reduced.size(); ++i) {
    reduced[i] = std::sqrt(frame.mass[i]) * (reduced[i] - drift);
    const double s = reduced[i].squaredNorm();
    square += s / n;
    quartic += s * s / n;
  }
  Velocities found{square / Dim, Dim * quartic / ((Dim + 2) * square * square) - 1,
                   std::vector<double>(bins)};
  const double per_component = 1 / (n * Dim * width), deviation = std::sqrt(found.temperature);
  for (const Vec<Dim>& v : reduced)
    for (const double component : v) {
      const double place = (component / deviation + widest) / width;
      if (place >= 0 && place < bins)
        found.density[static_cast<std::size_t>(place)] += per_component;
    }
  return found;
}

/// Observes the temperature against time, the second Sonine coefficient and the density of a component.
template <int Dim>
class VelocityObservable final : public FrameObservable<Dim> {
 public:
  std::function<void()> measure(const Configuration<Dim>& frame) override {
    return [this, time = frame.time, found = velocities(frame)] {
      time_.push_back(time);
      temperature_.push_back(found.temperature);
      sonine_.push_back(found.sonine);
      density_.add(found.density);
    };
  }

  std::vector<Table> tables(bool is_even) const override {
    std::vector<double> component, gaussian;
    for (std::size_t k = 0; k < bins; ++k) {
      const double c = (static_cast<double>(k) + 0.5) * width - widest;
      component.push_back(c);
      gaussian.push_back(std::exp(-c * c / 2) / std::sqrt(2 * std::numbers::pi));
    }
    return {{"velocities",
             fmt::format(
                 "Velocities v in the frame of the centre of mass: temperature = <m v^2>/{0}, and "
                 "the second Sonine coefficient a_2 = {0} <m^2 v^4>/({1} <m v^2>^2) - 1, 0 in "
                 "equilibrium.",
                 Dim, Dim + 2),
             {{"time", "time", time_}, {"temperature", "kT", temperature_}, {"a_2", "1", sonine_}}},
            {"velocity_distribution",
             fmt::format("Density of the components c of sqrt(m/T) v, averaged over {} frames; "
                         "gaussian: in equilibrium, exp(-c^2/2)/sqrt(2 pi).",
                         time_.size()),
             {{"component", "1", std::move(component)},
              averaged("density", "1", density_, is_even),
              {"gaussian", "1", std::move(gaussian)}}}};
  }

 private:
  std::vector<double> time_, temperature_, sonine_;
  FrameAverage density_;
};

}  // namespace

template <int Dim>
FrameObservableType<Dim> velocity_observable() {
  const Chart sonine{.section = Chart::Section::course,
                     .heading = "Second Sonine coefficient",
                     .symbol = "a₂",
                     .curves = {{"a_2", "a₂"}}};
  const Chart distribution{.section = Chart::Section::structure,
                           .heading = "Velocities",
                           .symbol = "density",
                           .curves = {{"density", "density of components"}},
                           .scale = Chart::Scale::from_zero,
                           .x = "component",
                           .x_symbol = "c = v √(m/T)",
                           .references = {{"gaussian", "Gaussian"}}};
  const Needs needs{.velocities = true, .averages = true};
  return {{{.table = "velocities",
            .what = "Temperature and second Sonine coefficient of the velocities of single frames.",
            .columns = {frame_time_column(),
                        {"temperature", "kT", "⟨m v²⟩/d, v relative to the centre of mass"},
                        {"a_2", "1", "d⟨m²v⁴⟩/((d + 2)⟨m v²⟩²) − 1"}},
            .needs = needs,
            .charts = {sonine}},
           {.table = "velocity_distribution",
            .what = "Density of the components of the velocities, in units of their deviation.",
            .columns = {{"component", "1", "c, a component of √(m/T) v"},
                        {"density", "1", "density of c", true},
                        {"gaussian", "1", "exp(−c²/2)/√(2π)"}},
            .needs = needs,
            .charts = {distribution}}},
          [](const Configuration<Dim>&, const StructureOptions&) {
            return std::make_unique<VelocityObservable<Dim>>();
          }};
}

template FrameObservableType<2> velocity_observable();
template FrameObservableType<3> velocity_observable();

}  // namespace vitrel
