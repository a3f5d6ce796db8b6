#include "workflow/configuration/state_species.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/state/typical_scales.h"
#include "workflow/configuration/distributions.h"

namespace vitrel {
namespace {

// ---- one particle -----------------------------------------------------------------------------------

struct Misfit {
  const char* key;  ///< key of the species
  std::string given, found;
};

std::optional<Misfit> misfit(const char* key, const Distribution& given, double found,
                             Agreement agreement) {
  if (allows(given, found, agreement)) return std::nullopt;
  return Misfit{key, text(given), fmt::format("{}", found)};
}

std::optional<Misfit> ratio_misfit(const Species& species, const std::vector<double>& axes,
                                   Agreement agreement) {
  const double first = axes[0] / axes[1], second = axes[0] / axes.back();
  if (species.aspect_ratios) {
    const auto one = misfit("aspect_ratios", (*species.aspect_ratios)[0], first, agreement);
    return one ? one : misfit("aspect_ratios", (*species.aspect_ratios)[1], second, agreement);
  }
  const Distribution ratio = species.aspect_ratio.value_or(constant(1));
  const auto one = misfit("aspect_ratio", ratio, first, agreement);
  return one ? one : misfit("aspect_ratio", ratio, second, agreement);
}

std::optional<Misfit> misfit(const Species& species, const auto& shape, double mass,
                             Agreement agreement) {
  const auto lengths = shape.half_lengths();
  const std::vector<double> axes(lengths.begin(), lengths.end());
  if (species.semi_axes) {
    if (!allow(*species.semi_axes, axes, agreement))
      return Misfit{"semi_axes", text(*species.semi_axes), to_toml(std::span<const double>(axes))};
  } else {
    if (auto found = ratio_misfit(species, axes, agreement)) return found;
    auto found = species.first_semi_axis
                     ? misfit("first_semi_axis", *species.first_semi_axis, axes[0], agreement)
                     : misfit("size", species.size.value_or(constant(1)), shape.size(), agreement);
    if (found) return found;
  }
  return misfit("mass", constant(species.mass.value_or(shape.natural_mass())), mass, agreement);
}

// ---- all particles ----------------------------------------------------------------------------------

std::string key_of(std::size_t species, const char* field) {
  return fmt::format("species.{}.{}", species, field);
}

template <int Dim>
std::vector<std::size_t> counts_of(const Configuration<Dim>& state) {
  std::vector<std::size_t> counts(state.species_names.size());
  for (const std::int32_t k : state.species) ++counts[static_cast<std::size_t>(k)];
  return counts;
}

template <int Dim>
std::optional<SpeciesConflict> composition_conflict(const std::vector<Species>& species,
                                                    const Configuration<Dim>& state) {
  if (species.size() != state.species_names.size())
    return SpeciesConflict{"species", fmt::format("has {} entries, but the state has {} species",
                                                  species.size(), state.species_names.size())};
  const std::vector<std::size_t> wanted = species_counts(species, state.size());
  const std::vector<std::size_t> found = counts_of(state);
  for (std::size_t k = 0; k < species.size(); ++k) {
    if (species[k].name != state.species_names[k])
      return SpeciesConflict{key_of(k, "name"),
                             fmt::format("is \"{}\", but in the state \"{}\"", species[k].name,
                                         state.species_names[k])};
    if (wanted[k] != found[k])
      return SpeciesConflict{
          key_of(k, "fraction"),
          fmt::format("is {}, which makes {} of {} particles, but the state has {}",
                      species[k].fraction, wanted[k], state.size(), found[k])};
  }
  return std::nullopt;
}

using Distributions = std::vector<std::pair<const char*, std::optional<Distribution>>>;

/// The distributions that describe the shapes of a species, with their keys. Their number and order are the same for
/// all species.
Distributions distributions_of(const Species& species) {
  const auto entry = [](const auto& entries, std::size_t which) -> std::optional<Distribution> {
    if (!entries || which >= entries->size()) return std::nullopt;
    return (*entries)[which];
  };
  Distributions all = {{"aspect_ratio", species.aspect_ratio}};
  for (std::size_t which = 0; which < 3; ++which) {
    all.emplace_back("aspect_ratios", entry(species.aspect_ratios, which));
    all.emplace_back("semi_axes", entry(species.semi_axes, which));
  }
  all.emplace_back("size", species.size);
  all.emplace_back("first_semi_axis", species.first_semi_axis);
  return all;
}

/// Finds a distribution that differs from the one from which the particles were drawn, even though it would allow
/// them.
std::optional<SpeciesConflict> distribution_conflict(const std::vector<Species>& given,
                                                     const std::vector<Species>& recorded) {
  for (std::size_t k = 0; k < given.size(); ++k) {
    const Distributions wanted = distributions_of(given[k]), drawn = distributions_of(recorded[k]);
    for (std::size_t n = 0; n < wanted.size(); ++n) {
      const auto& [key, one] = wanted[n];
      const std::optional<Distribution>& two = drawn[n].second;
      if (!one || one->kind == Distribution::Kind::constant || (two && same(*one, *two))) continue;
      return SpeciesConflict{key_of(k, key), fmt::format("is {}, but the state was drawn from {}",
                                                         text(*one), two ? text(*two) : "another")};
    }
  }
  return std::nullopt;
}

// ---- species of a state -----------------------------------------------------------------------------

/// The recorded parameters; no value if there are none or if they do not describe the particles.
template <int Dim>
std::optional<Parameters> recorded_parameters(const Configuration<Dim>& state,
                                              const StateOrigin& origin) {
  if (origin.parameters.empty()) return std::nullopt;
  try {
    Parameters recorded = parse_parameters(origin.parameters, origin.file);
    if (species_conflict(recorded.species, state)) return std::nullopt;
    return recorded;
  } catch (const UserError&) {
    // The text comes from another program, or from a version with other keys.
    return std::nullopt;
  }
}

/// The semi-axis that all these particles share, or the range of their semi-axes.
template <int Dim>
Distribution range_of(const Configuration<Dim>& state, const std::vector<std::size_t>& members,
                      std::size_t axis) {
  std::vector<double> lengths;
  for (const std::size_t i : members)
    lengths.push_back(state.shape[i].half_lengths()[static_cast<int>(axis)]);
  const auto [low, high] = std::ranges::minmax(lengths);
  if (agree(lengths.front(), low, Agreement::rounding) &&
      agree(lengths.front(), high, Agreement::rounding))
    return constant(lengths.front());
  Distribution range;
  range.kind = Distribution::Kind::uniform;
  range.low = range.minimum = low;
  range.high = high;
  return range;
}

/// Describes one species by its particles. Semi-axes that differ are given as ranges. The mass is left out if the
/// particles have their natural masses, or if their masses differ.
template <int Dim>
Species as_found(const Configuration<Dim>& state, std::size_t species) {
  Species found;
  found.name = state.species_names[species];
  std::vector<std::size_t> members;
  for (std::size_t i = 0; i < state.size(); ++i)
    if (static_cast<std::size_t>(state.species[i]) == species) members.push_back(i);
  found.fraction = static_cast<double>(members.size()) / static_cast<double>(state.size());
  if (members.empty()) return found;
  found.semi_axes.emplace();
  for (std::size_t axis = 0; axis < Dim; ++axis)
    found.semi_axes->push_back(range_of(state, members, axis));
  const auto all = [&](const auto& holds) { return std::ranges::all_of(members, holds); };
  const double mass = state.mass[members.front()];
  if (!all([&](std::size_t i) {
        return allows(constant(state.shape[i].natural_mass()), state.mass[i]);
      }) &&
      all([&](std::size_t i) { return allows(constant(mass), state.mass[i]); }))
    found.mass = mass;
  return found;
}

template <int Dim>
std::vector<Species> as_found(const Configuration<Dim>& state) {
  std::vector<Species> species;
  for (std::size_t k = 0; k < state.species_names.size(); ++k)
    species.push_back(as_found(state, k));
  return species;
}

/// The species that have particles.
std::vector<Species> present(std::vector<Species> species) {
  std::erase_if(species, [](const Species& kind) { return kind.fraction == 0; });
  return species;
}

/// The size of the species; if it has semi-axes, the size that follows from them when they are constant.
std::optional<Distribution> size_of(const Species& species) {
  if (!species.semi_axes) return species.size;
  const std::optional<double> product = constant_product(*species.semi_axes);
  if (!product) return std::nullopt;
  return constant(root(*product, static_cast<int>(species.semi_axes->size())));
}

/// The species of the parameters, with keys that are not given taken from `other`.
std::vector<Species> completed(const Parameters& parameters, const std::vector<Species>& other) {
  std::vector<Species> species = parameters.species;
  for (std::size_t k = 0; k < std::min(species.size(), other.size()); ++k) {
    if (!place_of(parameters, key_of(k, "name"))) species[k].name = other[k].name;
    if (!species[k].mass) species[k].mass = other[k].mass;
    if (species[k].semi_axes || species[k].size || species[k].first_semi_axis) continue;
    species[k].size = size_of(other[k]);
    species[k].first_semi_axis = other[k].first_semi_axis;
  }
  return species;
}

/// The other sides of the box over the first one; a single number if they are equal.
template <int Dim>
std::vector<double> box_aspect_of(const Vec<Dim>& lengths) {
  std::vector<double> ratios;
  for (int k = 1; k < Dim; ++k) ratios.push_back(lengths[k] / lengths[0]);
  if (ratios.front() == ratios.back()) ratios.resize(1);
  return ratios;
}

template <int Dim>
std::optional<SpeciesConflict> box_conflict(const Parameters& parameters,
                                            const SystemParameters& of_state) {
  const Vec<Dim> given = box_proportions<Dim>(parameters.system);
  const Vec<Dim> found = box_proportions<Dim>(of_state);
  const auto same = [](double one, double two) { return agree(one, two, Agreement::digits); };
  if (!place_of(parameters, "system.box_aspect") || std::ranges::equal(given, found, same))
    return std::nullopt;
  return SpeciesConflict{
      "system.box_aspect",
      fmt::format("is {}, but that of the state {}", fmt::join(parameters.system.box_aspect, ", "),
                  fmt::join(of_state.box_aspect, ", "))};
}

}  // namespace

void refuse(const std::optional<SpeciesConflict>& conflict, const Parameters& parameters,
            const std::string& file) {
  if (!conflict) return;
  const std::size_t field = conflict->key.rfind('.');
  const auto place = place_of(parameters, conflict->key);
  const auto around = place_of(parameters, conflict->key.substr(0, field));
  throw UserError(fmt::format("{}: key '{}' {} ({}); leave it out, and that of the state is taken",
                              place    ? *place
                              : around ? *around
                                       : file,
                              conflict->key, conflict->complaint, file));
}

template <int Dim>
std::optional<SpeciesConflict> species_conflict(const std::vector<Species>& species,
                                                const Configuration<Dim>& state,
                                                Agreement agreement) {
  if (auto conflict = composition_conflict(species, state)) return conflict;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const auto k = static_cast<std::size_t>(state.species[i]);
    if (const auto found = misfit(species[k], state.shape[i], state.mass[i], agreement))
      return SpeciesConflict{key_of(k, found->key), fmt::format("is {}, but particle {} has {}",
                                                                found->given, i, found->found)};
  }
  return std::nullopt;
}

