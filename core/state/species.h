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
  double minimum = 0;             ///< no value lies below it; without effect on a constant
  double exponent = -3;           ///< power law: density ∝ x^exponent between low and high

  /// Whether low and high bound the values.
  bool is_bounded() const { return kind == Kind::uniform || kind == Kind::power_law; }

  double draw(Stream& stream) const;
  /// Returns n values in ascending order: the quantiles (i + ½)/n of the distribution truncated at the minimum. Values
  /// of gaussian and lognormal distributions are shifted and stretched to the given mean and standard deviation, unless
  /// this would move them below the minimum or below 0. Throws UserError if practically all values lie below the
  /// minimum, as `draw` does.
  std::vector<double> quantiles(std::size_t n) const;
};

/// One species. Its shape is given by the aspect ratio κ = a/b ≥ 1 and the size √(a b), so that a = size √κ and
/// b = size/√κ. In three dimensions it is given by two aspect ratios and the size (a b c)^(1/3): the semi-axes are a :
/// a/R_1 : a/R_2 with a = size (R_1 R_2)^(1/3). A single aspect ratio κ means R_1 = R_2 = κ, a prolate spheroid. The
/// semi-axis a may be given instead of the size, or all semi-axes instead of aspect ratios and size.
struct Species {
  std::string name = "A";
  double fraction = 1;                       ///< share of all particles
  std::optional<Distribution> aspect_ratio;  ///< 1 if neither it nor another shape is given
  std::optional<std::array<Distribution, 2>> aspect_ratios;  ///< R_1, R_2; in three dimensions only
  std::optional<Distribution> size;                          ///< 1 if neither it nor a is given
  std::optional<Distribution> first_semi_axis;               ///< a; excludes the size
  /// The semi-axes; in two dimensions a is the larger of two draws. They exclude the four members above.
  std::optional<std::vector<Distribution>> semi_axes;
  std::optional<double> mass;  ///< each particle's mass, or a b (a b c: uniform density)
  std::optional<double>
      initial_temperature;  ///< kT of drawn velocities at the start of a run; 1 if not given

  /// Whether all its particles have the same shape.
  bool has_one_shape() const;
};

/// Returns the number of particles of each species: the shares are rounded down, and the remaining particles go to the
/// species with the largest remainders (on a tie, to the earlier one). The counts add up to `particles`.
std::vector<std::size_t> species_counts(const std::vector<Species>& species, std::size_t particles);

/// The largest allowed ratio of the longest to the shortest semi-axis of a particle that is drawn. Contacts are tested
/// up to this ratio.
inline constexpr double max_aspect = 1000;

/// How the shapes of particles are chosen if they are distributed.
enum class ShapeDraw {
  quantiles,  ///< from a list that depends on the species and their counts only, so all seeds give one liquid
  random,  ///< drawn anew for each seed
};

/// Returns N particles at rest at the origin, in a random order, in a box of the given packing fraction and proportions
/// of the sides. The order comes from the stream (seed, shapes, 0, 0).
///
/// `quantiles` gives the particles of a species the quantiles of their distributions as shapes; the values of several
/// distributions are paired in the order of the multiples of an irrational number, without correlation. `random` draws
/// the shape of particle i from the stream (seed, shapes, 1, i). Shapes are not rescaled: the unit of length is that of
/// the given sizes.
///
/// There must be at least one species, and the fractions must add up to 1. Throws UserError if the aspect ratio of a
/// particle exceeds max_aspect.
template <int Dim>
Configuration<Dim> draw_particles(const std::vector<Species>& species, std::size_t particles,
                                  double packing_fraction, const Vec<Dim>& proportions,
                                  std::uint64_t seed, ShapeDraw shapes = ShapeDraw::quantiles);

}  // namespace vitrel
