#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "core/io/suggestion.h"

/// @file
/// What the values of options must be; each says so in the message of the option that has another one.
namespace vitrel {

inline CLI::Validator number_that(const std::function<bool(double)>& fits,
                                  const std::string& wanted) {
  return {[=](const std::string& text) {
            double number = 0;
            return CLI::detail::lexical_cast(text, number) && fits(number)
                       ? std::string()
                       : text + " is not " + wanted;
          },
          ""};
}
inline const CLI::Validator positive =
    number_that([](double number) { return number > 0; }, "a positive number");
inline const CLI::Validator not_negative =
    number_that([](double number) { return number >= 0; }, "a positive number or 0");
inline CLI::Validator between(double low, double high) {
  return number_that([=](double number) { return number >= low && number <= high; },
                     fmt::format("a number between {} and {}", low, high));
}

inline CLI::Validator one_of(const std::vector<std::string>& choices) {
  return {[choices](const std::string& word) {
            const bool is_known = std::ranges::find(choices, word) != choices.end();
            return is_known ? std::string()
                            : fmt::format("'{}' is none of {}{}", word, fmt::join(choices, ", "),
                                          suggestion(word, choices));
          },
          ""};
}

}  // namespace vitrel
