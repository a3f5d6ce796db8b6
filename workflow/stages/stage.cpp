#include "workflow/stages/stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/io/parameters.h"

namespace vitrel {
namespace {

/// Packing fractions that differ by less count as equal, because those of states carry rounding errors.
constexpr double packing_fraction_slack = 1e-9;

/// Calls `use(stage)` for every kind of stage, with its default options.
void each_kind(auto&& use) {
  [&]<std::size_t... k>(std::index_sequence<k...>) {
    (use(std::variant_alternative_t<k, Stage>()), ...);
  }
  (std::make_index_sequence<std::variant_size_v<Stage>>());
}

/// The names of all methods for which `applies(stage)` holds.
std::vector<const char*> methods(auto&& applies) {
  std::vector<const char*> names;
  each_kind([&]<class S>(const S& stage) {
    if (applies(stage)) names.push_back(S::method);
  });
  return names;
}

/// Lists the names as "a", "b" or "c", with the last two joined by `conjunction`.
std::string listed(const std::vector<const char*>& names, const std::string& conjunction) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (k > 0) text += k + 1 < names.size() ? ", " : " " + conjunction + " ";
    text += fmt::format("\"{}\"", names[k]);
  }
  return text;
}

std::string summaries() {
  std::string text = "Method of the stage. ";
  each_kind([&]<class S>(const S&) {
    text += fmt::format("{}{}: {}", text.ends_with(". ") ? "" : "; ", S::method, S::summary);
  });
  return text + ".";
}

Stage stage_of_kind(std::size_t index) {
  Stage found;
  each_kind([&, k = std::size_t{0}](const auto& stage) mutable {
    if (k++ == index) found = stage;
  });
  return found;
}

template <class S>
bool has_key(const std::string& key) {
  return std::ranges::any_of(S::fields(), [&](const auto& field) { return field.key == key; });
}

/// The keys of all stages, each listed once.
std::vector<std::string> all_keys() {
  std::vector<std::string> keys;
  each_kind([&]<class S>(const S&) {
    for (const StageField<S>& field : S::fields())
      if (std::ranges::find(keys, field.key) == keys.end()) keys.push_back(field.key);
  });
  return keys;
}

std::vector<const char*> methods_with(const std::string& key) {
  return methods([&]<class S>(const S&) { return has_key<S>(key); });
}

/// Describes one key of the stage; does nothing if the stage does not have it.
void describe_key(Stage& stage, const std::string& key, FieldVisitor& visit) {
  std::visit(
      [&]<class S>(S& options) {
        for (const StageField<S>& field : S::fields())
          if (field.key == key) field.describe(options, visit);
      },
      stage);
}

/// The first kind of stage that has the key.
Stage owner_of(const std::string& key) {
  std::optional<Stage> owner;
  each_kind([&]<class S>(const S& stage) {
    if (!owner && has_key<S>(key)) owner = stage;
  });
  return *owner;
}

std::optional<double> own_packing_fraction(const Stage& stage) {
  return std::visit(
      [](const auto& options) -> std::optional<double> {
        if constexpr (requires { options.packing_fraction; })
          return options.packing_fraction;
        else
          return std::nullopt;
      },
      stage);
}

StageEnding ending(const Stage& stage) {
  return std::visit([](const auto& options) { return options.ending(); }, stage);
}

/// Requires that the first stage places the particles and that later ones move them.
template <class S>
void validate_place(const S&, bool is_first, const Rules& rules) {
  const auto places = []<class T>(const T&) { return T::places_particles; };
  const auto moves = []<class T>(const T&) { return !T::places_particles; };
  rules.require(S::places_particles == is_first, "method",
                is_first
                    ? fmt::format("of the first stage must be {}, which place the particles",
                                  listed(methods(places), "or"))
                    : fmt::format("of a later stage must be {}: the particles have their places",
                                  listed(methods(moves), "or")));
}

void validate_packing_fraction(const Stage& stage, const SystemParameters& system,
                               const PackingBound& bound, double before, const Rules& rules) {
  const std::optional<double> own = own_packing_fraction(stage);
  if (own) rules.packing_fraction(*own, "packing_fraction", bound);
  const double goal = own.value_or(end_of_stage(stage, system, before));
  // A stage without a packing fraction of its own ends at that of the system, which is then to blame.
  (own ? rules : Rules("system"))
      .require(goal >= before * (1 - packing_fraction_slack), "packing_fraction",
               fmt::format("is {}, but the stage before ends at {}, and no stage shrinks",
                           show(goal), show(before)));
}

}  // namespace

