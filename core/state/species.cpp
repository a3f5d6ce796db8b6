#include "core/state/species.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/elementary.h"
#include "core/error.h"
#include "core/random/stream.h"
#include "core/state/configuration.h"

namespace vitrel {
namespace {

double draw_once(const Distribution& d, Stream& stream) {
  switch (d.kind) {
    case Distribution::Kind::constant:
      return d.mean;
    case Distribution::Kind::gaussian:
      return d.mean + d.standard_deviation * stream.normal();
    case Distribution::Kind::lognormal: {
      // ln x has variance s² = ln(1 + (σ/⟨x⟩)²) and mean ln⟨x⟩ − s²/2.
      const double ratio = d.standard_deviation / d.mean;
      const double variance = logarithm_of_one_plus(ratio * ratio);
      return d.mean * exponential(std::sqrt(variance) * stream.normal() - 0.5 * variance);
    }
    case Distribution::Kind::uniform:
      return stream.uniform(d.low, d.high);
    case Distribution::Kind::power_law: {
      // With m = exponent + 1 the distribution function is linear in x^m. From the bound at which the density of ln x
      // is greater, so that no power overflows.
      const double width = logarithm(d.high / d.low), m = d.exponent + 1, u = stream.uniform();
      if (m == 0) return d.low * exponential(u * width);
      const double from_bound =
          logarithm_of_one_plus(u * exponential_minus_one(-std::abs(m) * width)) / m;
      return (m < 0 ? d.low : d.high) * exponential(from_bound);
    }
  }
  return d.mean;
}

double draw_or_one(const std::optional<Distribution>& distribution, Stream& stream) {
  return distribution ? distribution->draw(stream) : 1;
}

void draw_shape(const Species& species, Stream& stream, Ellipse& shape) {
  if (species.semi_axes) {
    const double one = species.semi_axes->at(0).draw(stream);
    const double other = species.semi_axes->at(1).draw(stream);
    shape = {std::max(one, other), std::min(one, other)};
    return;
  }
  const double ratio = draw_or_one(species.aspect_ratio, stream);
  if (species.first_semi_axis) {
    const double a = species.first_semi_axis->draw(stream);
    shape = {a, a / ratio};
    return;
  }
  const double size = draw_or_one(species.size, stream);
  shape = {size * std::sqrt(ratio), size / std::sqrt(ratio)};
}

void draw_shape(const Species& species, Stream& stream, Ellipsoid& shape) {
  if (species.semi_axes) {
    for (std::size_t k = 0; k < 3; ++k)
      shape.semi_axes[static_cast<int>(k)] = species.semi_axes->at(k).draw(stream);
    return;
  }
  double ratio1 = 1, ratio2 = 1;
  if (species.aspect_ratios) {
    ratio1 = (*species.aspect_ratios)[0].draw(stream);
    ratio2 = (*species.aspect_ratios)[1].draw(stream);
  } else {
    ratio1 = ratio2 = draw_or_one(species.aspect_ratio, stream);
  }
  const double a = species.first_semi_axis
                       ? species.first_semi_axis->draw(stream)
                       : draw_or_one(species.size, stream) * root(ratio1 * ratio2, 3);
  shape = {Vec3(a, a / ratio1, a / ratio2)};
}

template <class Shape>
void require_tested_aspect(const Species& species, const Shape& shape) {
  const double aspect = shape.circumradius() / shape.inradius();
  if (!(aspect <= max_aspect))
    throw UserError(
        fmt::format("species {}: the longest semi-axis of a particle is {:.4g} times the shortest, "
                    "but must be at most {} times: contacts of longer particles are not tested",
                    species.name, aspect, max_aspect));
}

// Fisher and Yates.
void shuffle(std::vector<std::int32_t>& values, Stream stream) {
  for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[stream.below(i)]);
}

}  // namespace

double natural_mass(const Ellipse& shape) {
  return shape.a * shape.b;
}

double natural_mass(const Ellipsoid& shape) {
  return prod(shape.semi_axes);
}

double Distribution::draw(Stream& stream) const {
  constexpr int max_draws = 10'000;
  for (int k = 0; k < max_draws; ++k)
    if (const double value = draw_once(*this, stream); kind == Kind::constant || value >= minimum)
      return value;
  throw UserError("a distribution lies below its minimum " + std::to_string(minimum) +
                  " practically always; lower the minimum or raise the mean");
}

std::vector<std::size_t> species_counts(const std::vector<Species>& species,
                                        std::size_t particles) {
  std::vector<std::size_t> counts;
  std::vector<double> remainders;
  for (const Species& kind : species) {
    const double share = kind.fraction * static_cast<double>(particles);
    // A share that is whole but for rounding is whole.
    const double whole = std::floor(share * (1 + 1e-12));
    counts.push_back(static_cast<std::size_t>(whole));
    remainders.push_back(share - whole);
  }
  std::vector<std::size_t> order(species.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return remainders[i] > remainders[j]; });
  std::size_t given = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
  for (std::size_t k = 0; given < particles; ++k, ++given) ++counts[order[k % order.size()]];
  return counts;
}

namespace {

/// Everything but the box.
template <int Dim>
Configuration<Dim> draw(const std::vector<Species>& species, std::size_t particles,
                        std::uint64_t seed) {
  Configuration<Dim> system;
  system.resize(particles);
  system.species.clear();
  system.species_names.clear();
  const std::vector<std::size_t> counts = species_counts(species, particles);
  for (std::size_t k = 0; k < species.size(); ++k) {
    system.species_names.push_back(species[k].name);
    system.species.insert(system.species.end(), counts[k], static_cast<std::int32_t>(k));
  }
  shuffle(system.species, Stream(seed, Purpose::shapes));
  for (std::size_t i = 0; i < particles; ++i) {
    const Species& kind = species[static_cast<std::size_t>(system.species[i])];
    Stream stream(seed, Purpose::shapes, 1, i);
    draw_shape(kind, stream, system.shape[i]);
    require_tested_aspect(kind, system.shape[i]);
    system.mass[i] = kind.mass.value_or(natural_mass(system.shape[i]));
  }
  return system;
}

template <int Dim>
double total_volume(const Configuration<Dim>& system) {
  double sum = 0;
  for (const Solid<Dim>& shape : system.shape) sum += shape.volume();
  return sum;
}

}  // namespace

template <int Dim>
Configuration<Dim> draw_particles(const std::vector<Species>& species, std::size_t particles,
                                  double packing_fraction, const Vec<Dim>& proportions,
                                  std::uint64_t seed) {
  Configuration<Dim> system = draw<Dim>(species, particles, seed);
  const Vec<Dim> relative = proportions / proportions[0];
  const double cube = total_volume(system) / packing_fraction / prod(relative);
  const double width = root(cube, Dim);
  system.box = PeriodicBox<Dim>(relative * width);
  return system;
}

template Configuration2 draw_particles(const std::vector<Species>&, std::size_t, double,
                                       const Vec2&, std::uint64_t);
template Configuration3 draw_particles(const std::vector<Species>&, std::size_t, double,
                                       const Vec3&, std::uint64_t);

}  // namespace vitrel
