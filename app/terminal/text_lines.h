#pragma once

#include <string>

/// @file
/// Text in lines that fit a terminal.
namespace vitrel {

/// Columns of a narrow terminal, which all that is printed for a person should fit.
inline constexpr std::size_t line_width = 80;

/// The number of characters of UTF-8 text, each of which takes one column.
std::size_t columns(const std::string& text);

/// Line breaks between words, so that no line is longer than `width`, but for single words that are.
std::string wrapped(const std::string& text, std::size_t width);

/// The same text with `count` spaces before every line but the first.
std::string indented(const std::string& text, std::size_t count);

}  // namespace vitrel
