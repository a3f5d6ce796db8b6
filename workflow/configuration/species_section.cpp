#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "analysis/results.h"
#include "workflow/configuration/distributions.h"
#include "workflow/configuration/sections.h"

namespace vitrel {
namespace {

void describe_optional_distribution(const Field& field, std::optional<Distribution>& value,
                                    double example, double minimum, FieldVisitor& visit) {
  visit.optional(
      field, value, example_of(example, minimum),
      [&](FieldVisitor& in, Distribution& inner) { describe_distribution(field, inner, in); });
}

bool is_positive_constant(const Distribution& d) {
  return d.kind == Distribution::Kind::constant && d.mean > 0 && std::isfinite(d.mean);
}

void validate_semi_axes(const Species& p, int dimension, const std::string& path) {
  const Rules rules(path);
  rules.require(
      !p.aspect_ratio && !p.aspect_ratios && !p.size && !p.first_semi_axis, "semi_axes",
      "excludes aspect_ratio and size, as well as aspect_ratios and first_semi_axis; give "
      "one or the other");
  const std::vector<Distribution>& axes = *p.semi_axes;
  bool fits = axes.size() == static_cast<std::size_t>(dimension);
  for (const Distribution& axis : axes)
    fits &= axis.kind != Distribution::Kind::constant || is_positive_constant(axis);
  if (fits && dimension == 2 && std::ranges::all_of(axes, is_positive_constant))
    fits = axes[0].mean >= axes[1].mean;
  rules.require(fits, "semi_axes",
                fmt::format("is {}, but must be {}", text(axes),
                            dimension == 2 ? "[a, b] with a ≥ b > 0" : "[a, b, c], all above 0"));
  for (std::size_t k = 0; k < axes.size(); ++k)
    if (axes[k].kind == Distribution::Kind::constant)
      rules.require(axes[k].mean >= 1 / max_draw && axes[k].mean <= max_draw,
                    fmt::format("semi_axes.{}", k),
                    fmt::format("is {}, but must lie between {} and {}", show(axes[k].mean),
                                show(1 / max_draw), show(max_draw)));
    else
      validate_distribution(axes[k], min_draw, fmt::format("{}.semi_axes.{}", path, k));
}

void validate_shape(const Species& p, int dimension, const std::string& path) {
  if (p.semi_axes) {
    validate_semi_axes(p, dimension, path);
    return;
  }
  const Rules rules(path);
  if (p.size) validate_distribution(*p.size, min_draw, path + ".size");
  if (p.first_semi_axis) {
    rules.require(!p.size, "first_semi_axis", "excludes size; give one or the other");
    validate_distribution(*p.first_semi_axis, min_draw, path + ".first_semi_axis");
  }
  if (p.aspect_ratios) {
    rules.require(dimension == 3, "aspect_ratios",
                  "has a meaning only with dimension = 3; give aspect_ratio");
    rules.require(!p.aspect_ratio, "aspect_ratios", "excludes aspect_ratio; give one or the other");
    for (int k = 0; k < 2; ++k)
      validate_distribution((*p.aspect_ratios)[k], min_draw,
                            fmt::format("{}.aspect_ratios.{}", path, k));
    return;
  }
  rules.require(p.aspect_ratio.has_value(), "aspect_ratio",
                dimension == 2
                    ? "is missing; give aspect_ratio (1 for disks) or semi_axes"
                    : "is missing; give aspect_ratio (1 for spheres), aspect_ratios or semi_axes");
  validate_distribution(*p.aspect_ratio, 1, path + ".aspect_ratio");
}

std::vector<Distribution> ratios(const Species& species, int dimension) {
  if (species.aspect_ratios) return {species.aspect_ratios->begin(), species.aspect_ratios->end()};
  return std::vector(static_cast<std::size_t>(dimension) - 1,
                     species.aspect_ratio.value_or(constant(1)));
}

/// The product a b (a b c in space) that all particles of the species share; no value if it differs between
/// particles.
std::optional<double> semi_axis_product(const Species& species, int dimension) {
  if (species.semi_axes) return constant_product(*species.semi_axes);
  const auto all = static_cast<std::size_t>(dimension);
  if (!species.first_semi_axis)
    return constant_product(std::vector(all, species.size.value_or(constant(1))));
  const auto of_ratios = constant_product(ratios(species, dimension));
  const auto of_first = constant_product(std::vector(all, *species.first_semi_axis));
  return of_ratios && of_first ? std::optional(*of_first / *of_ratios) : std::nullopt;
}

bool agree_in_semi_axis_product(const std::vector<Species>& species, int dimension) {
  const auto first = semi_axis_product(species.front(), dimension);
  return first && std::ranges::all_of(species, [&](const Species& kind) {
           const auto other = semi_axis_product(kind, dimension);
           return other && allows(constant(*first), *other);
         });
}

struct Taken {
  const char* name;
  const char* by;
};

constexpr Taken taken_names[] = {
    {"all", "displacements_all and others, of all particles"},
    {"distribution", "orientation_distribution"},
    {"wave_numbers", "on_the_fly_wave_numbers"},
};

std::string complaint(const std::string& name, const std::vector<std::string>& earlier) {
  const std::string own = identifier(name);
  for (const Taken& taken : taken_names)
    if (own == taken.name)
      return fmt::format("is \"{}\", which results have in their table {}; choose another", name,
                         taken.by);
  if (std::ranges::find(earlier, name) != earlier.end())
    return fmt::format("is \"{}\" like that of an earlier species; every species needs its own",
                       name);
  for (const std::string& other : earlier)
    if (identifier(other) == own)
      return fmt::format(
          "is \"{}\", which tables of results call {} like the earlier \"{}\"; choose names that "
          "differ in letters from a to z or digits",
          name, own, other);
  return "";
}

}  // namespace

void describe_system(SystemParameters& p, FieldVisitor& visit) {
  visit.field({"dimension",
               "",
               "Space dimensions: 2 for ellipses, 3 for ellipsoids.",
               {2, 3, false, false, "be 2 or 3"}},
              p.dimension);
  visit.field({"particles", "", "Number of particles.", {1, 100'000'000}, "", "N"}, p.particles);
  visit.field(
      {"packing_fraction", "",
       "Fraction of the box covered by particles: the sum of π a b divided by the area (of "
       "4π/3 a b c divided by the volume). It applies to the end of the preparation unless a "
       "reduced pressure ends it.",
       bounds::packing_fraction, "", "φ"},
      p.packing_fraction);
  visit.field({"seed", "", "Seed of all random numbers."}, p.seed);
  static constexpr const char* draws[] = {"quantiles", "random"};
  visit.field({"draw", "",
               "Distributed sizes and shapes: by quantiles, the species and their numbers of "
               "particles determine the list of all shapes, and the seed only who has which, so "
               "that runs with different seeds are of one liquid; at random, each seed draws its "
               "own, and what is measured scatters with them."},
              p.draw, draws);
  visit.number_or_numbers(
      {"box_aspect",
       "",
       "Ratio of height to width of the periodic box, L_y/L_x. In three dimensions [L_y/L_x, "
       "L_z/L_x], or one number for both. A lattice changes it so that whole cells fit.",
       {0.001, 1000}},
      p.box_aspect);
}

void describe_species(Species& p, FieldVisitor& visit) {
  visit.field({"name", "", "Name in files and tables."}, p.name);
  visit.field({"fraction", "",
               "Fraction of all particles; the fractions add up to 1. Counts are rounded by the "
               "largest-remainder method.",
               bounds::share_above_none},
              p.fraction);
  describe_optional_distribution(
      {"aspect_ratio",
       "",
       "κ = a/b ≥ 1, the ratio of major to minor semi-axis: a number or a distribution. In three "
       "dimensions it defines a prolate spheroid a : a/κ : a/κ.",
       {},
       "",
       "κ"},
      p.aspect_ratio, 2, 1, visit);
  const Field ratios{
      "aspect_ratios",
      "",
      "In three dimensions, instead of aspect_ratio: [R_1, R_2] for the semi-axes a : a/R_1 : "
      "a/R_2, each a positive number or a distribution like that of aspect_ratio.",
      {},
      "",
      "R"};
  visit.optional(ratios, p.aspect_ratios, std::array{example_of(2), example_of(5)},
                 [&](FieldVisitor& in, std::array<Distribution, 2>& inner) {
                   describe_distributions(ratios, inner, in);
                 });
  describe_optional_distribution(
      {"size", "length",
       "√(a b), or (a b c)^(1/3) in three dimensions: a number or a distribution; the default is "
       "1. The reference species of size 1 defines the unit of length."},
      p.size, 1, 0.1, visit);
  describe_optional_distribution(
      {"first_semi_axis", "length",
       "Semi-axis a, instead of the size: a number or a distribution. The others are a/κ, or a/R_1 "
       "and a/R_2. With drawn aspect ratios all particles can thus have the same a."},
      p.first_semi_axis, 1, min_draw, visit);
  const Field axes{
      "semi_axes", "length",
      "Instead of aspect ratios and size: semi-axes [a, b] with a ≥ b, or [a, b, c] in any order "
      "in three dimensions, each a number or a distribution like that of aspect_ratio. In the "
      "plane the larger of two draws is a."};
  visit.optional(axes, p.semi_axes, std::vector{example_of(2), example_of(0.5)},
                 [&](FieldVisitor& in, std::vector<Distribution>& inner) {
                   describe_distributions(axes, inner, in);
                 });
  visit.optional({"mass", "mass",
                  "Mass of every particle of this species. The default is a b (a b c), which gives "
                  "all species the same density.",
                  bounds::mass},
                 p.mass, 1.0);
  visit.optional({"initial_temperature", "kT",
                  "Temperature of the velocities that are drawn at the start of a run; the default "
                  "is 1. A species at 0 only drifts, so that the net momentum is 0.",
                  bounds::not_negative},
                 p.initial_temperature, 1.0);
}

void validate_system(const SystemParameters& p) {
  const Rules rules("system");
  const std::vector<double>& ratios = p.box_aspect;
  const auto several = static_cast<std::size_t>(p.dimension) - 1;
  rules.require(
      ratios.size() == 1 || ratios.size() == several, "box_aspect",
      fmt::format("has {} entries, but must be {}", ratios.size(),
                  p.dimension == 2 ? "one number, L_y/L_x" : "one number or [L_y/L_x, L_z/L_x]"));
}

void validate_species(const std::vector<Species>& species, int dimension) {
  if (species.empty())
    throw BadValue("species", "is empty, but there must be at least one [[species]]");
  double sum = 0;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < species.size(); ++i) {
    const std::string path = fmt::format("species.{}", i);
    const Rules rules(path);
    const Species& p = species[i];
    rules.require(!p.name.empty(), "name", "is empty, but a species needs a name");
    names.push_back(p.name);
    validate_shape(p, dimension, path);
    sum += p.fraction;
  }
  if (const auto conflict = species_name_conflict(names))
    throw BadValue(fmt::format("species.{}.name", conflict->species), conflict->complaint);
  if (std::abs(sum - 1) > 1e-9)
    throw BadValue(
        "species",
        fmt::format("has fractions that add up to {}, but they must add up to 1", show(sum)));
}

