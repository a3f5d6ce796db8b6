#pragma once

#include <string>

namespace vitrel {

/// All tables of `vitrel analyze` as Markdown (docs/observables.md): what they contain and what they need of a run.
std::string observables_page();

}  // namespace vitrel
