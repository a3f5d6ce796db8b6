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

/// Returns exp of a normal variable: ln x has variance s² = ln(1 + (σ/⟨x⟩)²) and mean ln⟨x⟩ − s²/2.
double lognormal(const Distribution& d, double standard_normal) {
  const double ratio = d.standard_deviation / d.mean;
  const double variance = logarithm_of_one_plus(ratio * ratio);
  return d.mean * exponential(std::sqrt(variance) * standard_normal - 0.5 * variance);
}

/// The inverse distribution function of the distribution without its minimum.
double untruncated_quantile(const Distribution& d, double u) {
  switch (d.kind) {
    case Distribution::Kind::constant:
      return d.mean;
    case Distribution::Kind::gaussian:
      return d.mean + d.standard_deviation * normal_quantile(u);
    case Distribution::Kind::lognormal:
      return lognormal(d, normal_quantile(u));
    case Distribution::Kind::uniform:
      return d.low + (d.high - d.low) * u;
    case Distribution::Kind::power_law: {
      // With m = exponent + 1 the distribution function is linear in x^m. It is inverted from the bound at which the
      // density of ln x is greater, so that no power overflows.
      const double width = logarithm(d.high / d.low), m = d.exponent + 1;
      if (m == 0) return d.low * exponential(u * width);
      const double share = exponential_minus_one(-std::abs(m) * width);
      return m < 0 ? d.low * exponential(logarithm_of_one_plus(u * share) / m)
                   : d.high * exponential(logarithm_of_one_plus((1 - u) * share) / m);
    }
  }
  return d.mean;
}

double draw_once(const Distribution& d, Stream& stream) {
  if (d.kind == Distribution::Kind::constant) return d.mean;
  if (d.kind == Distribution::Kind::gaussian)
    return d.mean + d.standard_deviation * stream.normal();
  if (d.kind == Distribution::Kind::lognormal) return lognormal(d, stream.normal());
  return untruncated_quantile(d, stream.uniform());
}

[[noreturn]] void refuse_minimum(const Distribution& d) {
  throw UserError("a distribution lies below its minimum " + std::to_string(d.minimum) +
                  " practically always; lower the minimum or raise the mean");
}

/// Returns the probability of a value below the minimum, by bisection.
double share_below_minimum(const Distribution& d) {
  double below = 0, above = 1;
  while (true) {
    const double middle = 0.5 * (below + above);
    if (middle == below || middle == above) return below;
    (untruncated_quantile(d, middle) < d.minimum ? below : above) = middle;
  }
}

/// Shifts and stretches the values to the mean and standard deviation of the distribution, unless a value would fall
/// below the minimum or below 0.
void fit_moments(std::vector<double>& values, const Distribution& d) {
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const double stretch = squares > 0 ? d.standard_deviation / std::sqrt(squares / n) : 1;
  const auto fitted = [&](double value) { return d.mean + stretch * (value - mean); };
  if (fitted(*std::ranges::min_element(values)) < std::max(d.minimum, 0.0)) return;
  std::ranges::transform(values, values.begin(), fitted);
}

/// Returns the numbers 0 … n − 1 in the order in which the k-th further distribution takes its values. They are sorted
/// by the fractional parts of the multiples of an irrational number, so that the values of several distributions are
/// paired without correlation.
std::vector<std::size_t> pairing(std::size_t n, std::size_t k) {
  static constexpr double irrational[] = {0, std::numbers::phi - 1, std::numbers::sqrt2 - 1};
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (k == 0) return order;
  std::vector<double> place;
  for (std::size_t i = 1; i <= n; ++i) {
    const double multiple = static_cast<double>(i) * irrational[k];
    place.push_back(multiple - std::floor(multiple));
  }
  std::ranges::sort(order, {}, [&](std::size_t i) { return place[i]; });
  return order;
}

// ---- shapes from their distributions: make_shape calls `value(distribution)` for each distribution in turn --------