template <int Dim>
void take_species(Parameters& parameters, const Configuration<Dim>& state,
                  const StateOrigin& origin) {
  const std::optional<Parameters> recorded = recorded_parameters(state, origin);
  const std::vector<Species> of_state = recorded ? recorded->species : as_found(state);
  if (place_of(parameters, "species")) {
    const std::vector<Species> given = completed(parameters, of_state);
    refuse(species_conflict(given, state, Agreement::digits), parameters, origin.file);
    if (recorded) refuse(distribution_conflict(given, of_state), parameters, origin.file);
    const bool describes = !species_conflict(given, state);
    parameters.species = recorded || !describes ? of_state : given;
    for (std::size_t k = 0; k < given.size(); ++k)
      parameters.species[k].initial_temperature = given[k].initial_temperature;
  } else {
    parameters.species = present(of_state);
    for (Species& species : parameters.species) species.initial_temperature.reset();
  }
  SystemParameters of_state_system;
  of_state_system.box_aspect =
      recorded ? recorded->system.box_aspect : box_aspect_of<Dim>(state.box.lengths());
  refuse(box_conflict<Dim>(parameters, of_state_system), parameters, origin.file);
  parameters.system.box_aspect = of_state_system.box_aspect;
  try {
    validate(parameters);
  } catch (const BadValue& bad) {
    throw UserError(fmt::format("{}: {}", origin.file, bad.what()));
  }
}

template std::optional<SpeciesConflict> species_conflict(const std::vector<Species>&,
                                                         const Configuration2&, Agreement);
template std::optional<SpeciesConflict> species_conflict(const std::vector<Species>&,
                                                         const Configuration3&, Agreement);
template void take_species(Parameters&, const Configuration2&, const StateOrigin&);
template void take_species(Parameters&, const Configuration3&, const StateOrigin&);

}  // namespace vitrel
