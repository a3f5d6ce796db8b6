#pragma once

#include <array>
#include <string_view>

/// What the codes in tables of the glass study stand for, in the order of the enumerations that they are the
/// values of.
namespace vitrel {

inline constexpr std::array<std::string_view, 3> verdict_words = {"equilibrated", "ageing",
                                                                  "not enough time"};
inline constexpr std::array<std::string_view, 4> orientation_words = {
    "round", "relaxes", "nematic order", "does not relax"};
inline constexpr std::array<std::string_view, 2> law_words = {"power law", "Vogel–Fulcher"};

}  // namespace vitrel
