#pragma once

#include <array>
#include <string_view>

#include "analysis/glass/glass_study.h"

/// @file
/// Names of the cases that the glass study distinguishes; tables hold the numbers of the enumerations.
namespace vitrel {

// The names are in the order of the enumerations.
inline constexpr std::array<std::string_view, 3> verdict_names = {"equilibrated", "ageing",
                                                                  "not enough time"};
inline constexpr std::array<std::string_view, 4> orientation_names = {
    "round", "relaxes", "nematic order", "does not relax"};
inline constexpr std::array<std::string_view, 3> fit_verdict_names = {"found", "lower bound only",
                                                                      "refused"};
inline constexpr std::array<std::string_view, 2> law_names = {"power law", "Vogel–Fulcher"};
inline constexpr std::array<std::string_view, 3> kind_names = {
    "translation, tau_alpha", "rotation, tau_2", "rotation in the nematic, tau_2"};

constexpr std::string_view name_of(GlassKind kind) {
  return kind_names[static_cast<std::size_t>(kind)];
}
constexpr std::string_view name_of(GlassLaw law) {
  return law_names[static_cast<std::size_t>(law)];
}
constexpr std::string_view name_of(EquilibrationVerdict verdict) {
  return verdict_names[static_cast<std::size_t>(verdict)];
}
constexpr std::string_view name_of(GlassVerdict verdict) {
  return fit_verdict_names[static_cast<std::size_t>(verdict)];
}
constexpr std::string_view name_of(OrientationKind orientation) {
  return orientation_names[static_cast<std::size_t>(orientation)];
}

}  // namespace vitrel
