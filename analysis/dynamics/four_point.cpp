#include "analysis/dynamics/four_point.h"

#include <complex>

#include "analysis/dynamics/collective_scattering.h"
#include "analysis/dynamics/density_modes.h"

namespace vitrel {

namespace {

constexpr int shells = 8;

}  // namespace

template <int Dim>
TwoTimeFunction<Dim> four_point_structure(const PeriodicBox<Dim>& box, double overlap_distance) {
  TwoTimeFunction<Dim> function;
  std::vector<std::array<int, Dim>> vectors;
  std::vector<std::size_t> counts;
  for (int k = 1; k <= shells; ++k) {
    const auto shell = wave_vector_shell(box, k * reciprocal_lengths(box).minCoeff());
    function.x.push_back(shell.wave_number);
    counts.push_back(shell.n.size());
    vectors.insert(vectors.end(), shell.n.begin(), shell.n.end());
  }
  function.row = [=, modes = DensityModes<Dim>(vectors, box)](const TwoTimes<Dim>& pair) {
    std::vector<Vec<Dim>> still;
    for (std::size_t i = 0; i < pair.distance.size(); ++i)
      if (pair.distance[i] < overlap_distance) still.push_back((*pair.start)[i]);
    const std::vector<std::complex<double>> sums = modes.of(still);
    std::vector<double> row;
    for (std::size_t s = 0, v = 0; s < counts.size(); ++s) {
      double square = 0;
      for (const std::size_t end = v + counts[s]; v < end; ++v) square += std::norm(sums[v]);
      row.push_back(square / static_cast<double>(counts[s] * pair.distance.size()));
    }
    return row;
  };
  return function;
}

template TwoTimeFunction<2> four_point_structure(const PeriodicBox<2>&, double);
template TwoTimeFunction<3> four_point_structure(const PeriodicBox<3>&, double);

}  // namespace vitrel
