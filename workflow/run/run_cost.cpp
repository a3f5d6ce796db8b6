#include "workflow/run/run_cost.h"

#include <fmt/format.h>

#include "edmd/engine.h"
#include "edmd/hard_fluid.h"

namespace vitrel {
namespace {

/// Times measured with `vitrel-bench engine`.
double seconds_per_event(int dimension, bool is_round) {
  if (is_round) return dimension == 2 ? 0.3e-6 : 0.5e-6;
  return dimension == 2 ? 1e-6 : 3e-6;
}

/// Bytes measured: those of the process without particles, and those of each particle.
double memory(int dimension, bool is_round, double particles) {
  constexpr double program = 20e6;
  const double each = dimension == 2 ? 900 : is_round ? 1300 : 2100;
  return program + each * particles;
}

/// A frame holds positions and velocities of three components, orientations, angular velocities, and image numbers of
/// 16 bits.
double disk(const Parameters& p, int dimension, double particles) {
  constexpr double file = 50e3, per_frame = 300, of_particle = 44;
  const double bytes = p.output.precision == OutputParameters::Precision::single ? 4 : 8;
  const double places = dimension == 2 ? 3 + 1 : 3 + 4;
  const double velocities = !p.output.velocities ? 0 : dimension == 2 ? 3 + 1 : 3 + 3;
  const double per_particle = 6 + bytes * (places + velocities);
  const auto frames = static_cast<double>(sample_times(p).size());
  return file + of_particle * particles + frames * (per_frame + per_particle * particles);
}

/// How often all velocities change, other than by collisions: at Brownian steps or kicks.
double velocity_changes(const DynamicsParameters& p) {
  const double time = p.equilibration + p.duration;
  if (p.kind == DynamicsParameters::Kind::brownian) return time / p.brownian_step;
  return p.driving ? time / p.driving->interval : 0;
}

}  // namespace

template <int Dim>
std::string model_text(const Parameters& p, const Configuration<Dim>& some) {
  const std::string model = make_engine(some, dynamics_options(p).engine)->description();
  if (!p.dynamics.contact) return model;
  const bool is_integrated =
      p.dynamics.contact->coefficients == ContactParameters::Coefficients::integrated;
  return fmt::format("soft {}, {}", model,
                     is_integrated ? "every contact integrated, as asked for"
                                   : "contacts by a table of restitution coefficients, since they "
                                     "depend on two or three numbers only");
}

template <int Dim>
RunCost run_cost(const Parameters& p, const Configuration<Dim>& some) {
  const auto particles = static_cast<double>(p.system.particles);
  const double time = p.dynamics.equilibration + p.dynamics.duration;
  const HardFluid fluid(some);
  const bool is_round = fluid.is_round();
  RunCost cost;
  cost.collisions = particles * time * fluid.collision_rate(p.system.packing_fraction);
  cost.events = HardFluid::events_per_collision * cost.collisions;
  // Each change of the velocities predicts the events of all particles, each at about the cost of an event.
  cost.seconds =
      (cost.events + particles * velocity_changes(p.dynamics)) * seconds_per_event(Dim, is_round);
  cost.memory_bytes = memory(Dim, is_round, particles);
  cost.disk_bytes = disk(p, Dim, particles);
  return cost;
}

template std::string model_text(const Parameters&, const Configuration2&);
template std::string model_text(const Parameters&, const Configuration3&);
template RunCost run_cost(const Parameters&, const Configuration2&);
template RunCost run_cost(const Parameters&, const Configuration3&);

std::string long_step_text(double brownian_step, double typical_time) {
  constexpr double right = 0.1, too_long = 0.2;
  const double sizes = brownian_step / typical_time;
  if (sizes <= too_long) return "";
  return fmt::format(
      "in dynamics.brownian_step = {:g} a typical particle flies {:.2g} of its size: relaxation "
      "takes longer than that of Brownian particles, by 7 to 17 % at 0.3 and 70 to 100 % at 1; "
      "{:.1g} is right within 3 %",
      brownian_step, sizes, right * typical_time);
}

}  // namespace vitrel
