#include "workflow/report/cooling.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "workflow/report/assets.h"
#include "workflow/report/page_parts.h"

namespace vitrel {

std::optional<HaffLaw> haff_law(const Cooling& cooling, const Results& results, int dimension) {
  const Table* energies = results.find("energies");
  if (!energies) return std::nullopt;
  std::vector<double> temperatures = energies->find("translational")->value;
  for (double& temperature : temperatures) temperature *= 2.0 / dimension;
  return fit_haff(energies->find("time")->value, temperatures, cooling.exponent);
}

std::string cooling_section(const Cooling& cooling, const std::optional<HaffLaw>& law,
                            int dimension) {
  const std::string formula = fmt::format("Haff’s law T = T(0)/(1 + t/τ)<sup>{}</sup>",
                                          cooling.exponent == 2 ? "2" : "5/3");
  const std::string drawn =
      law ? fmt::format(
                "Dashed: {} with τ = {:.4g} {}, fitted to the first decay, until T has "
                "fallen to T(0)/e. It holds as long as the gas is homogeneous.",
                formula, law->time, page_units(dimension).time)
          : formula +
                " is not drawn: T does not fall to T(0)/e in this run, too little for a fit of τ.";
  return filled(asset("page/cooling.html"),
                {{"text", fmt::format("Granular temperature T = 2 E<sub>trans</sub>/({} N). {} The "
                                      "exponent is {} because {}.",
                                      dimension, drawn, cooling.exponent == 2 ? "2" : "5/3",
                                      escaped(cooling.reason))}});
}

Json cooling_data(const std::optional<HaffLaw>& law) {
  if (!law) return nullptr;
  return {{"exponent", law->exponent}, {"initial", law->initial}, {"time", law->time}};
}

}  // namespace vitrel
