#pragma once

#include <string>

#include "core/io/parameters.h"

/// @file
/// Texts about parameters, for people.
namespace vitrel {

/// Breaks a text into lines of at most `width` bytes, each behind `lead`.
std::string wrapped(const std::string& text, const std::string& lead, std::size_t width = 98);

/// Returns the explanation of a field, "Sentence. One of …. Unit: time."; `choices` may be empty.
std::string explanation(const Field& field, const std::string& choices);

}  // namespace vitrel
