#pragma once

#include <string>

/// @file
/// Text in lines that fit a terminal.
namespace vitrel {

/// The width of a narrow terminal, into which everything printed for the user should fit.
inline constexpr std::size_t line_width = 80;

/// The number of characters of UTF-8 text, each of which takes one column.
std::size_t columns(const std::string& text);

/// Breaks lines between words, so that no line is longer than `width` unless a single word is.
std::string wrapped(const std::string& text, std::size_t width);

/// Puts `count` spaces before every line of the text but the first.
std::string indented(const std::string& text, std::size_t count);

}  // namespace vitrel
