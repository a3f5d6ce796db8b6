#pragma once

#include <string>

/// @file
/// What a terminal shows and a file or a pipe does not: lines that are rewritten, bold headings, red errors.
namespace vitrel {

/// Whether standard output or standard error is a terminal that understands escape sequences: TERM is set, and not to
/// "dumb".
bool is_terminal(int descriptor);

enum class Style { heading, error };  ///< bold; bold and red

/// The text in that style if the descriptor is a terminal, unless NO_COLOR is set and not empty (no-color.org).
std::string styled(const std::string& text, Style style, int descriptor);

}  // namespace vitrel
