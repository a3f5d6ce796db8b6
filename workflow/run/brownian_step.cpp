#include "workflow/run/brownian_step.h"

#include <fmt/format.h>

#include "core/state/typical_scales.h"

namespace vitrel {

template <int Dim>
double step_in_sizes(double brownian_step, const Configuration<Dim>& particles) {
  return brownian_step / typical_time(particles);
}

template <int Dim>
std::string long_step_text(double brownian_step, const Configuration<Dim>& particles) {
  constexpr double right = 0.1, too_long = 0.2;
  const double sizes = step_in_sizes(brownian_step, particles);
  if (sizes <= too_long) return "";
  return fmt::format(
      "in dynamics.brownian_step = {:g} a typical particle flies {:.2g} of its size: relaxation "
      "takes longer than that of Brownian particles, by 12 to 18 % at 0.3 and twice as long at 1; "
      "{:.1g} is right within 4 %",
      brownian_step, sizes, right * typical_time(particles));
}

template double step_in_sizes(double, const Configuration2&);
template double step_in_sizes(double, const Configuration3&);
template std::string long_step_text(double, const Configuration2&);
template std::string long_step_text(double, const Configuration3&);

}  // namespace vitrel
