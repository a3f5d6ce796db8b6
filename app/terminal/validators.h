#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "core/io/suggestion.h"

/// @file
/// Validators for the values of options. Each says in its message what the value must be.
namespace vitrel {

inline CLI::Validator number_that(const std::function<bool(double)>& fits,
                                  const std::string& wanted) {
  return {[=](const std::string& text) {
            char* end = nullptr;
            const double number = std::strtod(text.c_str(), &end);
            const bool is_number = !text.empty() && *end == '\0';
            return is_number && fits(number) ? std::string() : text + " is not " + wanted;
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

inline const CLI::Validator not_empty = {[](const std::string& text) {
                                           return text.empty() ? std::string("the name is empty")
                                                               : std::string();
                                         },
                                         ""};

/// A seed. TOML cannot represent greater numbers.
inline const CLI::Validator seed_number = {
    [](const std::string& text) {
      std::int64_t number = 0;
      const char* const end = text.data() + text.size();
      const auto [stop, error] = std::from_chars(text.data(), end, number);
      const bool fits = error == std::errc() && stop == end && number >= 0;
      return fits ? std::string()
                  : text + " is not a whole number between 0 and 9223372036854775807";
    },
    ""};

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
