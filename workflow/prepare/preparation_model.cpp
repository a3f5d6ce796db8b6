#include "workflow/prepare/preparation_model.h"

#include <fmt/format.h>

#include <type_traits>
#include <variant>

#include "edmd/engine.h"

namespace vitrel {
namespace {

template <int Dim>
std::string monte_carlo_model(Moves moves, const Configuration<Dim>& some) {
  const bool is_round = rotor_count(some) == 0;
  const char* round = Dim == 2 ? "disks" : "spheres";
  const char* other = Dim == 2 ? "ellipses" : "ellipsoids";
  return fmt::format("{} of {}, since {}", moves == Moves::chains ? "event chains" : "local moves",
                     is_round ? round : other,
                     is_round ? "all particles are round" : "some particle is not round");
}

template <int Dim>
std::string growth_model(const Configuration<Dim>& some) {
  EngineOptions growing;
  growing.growth_rate = 1;
  return make_engine(some, growing)->description();
}

template <class S, int Dim>
std::string stage_model(const S& stage, const Configuration<Dim>& some) {
  if constexpr (std::is_same_v<S, GrowStage>)
    return growth_model(some);
  else if constexpr (std::is_same_v<S, HybridStage>)
    return growth_model(some) + ", and " + monte_carlo_model(stage.moves, some);
  else if constexpr (std::is_same_v<S, SampleStage>)
    return monte_carlo_model(stage.moves, some);
  else
    return monte_carlo_model(Moves::local, some);
}

}  // namespace

template <int Dim>
std::string preparation_model(const Parameters& parameters, const Configuration<Dim>& some) {
  std::string text;
  for (const Stage& stage : parameters.stages) {
    const char* name = method_name(stage);
    if (places_particles(name)) continue;
    const std::string model =
        std::visit([&](const auto& options) { return stage_model(options, some); }, stage);
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", name, model);
  }
  return text;
}

template std::string preparation_model(const Parameters&, const Configuration2&);
template std::string preparation_model(const Parameters&, const Configuration3&);

}  // namespace vitrel
