#include "workflow/prepare/preparation_model.h"

#include <fmt/format.h>

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

template <int Dim>
std::string stage_model(const SwellStage&, const Configuration<Dim>& some) {
  return monte_carlo_model(Moves::local, some);
}

template <int Dim>
std::string stage_model(const CompressStage&, const Configuration<Dim>& some) {
  return monte_carlo_model(Moves::local, some);
}

template <int Dim>
std::string stage_model(const SampleStage& stage, const Configuration<Dim>& some) {
  return monte_carlo_model(stage.moves, some);
}

template <int Dim>
std::string stage_model(const GrowStage&, const Configuration<Dim>& some) {
  return growth_model(some);
}

template <int Dim>
std::string stage_model(const HybridStage& stage, const Configuration<Dim>& some) {
  return growth_model(some) + ", and " + monte_carlo_model(stage.moves, some);
}

template <class S, int Dim>
requires S::places_particles std::string stage_model(const S&, const Configuration<Dim>&) {
  return "";
}

}  // namespace

template <int Dim>
std::string preparation_model(const Parameters& parameters, const Configuration<Dim>& some) {
  std::string text;
  for (const Stage& stage : parameters.stages) {
    const std::string model =
        std::visit([&](const auto& options) { return stage_model(options, some); }, stage);
    if (!model.empty())
      text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", method_name(stage), model);
  }
  return text;
}

template std::string preparation_model(const Parameters&, const Configuration2&);
template std::string preparation_model(const Parameters&, const Configuration3&);

}  // namespace vitrel
