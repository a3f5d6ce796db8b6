// The densest lattices of the scene of the thesis, which is its figure 4.5.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bench/surveys/thesis_run.h"
#include "tests/support/scenes.h"

namespace vitrel::bench {
namespace {

// Disks fill π/4 of a square lattice; κ = √3 at 45° reaches the triangular lattice's π/(2√3), and
// θ and −θ are mirror images.
TEST(BenchSquareLattice, DensestAreThoseOfTheThesis) {
  constexpr double pi = std::numbers::pi;
  EXPECT_NEAR(densest_square_lattice({1, 1}, 0.3), pi / 4, 1e-14);
  EXPECT_NEAR(densest_square_lattice(of_aspect_ratio(std::sqrt(3.0)), pi / 4),
              pi / (2 * std::sqrt(3.0)), 1e-14);
  EXPECT_NEAR(densest_square_lattice(of_aspect_ratio(2), 0), pi / 8, 1e-14);
  for (double angle : {0.1, 0.5, 0.7})
    EXPECT_NEAR(densest_square_lattice(of_aspect_ratio(3), angle),
                densest_square_lattice(of_aspect_ratio(3), -angle), 1e-13);
}

}  // namespace
}  // namespace vitrel::bench
