#include "mc/contact_pressure.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/contact/contact_queries.h"
#include "core/contact/perram_wertheim.h"
#include "core/elementary.h"
#include "core/neighbors/pairs.h"

namespace vitrel {

namespace {

// The maximum of twice the window.
constexpr double max_width = 0.75;
constexpr double pairs_per_particle = 1.5;

// Returns μ^D − 1 of all pairs for which it is below the window.
template <int Dim>
std::vector<double> contact_excesses(const Configuration<Dim>& configuration, double window) {
  const double reach = root(1 + window, Dim);
  std::vector<double> excesses;
  for_each_pair(configuration, reach, [&](std::size_t i, std::size_t j, const Vec<Dim>& d) {
    const ParticleShape<Dim>& one = configuration.shape[i];
    const ParticleShape<Dim>& two = configuration.shape[j];
    if (separated(scaled(one, reach), configuration.pose(i), scaled(two, reach),
                  configuration.pose(j), d, 0))
      return;
    const double f = perram_wertheim(one, orientation_of(configuration.pose(i)), two,
                                     orientation_of(configuration.pose(j)), d)
                         .value;
    const double volume = Dim == 2 ? f : f * std::sqrt(f);
    if (volume < 1 + window) excesses.push_back(volume - 1);
  });
  return excesses;
}

// Returns half the width that holds the target number of pairs.
template <int Dim>
double choose_window(const Configuration<Dim>& configuration) {
  std::vector<double> excesses = contact_excesses(configuration, max_width);
  const auto target =
      static_cast<std::size_t>(pairs_per_particle * static_cast<double>(configuration.size()));
  if (excesses.size() <= target) return 0.5 * max_width;
  std::nth_element(excesses.begin(), excesses.begin() + static_cast<std::ptrdiff_t>(target),
                   excesses.end());
  return 0.5 * excesses[target];
}

// Returns K(y)/w.
double intercept_weight(double excess, double window) {
  const double y = excess / window;
  return (16 + y * (-120 + y * (240 - 140 * y))) / window;
}

}  // namespace

template <int Dim>
double ContactPressure::add(const Configuration<Dim>& configuration) {
  if (window_ == 0) window_ = choose_window(configuration);
  double pairs = 0;
  for (const double excess : contact_excesses(configuration, 2 * window_)) {
    wide_pairs_ += intercept_weight(excess, 2 * window_);
    if (excess < window_) pairs += intercept_weight(excess, window_);
  }
  pairs_ += pairs;
  particles_ += static_cast<double>(configuration.size());
  return 1 + pairs / static_cast<double>(configuration.size());
}

template double ContactPressure::add(const Configuration2&);
template double ContactPressure::add(const Configuration3&);

}  // namespace vitrel
