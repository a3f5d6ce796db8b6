#include "mc/contact_pressure.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/contact/perram_wertheim.h"
#include "core/neighbors/pairs.h"

namespace vitrel {

namespace {

constexpr double max_window = 0.75;
constexpr double pairs_per_particle = 1.5;

// F − 1 of all pairs with F − 1 < window.
std::vector<double> contact_excesses(const Configuration2& configuration, double window) {
  std::vector<double> excesses;
  for_each_pair(
      configuration, std::sqrt(1 + window), [&](std::size_t i, std::size_t j, const Vec2& d) {
        const Ellipse& one = configuration.shape[i];
        const Ellipse& two = configuration.shape[j];
        const double circles = one.circumradius() + two.circumradius();
        if (d.squaredNorm() >= circles * circles * (1 + window)) return;
        const double f =
            perram_wertheim(one, configuration.angle[i], two, configuration.angle[j], d).value;
        if (f < 1 + window) excesses.push_back(f - 1);
      });
  return excesses;
}

// The window with the target number of pairs.
double choose_window(const Configuration2& configuration) {
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

void ContactPressure::add(const Configuration2& configuration) {
  if (window_ == 0) window_ = choose_window(configuration);
  for (double excess : contact_excesses(configuration, window_))
    pairs_ += intercept_weight(excess / window_) / window_;
  particles_ += static_cast<double>(configuration.size());
}

}  // namespace vitrel
