#include "workflow/picture/colours.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "analysis/structure/order.h"
#include "core/error.h"
#include "core/io/suggestion.h"
#include "core/parallel.h"
#include "core/state/figure_axis.h"

namespace vitrel {
namespace {

constexpr Colour round_grey = {154, 163, 173};
constexpr double share_beyond_scale = 0.02;

Colour colour_of(std::uint32_t rgb) {
  return {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8),
          static_cast<std::uint8_t>(rgb)};
}

std::uint8_t channel(double value) {
  return static_cast<std::uint8_t>(std::lround(value));
}

/// Converts linear light from 0 to 1 to a channel of sRGB.
std::uint8_t encoded(double light) {
  const double clipped = std::clamp(light, 0.0, 1.0);
  return channel(
      255 * (clipped <= 0.0031308 ? 12.92 * clipped : 1.055 * std::pow(clipped, 1 / 2.4) - 0.055));
}

Colour orientation_of_particle(const Configuration2& configuration, std::size_t i) {
  return orientation_colour(configuration.angle[i]);
}
Colour orientation_of_particle(const Configuration3& configuration, std::size_t i) {
  return orientation_colour(figure_axis(configuration.shape[i], configuration.orientation[i]));
}

template <int Dim>
std::vector<double> sizes(const Configuration<Dim>& configuration) {
  const double unit = ParticleShape<Dim>().volume();
  std::vector<double> result;
  for (const ParticleShape<Dim>& shape : configuration.shape)
    result.push_back(std::pow(shape.volume() / unit, 1.0 / Dim));
  return result;
}

template <int Dim, class ColourOf>
std::vector<Colour> colours_of_all(const Configuration<Dim>& configuration, ColourOf&& colour_of) {
  std::vector<Colour> colours;
  for (std::size_t i = 0; i < configuration.size(); ++i) colours.push_back(colour_of(i));
  return colours;
}

}  // namespace

Colour sequential_colour(double x) {
  static constexpr std::array<std::uint32_t, 9> viridis = {
      0x440154, 0x472c7a, 0x3b518b, 0x2c718e, 0x21908d, 0x27ad81, 0x5cc863, 0xaadc32, 0xfde725};
  const double place = (x > 0 ? std::min(x, 1.0) : 0) * (viridis.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(place), viridis.size() - 2);
  const double share = place - static_cast<double>(k);
  const Colour low = colour_of(viridis[k]), high = colour_of(viridis[k + 1]);
  Colour colour;
  for (std::size_t c = 0; c < colour.size(); ++c)
    colour[c] = channel((1 - share) * low[c] + share * high[c]);
  return colour;
}

// The colours lie on a circle in OKLab, spanned by the two directions that everyone can distinguish: lightness, and
// blue to yellow.
Colour orientation_colour(double angle) {
  const double phase = 2 * angle;
  const double lightness = 0.64 + 0.24 * std::cos(phase);
  const double yellow = 0.125 * std::sin(phase), red = 0.045 * std::sin(phase);
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(lightness + 0.3963377774 * red + 0.2158037573 * yellow);
  const double m = cube(lightness - 0.1055613458 * red - 0.0638541728 * yellow);
  const double s = cube(lightness - 0.0894841775 * red - 1.291485548 * yellow);
  return {encoded(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          encoded(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          encoded(-0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s)};
}

Colour orientation_colour(const Vec3& axis) {
  Mat3 of_axes;
  of_axes << 238, 52, 84, 170, 176, 72, 40, 160, 196;
  const Vec3 mixed = of_axes * axis.cwiseAbs2();
  return {channel(mixed[0]), channel(mixed[1]), channel(mixed[2])};
}

Colour species_colour(std::int32_t species) {
  static constexpr std::array<std::uint32_t, 8> palette = {0x0072b2, 0xc65200, 0x00805c, 0xb1407f,
                                                           0x8a7a00, 0x6a4fc4, 0xa8281c, 0x3c434b};
  return colour_of(palette[static_cast<std::size_t>(species) % palette.size()]);
}

const std::vector<std::string>& colourings() {
  static const std::vector<std::string> names = {"orientation", "species", "psi6", "displacement",
                                                 "size"};
  return names;
}

ColourScale range_of(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto [low, high] = std::ranges::minmax(values);
  return {low, high};
}

template <int Dim>
std::string default_colouring(const Configuration<Dim>& configuration) {
  return rotor_count(configuration) > 0 ? "orientation" : "species";
}

template <int Dim>
std::vector<Colour> particle_colours(const Configuration<Dim>& configuration,
                                     const std::string& colouring,
                                     std::optional<ColourScale>& scale) {
  if (colouring == "orientation")
    return colours_of_all(configuration, [&](std::size_t i) {
      return configuration.shape[i].is_round() ? round_grey
                                               : orientation_of_particle(configuration, i);
    });
  if (colouring == "species")
    return colours_of_all(configuration,
                          [&](std::size_t i) { return species_colour(configuration.species[i]); });
  if (colouring == "size") {
    const std::vector<double> values = sizes(configuration);
    scale = range_of(values);
    return sequential_colours(values, *scale);
  }
  if (colouring == "displacement")
    throw UserError("the colours of displacement need the frames of a run, as of a file");
  if (colouring != "psi6")
    throw UserError(fmt::format("colour '{}' is none of {}{}", colouring,
                                fmt::join(colourings(), ", "),
                                suggestion(colouring, colourings())));
  if constexpr (Dim == 2) {
    scale = {0, 1};
    const auto orders = local_hexatic_orders(configuration, all_cores);
    return colours_of_all(configuration,
                          [&](std::size_t i) { return sequential_colour(std::abs(orders[i])); });
  } else {
    throw UserError("the colours of psi6 are for two dimensions");
  }
}

std::vector<Colour> sequential_colours(const std::vector<double>& values,
                                       const ColourScale& scale) {
  const double width = scale.high > scale.low ? scale.high - scale.low : 1;
  std::vector<Colour> colours;
  for (const double value : values)
    colours.push_back(sequential_colour((value - scale.low) / width));
  return colours;
}

ColourScale displacement_scale(std::vector<double> displacements) {
  if (displacements.empty()) return {};
  const auto place = static_cast<std::ptrdiff_t>((1 - share_beyond_scale) *
                                                 static_cast<double>(displacements.size() - 1));
  std::ranges::nth_element(displacements, displacements.begin() + place);
  const double largest = displacements[static_cast<std::size_t>(place)];
  return {0, largest > 0 ? largest : 1};
}

template std::string default_colouring(const Configuration2&);
template std::string default_colouring(const Configuration3&);
template std::vector<Colour> particle_colours(const Configuration2&, const std::string&,
                                              std::optional<ColourScale>&);
template std::vector<Colour> particle_colours(const Configuration3&, const std::string&,
                                              std::optional<ColourScale>&);

}  // namespace vitrel