double value_or_one(const std::optional<Distribution>& distribution, auto&& value) {
  return distribution ? value(*distribution) : 1;
}

void make_shape(const Species& species, auto&& value, Ellipse& shape) {
  if (species.semi_axes) {
    const double one = value(species.semi_axes->at(0));
    const double other = value(species.semi_axes->at(1));
    shape = {std::max(one, other), std::min(one, other)};
    return;
  }
  const double ratio = value_or_one(species.aspect_ratio, value);
  if (species.first_semi_axis) {
    const double a = value(*species.first_semi_axis);
    shape = {a, a / ratio};
    return;
  }
  const double size = value_or_one(species.size, value);
  shape = {size * std::sqrt(ratio), size / std::sqrt(ratio)};
}

void make_shape(const Species& species, auto&& value, Ellipsoid& shape) {
  if (species.semi_axes) {
    for (std::size_t k = 0; k < 3; ++k)
      shape.semi_axes[static_cast<int>(k)] = value(species.semi_axes->at(k));
    return;
  }
  double ratio1 = 1, ratio2 = 1;
  if (species.aspect_ratios) {
    ratio1 = value((*species.aspect_ratios)[0]);
    ratio2 = value((*species.aspect_ratios)[1]);
  } else {
    ratio1 = ratio2 = value_or_one(species.aspect_ratio, value);
  }
  const double a = species.first_semi_axis
                       ? value(*species.first_semi_axis)
                       : value_or_one(species.size, value) * root(ratio1 * ratio2, 3);
  shape = {Vec3(a, a / ratio1, a / ratio2)};
}

/// Returns the shapes of n particles of a species, by quantiles.
template <int Dim>
std::vector<ParticleShape<Dim>> listed_shapes(const Species& species, std::size_t n) {
  std::vector<ParticleShape<Dim>> shapes(n);
  if (n == 0) return shapes;
  std::vector<std::vector<double>> lists;
  std::size_t varying = 0;
  const auto list = [&](const Distribution& d) {
    const std::vector<double> values = d.quantiles(n);
    const bool varies = d.kind != Distribution::Kind::constant;
    const std::vector<std::size_t> order = pairing(n, varies ? varying++ : 0);
    lists.emplace_back();
    for (const std::size_t k : order) lists.back().push_back(values[k]);
    return 1.0;
  };
  make_shape(species, list, shapes[0]);
  for (std::size_t i = 0; i < n; ++i)
    make_shape(
        species, [&, k = 0U](const Distribution&) mutable { return lists[k++][i]; }, shapes[i]);
  return shapes;
}

void require_tested_aspect(const Species& species, const auto& shape) {
  const double aspect = shape.circumradius() / shape.inradius();
  if (!(aspect <= max_aspect))
    throw UserError(
        fmt::format("species {}: the longest semi-axis of a particle is {:.4g} times the shortest, "
                    "but must be at most {} times: contacts of longer particles are not tested",
                    species.name, aspect, max_aspect));
}

// This is the shuffle of Fisher and Yates.
std::vector<std::size_t> shuffled(std::size_t count, Stream stream) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[stream.below(i)]);
  return order;
}

}  // namespace

double Distribution::draw(Stream& stream) const {
  constexpr int max_draws = 10'000;
  for (int k = 0; k < max_draws; ++k)
    if (const double value = draw_once(*this, stream); kind == Kind::constant || value >= minimum)
      return value;
  refuse_minimum(*this);
}

std::vector<double> Distribution::quantiles(std::size_t n) const {
  if (kind == Kind::constant) return std::vector(n, mean);
  constexpr double practically_always = 0.9999;
  const double cut = share_below_minimum(*this);
  if (cut > practically_always) refuse_minimum(*this);
  std::vector<double> values;
  for (std::size_t k = 0; k < n; ++k) {
    const double u = (static_cast<double>(k) + 0.5) / static_cast<double>(n);
    values.push_back(std::max(untruncated_quantile(*this, cut + (1 - cut) * u), minimum));
  }
  if (!is_bounded()) fit_moments(values, *this);
  return values;
}

