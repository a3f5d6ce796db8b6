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

constexpr double max_window = 0.75;
constexpr double pairs_per_particle = 1.5;

// μ^D − 1 of all pairs for which that is below the window.
template <int Dim>
std::vector<double> contact_excesses(const Configuration<Dim>& configuration, double window) {
  const double reach = root(1 + window, Dim);
  std::vector<double> excesses;
  for_each_pair(configuration, reach, [&](std::size_t i, std::size_t j, const Vec<Dim>& d) {
    const Solid<Dim>& one = configuration.shape[i];
    const Solid<Dim>& two = configuration.shape[j];
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

// The window with the target number of pairs.
template <int Dim>
double choose_window(const Configuration<Dim>& configuration) {
  std::vector<double> excesses = contact_excesses(configuration, max_window);
  const auto target =
      static_cast<std::size_t>(pairs_per_particle * static_cast<double>(configuration.size()));
  if (excesses.size() <= target) return max_window;
  std::nth_element(excesses.begin(), excesses.begin() + static_cast<std::ptrdiff_t>(target),
                   excesses.end());
  return excesses[target];
}

double intercept_weight(double y) {
  return 16 + y * (-120 + y * (240 - 140 * y));
}

}  // namespace

template <int Dim>
void ContactPressure::add(const Configuration<Dim>& configuration) {
  if (window_ == 0) window_ = choose_window(configuration);
  for (double excess : contact_excesses(configuration, window_))
    pairs_ += intercept_weight(excess / window_) / window_;
  particles_ += static_cast<double>(configuration.size());
}

template void ContactPressure::add(const Configuration2&);
template void ContactPressure::add(const Configuration3&);

}  // namespace vitrel
