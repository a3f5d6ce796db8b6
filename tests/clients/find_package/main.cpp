// A short run by an installed vitrel: particles on a lattice, Newtonian dynamics, a file written
// and read again. Succeeds if all four libraries do their part.

#include <filesystem>
#include <iostream>
#include <numbers>

#include "analysis/statistics/blocking.h"
#include "core/io/h5md.h"
#include "core/state/check.h"
#include "core/state/species.h"
#include "edmd/run.h"
#include "edmd/sampling.h"
#include "mc/lattice.h"

namespace {

class Energies : public vitrel::Observer<2> {
 public:
  void observe(const vitrel::Frame<2>& frame) override {
    const vitrel::Mechanics sums = vitrel::mechanics(frame.configuration);
    values.push_back(sums.translational_energy + sums.rotational_energy);
  }
  std::vector<double> values;
};

}  // namespace

int main() {
  using namespace vitrel;
  Species ellipses;
  ellipses.aspect_ratio = Distribution{.mean = 2};
  Configuration2 start = draw_particles<2>({ellipses}, 25, 0.4, Vec2::Ones(), 1);
  place_on_lattice(start, {.angle = std::numbers::pi / 4});
  draw_velocities(start, 1, Purpose::velocities, 0, Temperature::total);

  RunState2 state = begin_run(start, 0);
  Energies energies;
  run(state, {}, {linear_times(0.1, 5), 5, &energies, {}}, {});

  const std::filesystem::path file = "client.h5";
  write_state(file, state.configuration, current_provenance("client", "", 1), true);
  const Configuration2 end = read_state(file);
  const double energy = block_average(energies.values).mean / static_cast<double>(end.size());
  std::cout << state.counters.collisions << " collisions, energy " << energy
            << " kT per particle\n";

  // 25 particles at Z ≈ 3 collide many hundred times in 5 time units; 1 + 1/2 kT each by the draw.
  const bool right = end.position == state.configuration.position && exact_check(end).clean() &&
                     state.counters.collisions > 100 && std::abs(energy - 1.5) < 1e-12;
  return right ? 0 : 1;
}
