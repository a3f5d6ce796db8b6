#include "workflow/configuration/start_state.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.h"
#include "core/io/foreign/foreign_file.h"
#include "core/state/check.h"
#include "core/state/contact_scale.h"
#include "core/state/in_space.h"
#include "core/state/species.h"
#include "workflow/configuration/distributions.h"
#include "workflow/configuration/state_species.h"

namespace vitrel {
namespace {

/// The semi-axes of a species with a single shape.
template <int Dim>
Vec3 half_lengths_of(Species species) {
  species.fraction = 1;
  constexpr double any = 0.1;
  return half_lengths_in_space(
      draw_particles<Dim>({species}, 1, any, Vec<Dim>::Ones(), 1).shape[0]);
}

const StateStage& start_of(const Parameters& parameters) {
  return *start_state(parameters.stages);
}

/// The name of the state in messages.
std::string name_of(const Parameters& parameters) {
  const StateStage& stage = start_of(parameters);
  return stage.file ? *stage.file : place_of(parameters, "prepare.stage.0").value_or("the state");
}

template <int Dim>
Configuration<Dim> inline_state(const Parameters& parameters) {
  try {
    return configuration_of<Dim>(start_of(parameters).frame(Dim), known_system(parameters));
  } catch (const UserError& error) {
    throw UserError(fmt::format("{}: the state {}", name_of(parameters), error.what()));
  }
}

template <class Number>
SpeciesConflict other_number(const char* key, Number given, Number found) {
  return {key, fmt::format("is {}, but that of the state is {}", given, found)};
}

bool agrees(double given, double found) {
  return agree(given, found, Agreement::digits);
}
bool agrees(std::int64_t given, std::int64_t found) {
  return given == found;
}

template <class Number>
void take(Number& value, Number found, const char* key, const Parameters& parameters,
          const std::string& file) {
  if (place_of(parameters, key) && !agrees(value, found))
    refuse(other_number(key, value, found), parameters, file);
  value = found;
}

template <int Dim>
void refuse_overlaps(const Configuration<Dim>& state, const std::string& file) {
  const ExactCheck<Dim> check = exact_check(state);
  if (check.clean()) return;
  const auto deepest = std::ranges::min_element(
      check.overlaps, {}, [&](const PairImage<Dim>& pair) { return contact_scale(state, pair); });
  throw InvariantError(fmt::format(
      "{}: has {} overlapping pair(s), the deepest of particles {} and {}, image ({}), which would "
      "touch if scaled by {:.10g}; start from a state without, or scale all particles until none "
      "overlap (--shrink, or on_overlap = \"shrink\" of the stage)",
      file, check.overlaps.size(), deepest->i, deepest->j,
      fmt::join(deepest->shift.data(), deepest->shift.data() + Dim, ", "),
      contact_scale(state, *deepest)));
}

/// Species as [[species]] describes them, with lengths in the unit of the results.
std::vector<KnownSpecies> known_species(const Parameters& parameters) {
  std::vector<KnownSpecies> known;
  if (!place_of(parameters, "species")) return known;
  const bool is_plane = parameters.system.dimension == 2;
  for (const Species& species : parameters.species) {
    KnownSpecies& one = known.emplace_back(KnownSpecies{species.name});
    one.mass = species.mass;
    if (species.has_one_shape())
      one.half_lengths = is_plane ? half_lengths_of<2>(species) : half_lengths_of<3>(species);
  }
  return known;
}

/// Adds the species of [[import.species]], whose lengths are in the unit of the file.
void add_imported(std::vector<KnownSpecies>& known, const ImportOptions& import) {
  for (const ImportOptions::Kind& kind : import.species) {
    auto one = std::ranges::find(known, kind.name, &KnownSpecies::name);
    if (one == known.end()) one = known.insert(known.end(), KnownSpecies{kind.name});
    if (kind.diameter)
      one->half_lengths = Vec3::Constant(0.5 * *kind.diameter / import.length_unit);
    if (kind.semi_axes) {
      one->half_lengths = Vec3(Vec3::Zero());
      for (std::size_t k = 0; k < kind.semi_axes->size(); ++k)
        (*one->half_lengths)[static_cast<int>(k)] = (*kind.semi_axes)[k] / import.length_unit;
    }
    if (kind.mass) one->mass = kind.mass;
  }
}

}  // namespace

KnownSystem known_system(const Parameters& parameters) {
  KnownSystem known;
  known.import = parameters.import;
  known.dimension = parameters.import.dimension;
  const std::optional<std::vector<double>>& box = parameters.import.box;
  if (!known.dimension && box && box->size() == 2) known.dimension = 2;
  if (place_of(parameters, "system.dimension")) known.dimension = parameters.system.dimension;
  const StateStage* stage = start_state(parameters.stages);
  if (stage && stage->box) {
    known.box = Vec3(Vec3::Ones());
    std::ranges::copy(*stage->box, known.box->data());
  }
  if (box) {
    known.box = Vec3(Vec3::Ones());
    std::ranges::copy(*box, known.box->data());
    *known.box /= parameters.import.length_unit;
  }
  known.species = known_species(parameters);
  add_imported(known.species, parameters.import);
  return known;
}

int start_dimension(const Parameters& parameters) {
  const StateStage& stage = start_of(parameters);
  if (!stage.file) return parameters.system.dimension;
  return dimension_of_file(*stage.file, known_system(parameters));
}

namespace {

template <int Dim>
void take_agreeing(Parameters& parameters, const Configuration<Dim>& state, const std::string& file,
                   const std::string& recorded) {
  SystemParameters& system = parameters.system;
  if (place_of(parameters, "system.dimension") && system.dimension != Dim)
    refuse(other_number("system.dimension", system.dimension, Dim), parameters, file);
  system.dimension = Dim;
  take(system.particles, static_cast<std::int64_t>(state.size()), "system.particles", parameters,
       file);
  const double fraction = packing_fraction(state);
  if (keep_packing_fraction(parameters.stages))
    take(system.packing_fraction, fraction, "system.packing_fraction", parameters, file);
  if (StateStage* stage = start_state(parameters.stages)) stage->packing_fraction = fraction;
  take_species(parameters, state, {file, recorded});
}

}  // namespace

template <int Dim>
void take_system(Parameters& parameters, const Configuration<Dim>& state, const std::string& file,
                 const std::string& recorded) {
  const bool may_be_shrunk = start_of(parameters).on_overlap == StateStage::OnOverlap::shrink;
  const std::map<std::string, std::string> given = parameters.given;
  if (may_be_shrunk) parameters.given.clear();
  take_agreeing(parameters, state, file, recorded);
  parameters.given = given;
}

template <int Dim>
Configuration<Dim> read_start(Parameters& parameters, bool overlaps_allowed, const Log& log) {
  const StateStage stage = start_of(parameters);
  const std::string name = name_of(parameters);
  Configuration<Dim> state;
  std::string recorded;
  if (stage.file) {
    const TrajectoryReader reader(*stage.file, known_system(parameters));
    state = read_state<Dim>(reader);
    recorded = reader.provenance().parameters;
    for (const auto& [heading, text] : reader.import_report())
      log_line(log, fmt::format("{}: {}: {}", name, heading, text));
  } else {
    state = inline_state<Dim>(parameters);
  }
  if (!parameters.dynamics.contact) state.close_pairs.clear();
  take_agreeing(parameters, state, name, recorded);
  if (!place_of(parameters, "species")) log_line(log, "species as in " + name);
  if (stage.on_overlap == StateStage::OnOverlap::shrink) {
    const double scale = shrink_to_contact(state);
    if (scale < 1)
      log_line(log, fmt::format("{}: all particles are scaled by 1 − {:.3g}, so that none overlap",
                                name, 1 - scale));
    take_system(parameters, state, name, recorded);
  } else if (!overlaps_allowed || parameters.stages.size() > 1) {
    refuse_overlaps(state, name);
  }
  return state;
}

template void take_system(Parameters&, const Configuration2&, const std::string&,
                          const std::string&);
template void take_system(Parameters&, const Configuration3&, const std::string&,
                          const std::string&);
template Configuration2 read_start(Parameters&, bool, const Log&);
template Configuration3 read_start(Parameters&, bool, const Log&);

}  // namespace vitrel
