#include "edmd/driving.h"

#include <cmath>

#include "core/parallel.h"
#include "core/random/stream.h"

namespace vitrel {

template <int Dim>
void kick(Configuration<Dim>& configuration, const Driving& driving, std::uint64_t seed,
          std::uint64_t step, int threads) {
  if (configuration.size() < 2) return;
  const auto n = static_cast<double>(configuration.size());
  const double energy = driving.power * driving.interval * n / (n - 1);
  std::vector<Vec<Dim>> impulses(configuration.size());
  in_parallel(configuration.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Stream draw(seed, Purpose::kicks, step, i);
      const double width = std::sqrt(2 * energy * configuration.mass[i] / Dim);
      for (double& component : impulses[i]) component = width * draw.normal();
    }
  });
  Vec<Dim> total = Vec<Dim>::Zero();
  double mass = 0;
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    total += impulses[i];
    mass += configuration.mass[i];
  }
  for (std::size_t i = 0; i < configuration.size(); ++i)
    configuration.velocity[i] += impulses[i] / configuration.mass[i] - total / mass;
}

template void kick(Configuration2&, const Driving&, std::uint64_t, std::uint64_t, int);
template void kick(Configuration3&, const Driving&, std::uint64_t, std::uint64_t, int);

}  // namespace vitrel
