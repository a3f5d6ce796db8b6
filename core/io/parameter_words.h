#pragma once

#include <string>

#include "core/io/parameters.h"

/// @file
/// Words about parameters, in text that people read.
namespace vitrel {

/// Lines of at most `width` bytes, each behind `lead`.
std::string wrapped(const std::string& text, const std::string& lead, std::size_t width = 98);

/// "Sentence. One of …. Unit: time.", the explanation of a field; `choices` may be empty.
std::string explanation(const Field& field, const std::string& choices);

}  // namespace vitrel
