#pragma once

#include <optional>
#include <string>

#include "analysis/dynamics/haff.h"
#include "analysis/results.h"
#include "core/io/json.h"

/// @file
/// The cooling curve of a granular gas, and Haff's law for it, on the page.
namespace vitrel {

/// The cooling of particles that lose energy in collisions and get none back.
struct Cooling {
  double exponent;     ///< in Haff's law
  std::string reason;  ///< why it has this value, as the rest of a sentence
};

/// Fits the law to the table `energies` with T = 2 E/d. No value if the table is missing, or if T does not fall to
/// 1/e.
std::optional<HaffLaw> haff_law(const Cooling& cooling, const Results& results, int dimension);

/// The section of the page that says which law is drawn and why, or why none is.
std::string cooling_section(const Cooling& cooling, const std::optional<HaffLaw>& law,
                            int dimension);

/// The law for the script of the page; null without a law.
Json cooling_data(const std::optional<HaffLaw>& law);

}  // namespace vitrel
