#include "mc/place_correlation.h"

#include <numbers>

#include "core/elementary.h"
#include "core/state/figure_axis.h"

namespace vitrel {

namespace {

constexpr double reach = 0.3;      // in units of (V/N)^(1/D)
constexpr double rounding = 1e-9;  // relative, of sizes

/// Number of pairs per particle between independent configurations.
template <int Dim>
constexpr double chance =
    Dim == 2 ? std::numbers::pi* reach* reach : 4 * std::numbers::pi / 3 * reach* reach* reach;

}  // namespace

template <int Dim>
PlaceCorrelation<Dim>::PlaceCorrelation(const Configuration<Dim>& first)
    : first_(first), cells_(make_cells(first)), rotors_(static_cast<double>(rotor_count(first))) {
  const auto n = static_cast<double>(first.size());
  double mean = 0;
  for (const ParticleShape<Dim>& shape : first.shape) {
    deviation_.push_back(root(shape.volume(), Dim));
    mean += deviation_.back() / n;
  }
  for (double& deviation : deviation_) {
    deviation -= mean;
    square_ += deviation * deviation;
  }
  if (square_ < n * rounding * mean * rounding * mean) square_ = 0;
  reach_ = reach * root(first.box.volume() / n, Dim);
}

template <int Dim>
PlaceCorrelations PlaceCorrelation<Dim>::with(const Configuration<Dim>& later) const {
  const auto n = static_cast<double>(later.size());
  Vec<Dim> drift = Vec<Dim>::Zero();
  for (std::size_t i = 0; i < later.size(); ++i)
    drift += (later.unwrapped(i) - first_.unwrapped(i)) / n;
  double pairs = 0, aligned = 0, sizes = 0;
  for (std::size_t j = 0; j < later.size(); ++j)
    cells_.for_each_near(later.position[j] - drift, reach_,
                         [&](std::size_t i, const Shift<Dim>&, const Vec<Dim>&) {
                           ++pairs;
                           sizes += deviation_[i] * deviation_[j];
                           if (!first_.shape[i].is_round() && !later.shape[j].is_round())
                             aligned += alignment(first_, i, later, j);
                         });
  constexpr double expected = chance<Dim>;
  return {(pairs / n - expected) / (1 - expected), rotors_ > 0 ? aligned / rotors_ : 0,
          square_ > 0 ? sizes / square_ : 0};
}

template class PlaceCorrelation<2>;
template class PlaceCorrelation<3>;

}  // namespace vitrel
