#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/error.h"

namespace vitrel::bench {

struct Named {
  std::string name;
};

/// Those of `all` that are called one of `names`, in the order of `all`; all of them without names.
template <class One>
std::vector<One> selected(std::vector<One> all, const std::vector<std::string>& names) {
  if (!names.empty())
    std::erase_if(all, [&](const One& one) { return !std::ranges::count(names, one.name); });
  return all;
}

/// The same. Throws UserError for a name that nothing bears; `kind` says what they are ("method").
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

/// Their names, each once.
template <class One>
std::vector<std::string> names_of(const std::vector<One>& all) {
  std::vector<std::string> names;
  for (const One& one : all)
    if (!std::ranges::count(names, one.name)) names.push_back(one.name);
  return names;
}

}  // namespace vitrel::bench
