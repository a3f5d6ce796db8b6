#include "analysis/dynamics/haff.h"

#include <cmath>
#include <numbers>

namespace vitrel {

double HaffLaw::operator()(double t) const {
  return initial / std::pow(1 + t / time, exponent);
}

std::optional<HaffLaw> fit_haff(const std::vector<double>& times,
                                const std::vector<double>& temperatures, double exponent) {
  double times_squared = 0, times_rise = 0;
  for (std::size_t k = 1; k < times.size(); ++k) {
    const double t = times[k] - times[0], ratio = temperatures[0] / temperatures[k];
    times_squared += t * t;
    times_rise += t * (std::pow(ratio, 1 / exponent) - 1);
    if (ratio >= std::numbers::e)
      return HaffLaw{exponent, temperatures[0], times_squared / times_rise};
  }
  return std::nullopt;
}

}  // namespace vitrel
