#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

/// @file
/// JSON to and from text. The parser and the writer of nlohmann::json take long to compile, so one source file compiles
/// them.
namespace vitrel {

/// Members keep the order in which they were added.
using Json = nlohmann::ordered_json;

enum class JsonCharacters { utf8, ascii };

/// Returns the text on one line without blanks, or with `indent` blanks per level. Numbers that are not finite become
/// null; bytes that are not UTF-8 become U+FFFD.
std::string json_text(const Json& json, int indent = -1,
                      JsonCharacters characters = JsonCharacters::utf8);

/// Returns the number, or `if_null` for null, which stands for numbers that are not finite.
double number_or(const Json& json, double if_null);

/// Parses a text. Throws FileError if it is not JSON; `file` is for the message.
Json parse_json(std::string_view text, const std::string& file);

}  // namespace vitrel
