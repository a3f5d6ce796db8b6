#pragma once

#include <string>
#include <vector>

namespace vitrel {

/// Returns "; did you mean 'x'?" with the candidate nearest to a word that was not understood (the first of several),
/// or nothing if no candidate is near. A candidate is near if at most two letters, or in a long word at most a third,
/// must be inserted, deleted or replaced.
std::string suggestion(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace vitrel