bool Species::has_one_shape() const {
  const auto is_constant = [](const Distribution& d) {
    return d.kind == Distribution::Kind::constant;
  };
  const auto all_constant = [&](const auto& entries) {
    return !entries || std::ranges::all_of(*entries, is_constant);
  };
  const auto each_constant = [&](const auto&... entry) {
    return (... && (!entry || is_constant(*entry)));
  };
  return each_constant(aspect_ratio, size, first_semi_axis) && all_constant(aspect_ratios) &&
         all_constant(semi_axes);
}

std::vector<std::size_t> species_counts(const std::vector<Species>& species,
                                        std::size_t particles) {
  std::vector<std::size_t> counts;
  std::vector<double> remainders;
  for (const Species& kind : species) {
    const double share = kind.fraction * static_cast<double>(particles);
    // A share that is whole up to rounding counts as whole.
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

/// Draws everything but the box.
template <int Dim>
Configuration<Dim> draw(const std::vector<Species>& species, std::size_t particles,
                        std::uint64_t seed, ShapeDraw shapes_by) {
  Configuration<Dim> system;
  system.resize(particles);
  system.species.clear();
  system.species_names.clear();
  std::vector<std::int32_t> kinds;
  std::vector<ParticleShape<Dim>> shapes;
  const std::vector<std::size_t> counts = species_counts(species, particles);
  for (std::size_t k = 0; k < species.size(); ++k) {
    system.species_names.push_back(species[k].name);
    kinds.insert(kinds.end(), counts[k], static_cast<std::int32_t>(k));
    if (shapes_by == ShapeDraw::random) continue;
    const std::vector<ParticleShape<Dim>> listed = listed_shapes<Dim>(species[k], counts[k]);
    shapes.insert(shapes.end(), listed.begin(), listed.end());
  }
  const std::vector<std::size_t> order = shuffled(particles, Stream(seed, Purpose::shapes));
  for (std::size_t i = 0; i < particles; ++i) {
    system.species.push_back(kinds[order[i]]);
    const Species& kind = species[static_cast<std::size_t>(system.species[i])];
    if (shapes_by == ShapeDraw::quantiles) {
      system.shape[i] = shapes[order[i]];
    } else {
      Stream stream(seed, Purpose::shapes, 1, i);
      make_shape(
          kind, [&](const Distribution& d) { return d.draw(stream); }, system.shape[i]);
    }
    require_tested_aspect(kind, system.shape[i]);
    system.mass[i] = kind.mass.value_or(system.shape[i].natural_mass());
  }
  return system;
}

template <int Dim>
double total_volume(const Configuration<Dim>& system) {
  double sum = 0;
  for (const ParticleShape<Dim>& shape : system.shape) sum += shape.volume();
  return sum;
}

}  // namespace

template <int Dim>
Configuration<Dim> draw_particles(const std::vector<Species>& species, std::size_t particles,
                                  double packing_fraction, const Vec<Dim>& proportions,
                                  std::uint64_t seed, ShapeDraw shapes_by) {
  Configuration<Dim> system = draw<Dim>(species, particles, seed, shapes_by);
  const Vec<Dim> relative = proportions / proportions[0];
  const double cube = total_volume(system) / packing_fraction / prod(relative);
  const double width = root(cube, Dim);
  system.box = PeriodicBox<Dim>(relative * width);
  return system;
}

template Configuration2 draw_particles(const std::vector<Species>&, std::size_t, double,
                                       const Vec2&, std::uint64_t, ShapeDraw);
template Configuration3 draw_particles(const std::vector<Species>&, std::size_t, double,
                                       const Vec3&, std::uint64_t, ShapeDraw);

}  // namespace vitrel