bool is_round(const Species& p) {
  const auto is_one = [](const Distribution& d) { return same(d, constant(1)); };
  if (p.semi_axes)
    return std::ranges::all_of(*p.semi_axes, [&](const Distribution& d) {
      return same(d, constant(p.semi_axes->front().mean));
    });
  if (p.aspect_ratios) return std::ranges::all_of(*p.aspect_ratios, is_one);
  return is_one(*p.aspect_ratio);
}

Species default_species() {
  Species species;
  species.aspect_ratio = Distribution{Distribution::Kind::constant, 2, 0.1, 1, 2, 1};
  return species;
}

PackingBound packing_bound(const std::vector<Species>& species, int dimension) {
  if (agree_in_semi_axis_product(species, dimension)) {
    if (dimension == 2)
      return {std::numbers::pi / std::sqrt(12.0),
              "π/√12 = 0.9069 where all particles have the same area"};
    if (std::ranges::all_of(species, is_round))
      return {std::numbers::pi / std::sqrt(18.0),
              "π/√18 = 0.7405 where all particles are equal spheres"};
  }
  return {1, "1"};
}

std::optional<SpeciesNameConflict> species_name_conflict(const std::vector<std::string>& names) {
  std::vector<std::string> earlier;
  for (const std::string& name : names) {
    if (const std::string found = complaint(name, earlier); !found.empty())
      return SpeciesNameConflict{earlier.size(), found};
    earlier.push_back(name);
  }
  return std::nullopt;
}

}  // namespace vitrel
