#include <cmath>

#include "core/io/h5md.h"

/// Writes a trajectory whose every number follows from the particle i and the frame k by a formula that
/// the scripts beside repeat: write_sample <path>.
namespace {

using namespace vitrel;

Configuration2 sample(int k) {
  Configuration2 configuration;
  configuration.box = PeriodicBox<2>(Vec2(20 + k, 10));
  configuration.time = 0.25 * k;
  configuration.resize(7);
  configuration.species_names = {"long", "round"};
  for (int i = 0; i < 7; ++i) {
    configuration.position[i] = {i - 3.0 + 0.125 * k, 0.5 * i - 2};
    configuration.image[i] = {k - i, i};
    configuration.angle[i] = 0.5 * i - 3.0 * k;
    configuration.velocity[i] = {0.25 * i, -0.5 * k};
    configuration.angular_velocity[i] = i + 0.125 * k;
    configuration.species[i] = i % 2;
    configuration.shape[i] = i % 2 ? Ellipse{1, 1} : Ellipse{2, 0.5};
    configuration.mass[i] = i % 2 ? 1.5 : 1;
  }
  return configuration;
}

}  // namespace

int main(int, char** arguments) {
  const Provenance provenance = current_provenance("write_sample", "[system]\nseed = 3\n", 3);
  auto writer = TrajectoryWriter::create(
      arguments[1], sample(0), provenance,
      {.velocities = true, .observables = {"collisions"}, .overwrite = true});
  for (int k = 0; k < 4; ++k) writer.write(sample(k), 10 * k, {{"collisions", 100.0 * k}});
  writer.close();
}
