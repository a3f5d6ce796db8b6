#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/error.h"

namespace vitrel::bench {

/// Those of `all` that are called one of `names`, in the order of `all`; all of them without names.
/// Throws UserError for a name that nothing bears; `kind` says what they are ("method").
template <class Named>
std::vector<Named> chosen(std::vector<Named> all, const std::vector<std::string>& names,
                          const std::string& kind) {
  if (names.empty()) return all;
  for (const std::string& name : names) {
    if (std::ranges::find(all, name, &Named::name) != all.end()) continue;
    std::string known;
    for (const Named& one : all)
      if (known.find(one.name + ",") == std::string::npos) known += " " + one.name + ",";
    known.pop_back();
    throw UserError("there is no " + kind + " \"" + name + "\"; known are" + known);
  }
  std::erase_if(all, [&](const Named& one) { return !std::ranges::count(names, one.name); });
  return all;
}

}  // namespace vitrel::bench
