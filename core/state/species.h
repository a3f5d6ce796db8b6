#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/ellipse.h"
#include "core/geometry/ellipsoid.h"
#include "core/geometry/vector.h"

/// @file
/// The species of a system, and how their shapes are drawn.
namespace vitrel {

class Stream;
template <int Dim>
struct Configuration;

/// One number, or a distribution of numbers.
struct Distribution {
  enum class Kind { constant, gaussian, lognormal, uniform, power_law };

  Kind kind = Kind::constant;
  double mean = 1;                ///< constant: the value; gaussian, lognormal: ⟨x⟩
  double standard_deviation = 0;  ///< gaussian, lognormal: of x itself, not of ln x
  double low = 0, high = 0;       ///< uniform, power law
  double minimum = 0;             ///< nothing below it; of no effect on a constant
  double exponent = -3;           ///< power law: density ∝ x^exponent between low and high

  /// Whether low and high bound it.
  bool is_bounded() const { return kind == Kind::uniform || kind == Kind::power_law; }

  double draw(Stream& stream) const;
  /// n values, the quantiles (i + ½)/n of the distribution that the minimum cuts off, in rising order. Gaussian and
  /// lognormal ones are moved and stretched to the mean and standard deviation given, unless this would leave the range.
  /// UserError if practically all lies below the minimum, as for draw.
  std::vector<double> quantiles(std::size_t n) const;
};

/// One species. Its shape is given by the aspect ratio κ = a/b ≥ 1 and the size √(a b), so a = size
/// √κ and b = size/√κ. In three dimensions it is given by two aspect ratios, semi-axes a : a/R_1 : a/R_2,
/// and the size (a b c)^(1/3), so a = size (R_1 R_2)^(1/3); one aspect ratio means R_1 = R_2 = κ, a
/// prolate spheroid. Instead of the size, a may be given, or instead of all of these the semi-axes.
struct Species {
  std::string name = "A";
  double fraction = 1;                       ///< share of all particles
  std::optional<Distribution> aspect_ratio;  ///< 1 if neither it nor another shape is given
  std::optional<std::array<Distribution, 2>> aspect_ratios;  ///< R_1, R_2; in three dimensions only
  std::optional<Distribution> size;                          ///< 1 if neither it nor a is given
  std::optional<Distribution> first_semi_axis;               ///< a; excludes the size
  /// In two dimensions the larger of two draws is a. Excludes the four above.
  std::optional<std::vector<Distribution>> semi_axes;
  std::optional<double> mass;  ///< of every particle; a b (a b c: uniform density) if not given
  std::optional<double>
      initial_temperature;  ///< kT of drawn velocities at the start of a run; 1 if not given

  /// Whether its particles are all alike.
  bool has_one_shape() const;
};

/// The number of particles of each species: the shares rounded down, and the remaining particles given to the
/// largest remainders (the earlier species on a tie). The counts add up to `particles`.
std::vector<std::size_t> species_counts(const std::vector<Species>& species, std::size_t particles);

/// The largest ratio of the longest to the shortest semi-axis of a particle that is drawn. Contacts are tested up to it.
inline constexpr double max_aspect = 1000;

/// Where the shapes of particles come from if they are distributed.
enum class ShapeDraw {
  quantiles,  ///< a list that the species and their counts determine: all seeds are one liquid
  random,     ///< drawn anew for each seed
};

/// N particles at rest at the origin, mixed in a random order, in the box of that packing fraction
/// whose sides have these proportions. The order comes from the stream (seed, shapes, 0, 0). By quantiles, the particles of
/// a species have the quantiles of their distributions as shapes; the values of several distributions are paired in the
/// order of the multiples of an irrational number, without correlation. At random, the shape of particle i comes from
/// (seed, shapes, 1, i). Shapes are not rescaled: the unit of length is that
/// of the sizes given. At least one species; the fractions add up to 1. Throws UserError if a particle exceeds
/// max_aspect.
template <int Dim>
Configuration<Dim> draw_particles(const std::vector<Species>& species, std::size_t particles,
                                  double packing_fraction, const Vec<Dim>& proportions,
                                  std::uint64_t seed, ShapeDraw shapes = ShapeDraw::quantiles);

}  // namespace vitrel
