#pragma once

#include <string>

namespace vitrel {

/// All tables of `vitrel analyze` as Markdown (docs/observables.md): what they are, what they need of a run, and
/// the charts of the report page.
std::string observables_page();

}  // namespace vitrel
