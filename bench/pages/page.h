#pragma once

#include <string>

#include "core/io/json.h"

namespace vitrel::bench {

/// One HTML file that needs nothing beside it: charts and tables of what the comparisons have measured,
/// with the data inside, and their "provenance". A section is there if its data are: "rows" and "classes",
/// "tolerances", "failures", "scene", "passing_pair", "whole_runs", "overlap".
std::string page(const std::string& title, const std::string& subtitle, const Json& data);

}  // namespace vitrel::bench
