#include "workflow/run/brownian_step.h"

#include <fmt/format.h>

namespace vitrel {

std::string long_step_text(double brownian_step, double rate) {
  const double gaps = step_in_gaps(brownian_step, rate);
  if (gaps <= longest_step_in_gaps) return "";
  return fmt::format(
      "dynamics.brownian_step = {:g} is {:.2g} times as long as a particle flies between two "
      "collisions, so that motion is slower than Brownian by ten per cent or more; {:.1g} is right "
      "within a few per cent",
      brownian_step, gaps, 0.7 / rate);
}

}  // namespace vitrel
