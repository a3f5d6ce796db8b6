#include "workflow/configuration/species_names.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/results.h"

namespace vitrel {
namespace {

struct Taken {
  const char* name;
  const char* by;
};

constexpr Taken taken_names[] = {
    {"all", "displacements_all and others, of all particles"},
    {"distribution", "orientation_distribution"},
    {"wave_numbers", "on_the_fly_wave_numbers"},
};

std::string complaint(const std::string& name, const std::vector<std::string>& earlier) {
  const std::string own = identifier(name);
  for (const Taken& taken : taken_names)
    if (own == taken.name)
      return fmt::format("is \"{}\", which results have in their table {}; choose another", name,
                         taken.by);
  if (std::ranges::find(earlier, name) != earlier.end())
    return fmt::format("is \"{}\" like that of an earlier species; every species needs its own",
                       name);
  for (const std::string& other : earlier)
    if (identifier(other) == own)
      return fmt::format(
          "is \"{}\", which tables of results call {} like the earlier \"{}\"; choose names that "
          "differ in letters from a to z or digits",
          name, own, other);
  return "";
}

}  // namespace

std::optional<SpeciesNameConflict> species_name_conflict(const std::vector<std::string>& names) {
  std::vector<std::string> earlier;
  for (const std::string& name : names) {
    if (const std::string found = complaint(name, earlier); !found.empty())
      return SpeciesNameConflict{earlier.size(), found};
    earlier.push_back(name);
  }
  return std::nullopt;
}

}  // namespace vitrel
