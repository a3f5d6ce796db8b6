#include "mc/decorrelation_count.h"

#include <numbers>

namespace vitrel {

namespace {

/// Calls visit(x) for every number that describes the pose of particle i.
template <class Visit>
void each_number(auto& c, std::size_t i, Visit&& visit) {
  for (auto& x : c.position[i]) visit(x);
  for (auto& n : c.image[i]) visit(n);
  if constexpr (requires { c.angle; })
    visit(c.angle[i]);
  else
    for (auto& q : c.orientation[i].coeffs()) visit(q);
}

template <int Dim>
std::vector<double> numbers_of(const Configuration<Dim>& c) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < c.size(); ++i)
    each_number(c, i, [&](const auto& x) { numbers.push_back(static_cast<double>(x)); });
  return numbers;
}

template <int Dim>
Configuration<Dim> with_numbers(Configuration<Dim> c, const std::vector<double>& numbers) {
  auto next = numbers.begin();
  for (std::size_t i = 0; i < c.size(); ++i)
    each_number(c, i, [&]<class X>(X& x) { x = static_cast<X>(*next++); });
  return c;
}

}  // namespace

template <int Dim>
DecorrelationCount<Dim>::DecorrelationCount(const Configuration<Dim>& configuration,
                                            DecorrelationState& state, std::uint64_t sweeps)
    : configuration_(configuration), state_(state) {
  if (state.first.empty())
    begin(sweeps);
  else
    correlation_.emplace(with_numbers(configuration, state.first));
}

template <int Dim>
void DecorrelationCount<Dim>::begin(std::uint64_t sweeps) {
  state_.places = state_.orientations = state_.sizes = false;
  state_.begin = sweeps;
  state_.next = sweeps + 1;
  state_.first = numbers_of(configuration_);
  correlation_.emplace(configuration_);
}

template <int Dim>
void DecorrelationCount<Dim>::update(std::uint64_t sweeps) {
  if (sweeps < state_.next) return;
  compare();
  if (state_.places && state_.orientations && state_.sizes) {
    ++state_.count;
    begin(sweeps);
  } else {
    state_.next = sweeps + 1 + (sweeps - state_.begin) / 10;
  }
}

template <int Dim>
void DecorrelationCount<Dim>::compare() {
  constexpr double decayed = 1 / std::numbers::e;
  const PlaceCorrelations now = correlation_->with(configuration_);
  state_.places |= now.places < decayed;
  state_.orientations |= now.orientations < decayed;
  state_.sizes |= now.sizes < decayed;
}

template class DecorrelationCount<2>;
template class DecorrelationCount<3>;

}  // namespace vitrel
