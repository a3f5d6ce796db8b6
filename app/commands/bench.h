#pragma once

namespace vitrel {

/// Becomes `vitrel-bench` with the words after the first one: the program beside this one, that of the
/// build tree, or the first on PATH. Returns only if there is none.
int bench_command(char** words);

}  // namespace vitrel
