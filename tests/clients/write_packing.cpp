#include "core/io/h5md.h"

/// Writes a packing of four ellipsoids around the sites of a face-centred cubic lattice, with its box through
/// most of them, for the scripts beside: write_packing <path>.
int main(int, char** arguments) {
  using namespace vitrel;
  constexpr double edge = 2;
  Configuration3 packing;
  packing.box = PeriodicBox<3>(Vec3::Constant(edge));
  packing.resize(4);
  packing.species_names = {"long", "round"};
  packing.position = {Vec3(-0.97, -0.95, -0.98), Vec3(0.1, 0.03, -0.95), Vec3(0, -0.9, 0.05),
                      Vec3(-0.96, 0, 0)};
  // Sites are √2 apart: bodies that reach no farther than 0.65 from sites moved by 0.1 never meet.
  const Vec3 axes[] = {{0.6, 0.3, 0.3}, {0.5, 0.5, 0.2}, {0.4, 0.4, 0.4}, {0.55, 0.25, 0.4}};
  for (int i = 0; i < 4; ++i) {
    packing.shape[i] = {axes[i]};
    packing.orientation[i] =
        Quaternion(Eigen::AngleAxisd(0.7 * i + 0.3, Vec3(1, i, 2).normalized()));
    packing.mass[i] = axes[i].prod();
    packing.species[i] = i == 2;
    packing.image[i] = {i, -i, 0};
  }
  write_state(arguments[1], packing, current_provenance("write_packing", "", 1), true);
}
