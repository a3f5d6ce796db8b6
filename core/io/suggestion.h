#pragma once

#include <string>
#include <vector>

namespace vitrel {

/// "; did you mean 'x'?" with the candidate nearest to a word that was not understood, the first of several; nothing if
/// none is near: more than two letters, or of a long word more than a third, must be inserted, deleted or replaced.
std::string suggestion(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace vitrel
