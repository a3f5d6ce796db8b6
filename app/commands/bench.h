#pragma once

#include <string>
#include <vector>

namespace vitrel {

/// Becomes `vitrel-bench` with these words: the program beside this one, that of the build tree, or the first on PATH.
/// UserError if there is none.
[[noreturn]] void become_bench(const std::vector<std::string>& words);

/// The same with the words after the first one; returns an exit code only if there is none.
int bench_command(char** words);

}  // namespace vitrel
