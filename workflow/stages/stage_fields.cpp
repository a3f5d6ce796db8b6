#include "workflow/stages/stage_fields.h"

#include <fmt/format.h>

#include "edmd/options.h"

namespace vitrel {

void validate_growth_rate(double growth_rate, const Rules& rules) {
  rules.require(
      growth_rate > 0 && growth_rate <= 1, "growth_rate",
      fmt::format("is {}, but must lie above 0 and not above 1, where the surfaces are as "
                  "fast as the particles",
                  show(growth_rate)));
}

void validate_reduced_pressure(const std::optional<double>& reduced_pressure, const Rules& rules) {
  if (!reduced_pressure) return;
  rules.require(*reduced_pressure > 1 && *reduced_pressure <= max_reduced_pressure,
                "reduced_pressure",
                fmt::format("is {}, but must lie above 1 (an ideal gas) and not above {}",
                            show(*reduced_pressure), show(max_reduced_pressure)));
}

void validate_exchanges(const ExchangeOptions& exchanges, Moves moves, const Rules& rules) {
  constexpr double most = 1e6;
  if (moves == Moves::local)
    rules.require(
        exchanges.trials >= 0 && exchanges.trials < 1, "exchanges",
        fmt::format("is {}, but a share of the moves lies between 0 and 1, 1 excluded: they "
                    "move nothing by themselves",
                    show(exchanges.trials)));
  else
    rules.require(
        exchanges.trials >= 0 && exchanges.trials <= most, "exchanges",
        fmt::format("is {}, but must lie between 0 and {}", show(exchanges.trials), show(most)));
  rules.require(exchanges.partners > 0 && exchanges.partners <= 1, "exchange_partners",
                fmt::format("is {}, but a share of the ranks lies above 0 and not above 1",
                            show(exchanges.partners)));
  rules.require(
      exchanges.collective >= 0 && exchanges.collective <= most, "collective_exchanges",
      fmt::format("is {}, but must lie between 0 and {}", show(exchanges.collective), show(most)));
}

}  // namespace vitrel
