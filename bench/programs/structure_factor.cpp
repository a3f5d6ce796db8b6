// How much does the structure factor by Fourier transform gain over the direct sum, and how exact is it?
//
// Prints JSON. scripts/validate structure builds and runs this and writes its section of
// docs/validation.md.

#include <algorithm>
#include <cmath>
#include <ctime>

#include "analysis/structure/structure_factor.h"
#include "bench/programs/parts.h"
#include "core/io/json.h"
#include "mc/insertion.h"

namespace vitrel::bench {
namespace {

constexpr double packing_fraction = 0.3;

Configuration2 fluid(std::size_t particles) {
  Configuration2 c;
  c.resize(particles);
  for (Ellipse& shape : c.shape) shape = {2, 0.5};
  insert_particles(c, {packing_fraction, 1'000'000, false}, 1, {});
  return c;
}

/// The shortest processor time of one call in `calls`, in ms.
template <class Work>
double shortest_time(int calls, Work&& work) {
  double shortest = INFINITY;
  for (int k = 0; k < calls; ++k) {
    const std::clock_t start = std::clock();
    work();
    shortest = std::min(shortest, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return shortest;
}

Json measure(std::size_t particles) {
  const Configuration2 c = fluid(particles);
  const ScatteringShells shells(c.box.lengths(), {});
  StructureFactor fast, exact;
  const double transform =
      shortest_time(20, [&] { fast = shells.transformed_structure_factor(c); });
  const double direct =
      shortest_time(particles > 100 ? 1 : 20, [&] { exact = shells.direct_structure_factor(c); });
  double wave_vectors = 0, error = 0, share = 0;
  for (std::size_t k = 0; k < exact.q.size(); ++k) {
    if (exact.modes[k] == 0) continue;
    wave_vectors += exact.modes[k];
    const double n = static_cast<double>(particles);
    const double off = std::abs(fast.total[k] - exact.total[k]);
    const double bound =
        alias_tolerance * (2 * std::sqrt(n * exact.total[k]) + alias_tolerance * n);
    error = std::max(error, off);
    share = std::max(share, off / bound);
  }
  return {{"particles", particles}, {"wave_vectors", wave_vectors}, {"transform_ms", transform},
          {"direct_ms", direct},    {"largest_error", error},       {"share_of_bound", share}};
}

}  // namespace

int structure_factor() {
  Json rows = Json::array();
  for (const std::size_t particles : {10, 30, 100, 1000, 10'000})
    rows.push_back(measure(particles));
  print({{"rows", rows}});
  return 0;
}

}  // namespace vitrel::bench
