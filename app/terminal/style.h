#pragma once

#include <string>
#include <string_view>

/// @file
/// What a terminal shows and a file or a pipe does not: lines that are rewritten, bold headings, red errors.
namespace vitrel {

/// Whether standard output or standard error is a terminal that understands escape sequences: TERM is set, and not to
/// "dumb".
bool is_terminal(int descriptor);

/// Messages quote what files and command lines hold: control characters, with which a text could rewrite the terminal, as
/// \x1b. Lines stay lines.
std::string visible(std::string_view text);

enum class Style { heading, error };  ///< bold; bold and red

/// The text in that style if the descriptor is a terminal, unless NO_COLOR is set and not empty (no-color.org).
std::string styled(const std::string& text, Style style, int descriptor);

}  // namespace vitrel