bool places_particles(const std::string& method) {
  bool places = false;
  each_kind([&]<class S>(const S&) { places |= S::places_particles && method == S::method; });
  return places;
}

const StateStage* start_state(const std::vector<Stage>& stages) {
  return stages.empty() ? nullptr : std::get_if<StateStage>(&stages.front());
}

StateStage* start_state(std::vector<Stage>& stages) {
  return stages.empty() ? nullptr : std::get_if<StateStage>(&stages.front());
}

bool keep_packing_fraction(const std::vector<Stage>& stages) {
  return std::all_of(stages.begin() + 1, stages.end(),
                     [](const Stage& stage) { return ending(stage) == StageEnding::unchanged; });
}

bool end_in_equilibrium(const std::vector<Stage>& stages) {
  constexpr std::uint64_t enough = 10;
  const auto* sampling = std::get_if<SampleStage>(&stages.back());
  return sampling && sampling->decorrelations >= enough;
}

const char* method_name(const Stage& stage) {
  return std::visit([]<class S>(const S&) { return S::method; }, stage);
}

void describe_stage(Stage& stage, FieldVisitor& visit) {
  const auto any = [](const auto&) { return true; };
  std::size_t kind = stage.index();
  visit.choice({"method", "", summaries()}, kind, methods(any));
  if (kind != stage.index()) stage = stage_of_kind(kind);
  const std::vector<std::string> keys = all_keys();
  for (std::size_t k = 0, next; k < keys.size(); k = next) {
    const auto has = [&]<class S>(const S&) { return has_key<S>(keys[k]); };
    next = k + 1;
    while (next < keys.size() && methods_with(keys[next]) == methods_with(keys[k])) ++next;
    const bool applies = std::visit(has, stage);
    visit.when(applies, "method = " + listed(methods_with(keys[k]), "or"), [&](FieldVisitor& in) {
      Stage owner = owner_of(keys[k]);
      for (std::size_t i = k; i < next; ++i) describe_key(applies ? stage : owner, keys[i], in);
    });
  }
}

void validate_stages(const std::vector<Stage>& stages, const SystemParameters& system,
                     const PackingBound& bound) {
  if (stages.empty())
    throw BadValue("prepare.stage", "is empty, but there must be at least one [[prepare.stage]]");
  double reached = 0;
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const Rules rules(fmt::format("prepare.stage.{}", k));
    std::visit(
        [&](const auto& options) {
          validate_place(options, k == 0, rules);
          options.validate(rules, system.dimension);
        },
        stages[k]);
    validate_packing_fraction(stages[k], system, bound, reached, rules);
    reached = end_of_stage(stages[k], system, reached);
  }
  if (!has_unknown_end(stages) &&
      std::abs(reached - system.packing_fraction) > packing_fraction_slack)
    throw BadValue(
        fmt::format("prepare.stage.{}", stages.size() - 1),
        fmt::format("ends at the packing fraction {}, but system.packing_fraction is {}; let the "
                    "last stage that is not \"sample\" end there (insert: packing_fraction = {}, "
                    "or a stage that swells, compresses or grows)",
                    show(reached), show(system.packing_fraction), show(system.packing_fraction)));
}

double end_of_stage(const Stage& stage, const SystemParameters& system, double before) {
  if (ending(stage) != StageEnding::packing_fraction) return before;
  const auto by_default = [&](const auto& options) {
    return options.default_packing_fraction(system);
  };
  return own_packing_fraction(stage).value_or(std::visit(by_default, stage));
}

bool has_unknown_end(const std::vector<Stage>& stages) {
  const auto last = std::find_if(stages.rbegin(), stages.rend(), [](const Stage& stage) {
    return ending(stage) != StageEnding::unchanged;
  });
  return last != stages.rend() && ending(*last) == StageEnding::unforeseen;
}

std::string stage_description(const Stage& stage, double packing_fraction) {
  const std::string own =
      std::visit([](const auto& options) { return options.description(); }, stage);
  if (!own.empty()) return own;
  const char* name = method_name(stage);
  return fmt::format("{} {} packing fraction {:.4g}", name, places_particles(name) ? "at" : "to",
                     packing_fraction);
}

}  // namespace vitrel
