#pragma once

#include <string>
#include <string_view>

/// @file
/// Output that terminals get but files and pipes do not: lines that are rewritten, bold headings, red errors.
namespace vitrel {

/// Whether standard output or standard error is a terminal that understands escape sequences, which requires that
/// TERM is set and not "dumb".
bool is_terminal(int descriptor);

/// The text with its control characters written as \x1b and so on. Messages quote files and command lines, which
/// could otherwise rewrite the terminal. Line breaks and tabs stay.
std::string visible(std::string_view text);

enum class Style { heading, error };  ///< bold; bold and red

/// The text in this style if the descriptor is a terminal, unless NO_COLOR is set and not empty (no-color.org).
std::string styled(const std::string& text, Style style, int descriptor);

}  // namespace vitrel
