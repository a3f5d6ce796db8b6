#include "workflow/configuration/sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "workflow/configuration/species_names.h"

namespace vitrel {
namespace {

/// Sizes are relative to 1, ratios to one another: a thousandth is as small as they may sensibly be.
constexpr double min_size = 0.001, min_ratio = 0.001;

constexpr const char* distribution_names[] = {"gaussian", "lognormal", "uniform"};

void describe_distribution(const Field& field, Distribution& d, FieldVisitor& visit) {
  bool is_table = d.kind != Distribution::Kind::constant;
  std::size_t kind = is_table ? static_cast<std::size_t>(d.kind) - 1 : 0;
  visit.number_or_table(field, d.mean, is_table, [&](FieldVisitor& in) {
    in.choice({"distribution", "",
               "Distribution from which the numbers are drawn, as a table instead of a number."},
              kind, distribution_names);
    in.when(kind != 2, "distribution = \"gaussian\" or \"lognormal\"", [&](FieldVisitor& bell) {
      bell.field({"mean", "", "Mean."}, d.mean);
      bell.field(
          {"standard_deviation", "", "Standard deviation of the values (not of their logarithms)."},
          d.standard_deviation);
    });
    in.when(kind == 2, "distribution = \"uniform\"", [&](FieldVisitor& flat) {
      flat.field({"low", "", "Lower bound."}, d.low);
      flat.field({"high", "", "Upper bound."}, d.high);
    });
    in.field({"minimum", "", "Smaller values are drawn again."}, d.minimum);
  });
  d.kind = static_cast<Distribution::Kind>(is_table ? kind + 1 : 0);
}

/// A number, or a distribution above a thousandth, as small as a ratio may sensibly be.
Distribution positive_draws(double example) {
  return {Distribution::Kind::constant, example, 0.1, min_ratio, example, min_ratio};
}

void describe_optional_distribution(const Field& field, std::optional<Distribution>& value,
                                    double example, double minimum, FieldVisitor& visit) {
  const Distribution default_value{
      Distribution::Kind::constant, example, 0.1, minimum, example, minimum};
  visit.optional(field, value, default_value, [&](FieldVisitor& in, Distribution& inner) {
    describe_distribution(field, inner, in);
  });
}

void validate_distribution(const Distribution& d, double least, const std::string& path) {
  using Kind = Distribution::Kind;
  const std::string bound = fmt::format("must be at least {}", show(least));
  if (d.kind == Kind::constant) {
    if (!(d.mean >= least) || !std::isfinite(d.mean))
      throw BadValue(path, fmt::format("is {}, but {}", show(d.mean), bound));
    return;
  }
  const Rules rules(path);
  rules.require(d.minimum >= least && std::isfinite(d.minimum), "minimum",
                fmt::format("is {}, but {}", show(d.minimum), bound));
  if (d.kind == Kind::uniform) {
    rules.require(d.high > d.low && std::isfinite(d.high) && std::isfinite(d.low), "high",
                  fmt::format("is {}, but must be above low = {}", show(d.high), show(d.low)));
    rules.require(
        d.high > d.minimum, "high",
        fmt::format("is {}, but must be above minimum = {}", show(d.high), show(d.minimum)));
    return;
  }
  rules.positive(d.standard_deviation, "standard_deviation");
  rules.require(
      d.mean >= d.minimum && std::isfinite(d.mean), "mean",
      fmt::format("is {}, but must be at least minimum = {}", show(d.mean), show(d.minimum)));
}

void validate_semi_axes(const Species& p, int dimension, const Rules& rules) {
  rules.require(!p.aspect_ratio && !p.aspect_ratios && !p.size, "semi_axes",
                "excludes aspect_ratio and size, as well as aspect_ratios; give one or the other");
  const std::vector<double>& axes = *p.semi_axes;
  const bool fits = axes.size() == static_cast<std::size_t>(dimension) &&
                    std::ranges::all_of(axes, [](double axis) { return axis > 0; }) &&
                    std::ranges::all_of(axes, [](double axis) { return std::isfinite(axis); }) &&
                    (dimension == 3 || axes[0] >= axes[1]);
  rules.require(fits, "semi_axes",
                fmt::format("is {}, but must be {}", to_toml(std::span<const double>(axes)),
                            dimension == 2 ? "[a, b] with a ≥ b > 0" : "[a, b, c], all above 0"));
}

void validate_shape(const Species& p, int dimension, const std::string& path) {
  const Rules rules(path);
  if (p.semi_axes) {
    validate_semi_axes(p, dimension, rules);
    return;
  }
  if (p.size) validate_distribution(*p.size, min_size, path + ".size");
  if (p.aspect_ratios) {
    rules.require(dimension == 3, "aspect_ratios",
                  "has a meaning only with dimension = 3; give aspect_ratio");
    rules.require(!p.aspect_ratio, "aspect_ratios", "excludes aspect_ratio; give one or the other");
    for (int k = 0; k < 2; ++k)
      validate_distribution((*p.aspect_ratios)[k], min_ratio,
                            fmt::format("{}.aspect_ratios.{}", path, k));
    return;
  }
  rules.require(p.aspect_ratio.has_value(), "aspect_ratio",
                dimension == 2
                    ? "is missing; give aspect_ratio (1 for disks) or semi_axes"
                    : "is missing; give aspect_ratio (1 for spheres), aspect_ratios or semi_axes");
  validate_distribution(*p.aspect_ratio, 1, path + ".aspect_ratio");
}

void validate_box_aspect(const SystemParameters& p, const Rules& rules) {
  const std::vector<double>& ratios = p.box_aspect;
  const auto several = static_cast<std::size_t>(p.dimension) - 1;
  rules.require(
      ratios.size() == 1 || ratios.size() == several, "box_aspect",
      fmt::format("has {} entries, but must be {}", ratios.size(),
                  p.dimension == 2 ? "one number, L_y/L_x" : "one number or [L_y/L_x, L_z/L_x]"));
  for (const double ratio : ratios)
    rules.require(ratio >= 0.001 && ratio <= 1000, "box_aspect",
                  fmt::format("is {}, but must lie between 0.001 and 1000", show(ratio)));
}

}  // namespace

void describe_system(SystemParameters& p, FieldVisitor& visit) {
  visit.field({"dimension", "", "Space dimensions: 2 for ellipses, 3 for ellipsoids."},
              p.dimension);
  visit.field({"particles", "", "Number of particles."}, p.particles);
  visit.field({"packing_fraction", "",
               "Fraction of the box covered by particles: the sum of π a b divided by the area (of "
               "4π/3 a b c divided by the volume). It applies to a lattice, and to the end of the "
               "preparation unless a reduced pressure ends it."},
              p.packing_fraction);
  visit.field({"seed", "", "Seed of all random numbers."}, p.seed);
  visit.number_or_numbers(
      {"box_aspect", "",
       "Ratio of height to width of the periodic box, L_y/L_x. In three dimensions [L_y/L_x, "
       "L_z/L_x], or one number for both. A lattice changes it so that whole cells fit."},
      p.box_aspect);
}

void describe_species(Species& p, FieldVisitor& visit) {
  visit.field({"name", "", "Name in files and tables."}, p.name);
  visit.field({"fraction", "",
               "Fraction of all particles; the fractions add up to 1. Counts are rounded by the "
               "largest-remainder method."},
              p.fraction);
  describe_optional_distribution(
      {"aspect_ratio", "",
       "κ = a/b ≥ 1, the ratio of major to minor semi-axis: a number or a distribution. In three "
       "dimensions it defines a prolate spheroid a : a/κ : a/κ."},
      p.aspect_ratio, 2, 1, visit);
  const Field ratios{
      "aspect_ratios", "",
      "In three dimensions, instead of aspect_ratio: [R_1, R_2] for the semi-axes a : a/R_1 : "
      "a/R_2, each a positive number or a distribution like that of aspect_ratio."};
  visit.optional(ratios, p.aspect_ratios, std::array{positive_draws(2), positive_draws(5)},
                 [&](FieldVisitor& in, std::array<Distribution, 2>& inner) {
                   in.array(ratios, inner.size(), [&](std::size_t k, FieldVisitor& entry) {
                     describe_distribution({std::to_string(k), "", ""}, inner[k], entry);
                   });
                 });
  describe_optional_distribution(
      {"size", "length",
       "√(a b), or (a b c)^(1/3) in three dimensions: a number or a distribution; the default is "
       "1. The reference species of size 1 defines the unit of length."},
      p.size, 1, 0.1, visit);
  visit.optional({"semi_axes", "length",
                  "Instead of aspect ratios and size: semi-axes [a, b] with a ≥ b, or [a, b, c] in "
                  "any order in three dimensions."},
                 p.semi_axes, std::vector<double>{2, 0.5});
  visit.optional({"mass", "mass",
                  "Mass of every particle of this species. The default is a b (a b c), which gives "
                  "all species the same density."},
                 p.mass, 1.0);
}

void validate_system(const SystemParameters& p) {
  const Rules rules("system");
  rules.require(p.dimension == 2 || p.dimension == 3, "dimension",
                fmt::format("is {}, but must be 2 or 3", p.dimension));
  rules.require(p.particles >= 1 && p.particles <= 100'000'000, "particles",
                fmt::format("is {}, but must lie between 1 and 100000000", p.particles));
  rules.packing_fraction(p.packing_fraction, "packing_fraction", p.dimension);
  validate_box_aspect(p, rules);
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
    rules.require(p.fraction > 0 && p.fraction <= 1, "fraction",
                  fmt::format("is {}, but must lie above 0 and not above 1", show(p.fraction)));
    validate_shape(p, dimension, path);
    if (p.mass) rules.positive(*p.mass, "mass");
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
  const auto is_one = [](const Distribution& d) {
    return d.kind == Distribution::Kind::constant && d.mean == 1;
  };
  if (p.semi_axes)
    return std::ranges::adjacent_find(*p.semi_axes, std::not_equal_to()) == p.semi_axes->end();
  if (p.aspect_ratios) return std::ranges::all_of(*p.aspect_ratios, is_one);
  return is_one(*p.aspect_ratio);
}

Species default_species() {
  Species species;
  species.aspect_ratio = Distribution{Distribution::Kind::constant, 2, 0.1, 1, 2, 1};
  return species;
}

}  // namespace vitrel
