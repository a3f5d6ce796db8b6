#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/error.h"

namespace vitrel::bench {

struct Named {
  std::string name;
};

/// The entries of `all` whose name is in `names`, in the order of `all`; all entries if `names` is empty.
template <class One>
std::vector<One> selected(std::vector<One> all, const std::vector<std::string>& names) {
  if (!names.empty())
    std::erase_if(all, [&](const One& one) { return !std::ranges::count(names, one.name); });
  return all;
}

/// Chooses entries in the same way, but throws UserError for a name that no entry has. `kind` is the word for the
/// entries ("method").
template <class One>
std::vector<One> chosen(const std::vector<One>& all, const std::vector<std::string>& names,
                        const std::string& kind) {
  for (const std::string& name : names) {
    if (std::ranges::find(all, name, &One::name) != all.end()) continue;
    std::string known;
    for (const One& one : all)
      if (known.find(" " + one.name + ",") == std::string::npos) known += " " + one.name + ",";
    if (!known.empty()) known.pop_back();
    throw UserError("there is no " + kind + " \"" + name + "\"; known are" + known);
  }
  return selected(all, names);
}

/// The names of the entries, each listed once.
template <class One>
std::vector<std::string> names_of(const std::vector<One>& all) {
  std::vector<std::string> names;
  for (const One& one : all)
    if (!std::ranges::count(names, one.name)) names.push_back(one.name);
  return names;
}

}  // namespace vitrel::bench
