#include "workflow/configuration/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "edmd/sampling.h"
#include "workflow/configuration/soft_particles.h"
#include "workflow/configuration/species_names.h"

namespace vitrel {
namespace {

/// Packing fractions that differ by less are the same; those of states carry rounding errors.
constexpr double packing_fraction_slack = 1e-9;
/// Random insertion is quick up to here: in three dimensions, where it serves as a start, for all lengths.
constexpr double easy_insertion = 0.3, easy_insertion_of_solids = 0.01;
/// Sizes are relative to 1, ratios to one another: a thousandth is as small as they may sensibly be.
constexpr double least_size = 0.001, least_ratio = 0.001;

using Style = FieldVisitor::TableStyle;

constexpr const char* distribution_names[] = {"gaussian", "lognormal", "uniform"};
constexpr const char* method_names[] = {"lattice", "insert", "swell", "compress",
                                        "grow",    "hybrid", "sample"};
constexpr const char* moves_names[] = {"chains", "local"};
constexpr const char* box_names[] = {"isotropic", "anisotropic"};
constexpr const char* arrangement_names[] = {"square", "triangular"};
constexpr const char* orientation_names[] = {"random", "aligned"};
constexpr const char* kind_names[] = {"newtonian", "brownian"};
constexpr const char* on_overlap_names[] = {"stop", "correct"};
constexpr const char* temperature_names[] = {"total", "relative"};
constexpr const char* velocity_names[] = {"maxwell", "translation", "rotation", "keep"};
constexpr const char* law_names[] = {"linear_dashpot", "viscoelastic"};
constexpr const char* coefficients_names[] = {"tabulated", "integrated"};
constexpr const char* early_release_names[] = {"alone", "together"};
constexpr const char* spacing_names[] = {"linear", "logarithmic"};

FieldVisitor::Inside section_of(auto& part, auto describe) {
  return [&part, describe](FieldVisitor& visit) { describe(part, visit); };
}

void describe_system(SystemParameters& p, FieldVisitor& visit) {
  visit.field({"dimension", "",
               "Space dimensions: 2, ellipses, or 3, ellipsoids. In three dimensions there are "
               "`vitrel prepare` with stages that insert and grow, and `vitrel run`."},
              p.dimension);
  visit.field({"particles", "", "Number of particles."}, p.particles);
  visit.field(
      {"packing_fraction", "",
       "Share of the box covered by particles, the sum of π a b over the area (4π/3 a b c over "
       "the volume): that of a "
       "lattice, and at the end of the preparation unless a reduced pressure ends it."},
      p.packing_fraction);
  visit.field({"seed", "", "All random numbers follow from it."}, p.seed);
  visit.when(p.dimension == 2, "dimension = 2", [&](FieldVisitor& in) {
    in.field({"box_aspect", "",
              "Height over width of the periodic box, L_y/L_x; in three dimensions it is a cube."},
             p.box_aspect);
  });
}

void describe_distribution(const Field& field, Distribution& d, FieldVisitor& visit) {
  bool is_table = d.kind != Distribution::Kind::constant;
  std::size_t kind = is_table ? static_cast<std::size_t>(d.kind) - 1 : 0;
  visit.number_or_table(field, d.mean, is_table, [&](FieldVisitor& in) {
    in.choice({"distribution", "",
               "Instead of a number, a table with the distribution the numbers are drawn from."},
              kind, distribution_names);
    in.when(kind != 2, "distribution = \"gaussian\" or \"lognormal\"", [&](FieldVisitor& bell) {
      bell.field({"mean", "", "Mean."}, d.mean);
      bell.field({"standard_deviation", "", "Standard deviation of the numbers themselves."},
                 d.standard_deviation);
    });
    in.when(kind == 2, "distribution = \"uniform\"", [&](FieldVisitor& flat) {
      flat.field({"low", "", "Lower bound."}, d.low);
      flat.field({"high", "", "Upper bound."}, d.high);
    });
    in.field({"minimum", "", "Smaller draws are drawn again."}, d.minimum);
  });
  d.kind = static_cast<Distribution::Kind>(is_table ? kind + 1 : 0);
}

/// A number, or a distribution above a thousandth, as small as a ratio may sensibly be.
Distribution positive_draws(double example) {
  return {Distribution::Kind::constant, example, 0.1, least_ratio, example, least_ratio};
}

void describe_optional_distribution(const Field& field, std::optional<Distribution>& value,
                                    double example, double minimum, FieldVisitor& visit) {
  const Distribution default_value{
      Distribution::Kind::constant, example, 0.1, minimum, example, minimum};
  visit.optional(field, value, default_value, [&](FieldVisitor& in, Distribution& inner) {
    describe_distribution(field, inner, in);
  });
}

void describe_species(Species& p, FieldVisitor& visit) {
  visit.field({"name", "", "Name in files and tables."}, p.name);
  visit.field({"fraction", "",
               "Share of all particles; the shares add up to 1. Counts are rounded by the largest "
               "remainder."},
              p.fraction);
  describe_optional_distribution(
      {"aspect_ratio", "",
       "κ = a/b ≥ 1, major over minor semi-axis: a number or a distribution. In three dimensions a "
       "prolate spheroid a : a/κ : a/κ."},
      p.aspect_ratio, 2, 1, visit);
  const Field ratios{"aspect_ratios", "",
                     "In three dimensions [R_1, R_2] of the semi-axes a : a/R_1 : a/R_2, each a "
                     "number above 0 or a distribution like that of aspect_ratio, whose place they "
                     "take."};
  visit.optional(ratios, p.aspect_ratios, std::array{positive_draws(2), positive_draws(5)},
                 [&](FieldVisitor& in, std::array<Distribution, 2>& inner) {
                   in.array(ratios, inner.size(), [&](std::size_t k, FieldVisitor& entry) {
                     describe_distribution({std::to_string(k), "", ""}, inner[k], entry);
                   });
                 });
  describe_optional_distribution({"size", "length",
                                  "√(a b), in three dimensions (a b c)^(1/3), 1 for the reference "
                                  "species that sets the unit of "
                                  "length: a number or a distribution; 1 if left out."},
                                 p.size, 1, 0.1, visit);
  visit.optional({"semi_axes", "length",
                  "Semi-axes [a, b] with a ≥ b, or in three dimensions [a, b, c] in any order, "
                  "instead of aspect ratios and size."},
                 p.semi_axes, std::vector<double>{2, 0.5});
  visit.optional({"mass", "mass",
                  "Mass of every particle of this species; a b (a b c) if left out, the same "
                  "density for all."},
                 p.mass, 1.0);
}

void describe_stage(PrepareStage& p, FieldVisitor& visit) {
  using Method = PrepareStage::Method;
  visit.field(
      {"method", "",
       "What the stage does. lattice: regular positions; insert: random places without "
       "overlap, as a start at low density; swell: Monte Carlo while the particles grow to "
       "the wanted packing fraction; compress: Monte Carlo at constant pressure, in a box that "
       "changes; grow: event-driven dynamics while they grow to a "
       "packing fraction or until they jam; hybrid: short stretches of such growth and of Monte "
       "Carlo "
       "in turn; sample: Monte Carlo at constant packing fraction."},
      p.method, method_names);
  visit.when(p.method == Method::lattice, "method = \"lattice\"", [&](FieldVisitor& in) {
    in.field({"arrangement", "", "The triangular lattice is stretched along x like the particles."},
             p.lattice.arrangement, arrangement_names);
    in.field(
        {"angle", "radians", "From the x axis to the major axes; 0 on the triangular lattice."},
        p.lattice.angle);
  });
  const bool has_density = p.method != Method::lattice && p.method != Method::sample;
  visit.when(has_density, "method = \"insert\", \"swell\", \"compress\", \"grow\" or \"hybrid\"",
             [&](FieldVisitor& in) {
               in.optional({"packing_fraction", "",
                            "At the end of the stage. If left out: that of the system, but to "
                            "insert at most 0.3 (0.01 in three dimensions), and none to compress, "
                            "or where there is a reduced "
                            "pressure."},
                           p.packing_fraction, 0.3);
             });
  visit.when(p.method == Method::insert, "method = \"insert\"", [&](FieldVisitor& in) {
    in.field({"attempts", "", "Random places tried for one particle before the stage gives up."},
             p.attempts);
    in.field({"orientations", "", "Each particle at random, or all along x."}, p.orientations,
             orientation_names);
  });
  const bool gives_up = p.method == Method::swell || p.method == Method::compress;
  visit.when(gives_up, "method = \"swell\" or \"compress\"", [&](FieldVisitor& in) {
    in.field({"most_sweeps", "", "Sweeps after which a packing fraction is given up."},
             p.most_sweeps);
  });
  visit.when(p.method == Method::compress, "method = \"compress\"", [&](FieldVisitor& in) {
    in.field({"pressure", "kT/area", "βP, in units of one over the unit of area."}, p.pressure);
    in.field({"box", "",
              "Both sides of the box change by one factor, or one at a time, within a factor 2 of "
              "their ratio at the start."},
             p.box, box_names);
  });
  const bool grows = p.method == Method::grow || p.method == Method::hybrid;
  visit.when(grows, "method = \"grow\" or \"hybrid\"", [&](FieldVisitor& in) {
    in.optional({"reduced_pressure", "",
                 "βP/ρ at the end of the stage, however dense that is: 1e6 or more for a jammed "
                 "state. With a packing fraction, too, whichever comes first."},
                p.reduced_pressure, 1e6);
    in.field({"growth_rate", "1/time",
              "Growth of all lengths, relative to the present ones. Slow growth lets the liquid "
              "order, and so jams at higher packing fractions."},
             p.growth_rate);
  });
  visit.when(p.method == Method::hybrid, "method = \"hybrid\"", [&](FieldVisitor& in) {
    in.field(
        {"stretch_sweeps", "",
         "Sweeps of Monte Carlo after every stretch of growth, which lasts until all lengths have "
         "grown by 1 %, or less at high pressure."},
        p.stretch_sweeps);
  });
  const bool samples = p.method == Method::sample || p.method == Method::hybrid;
  visit.when(samples, "method = \"sample\" or \"hybrid\"", [&](FieldVisitor& in) {
    in.field(
        {"moves", "",
         "How Monte Carlo moves particles: in event chains, which forget density and places many "
         "times sooner, or one at a time (local), on any number of threads."},
        p.moves, moves_names);
  });
  visit.when(samples && p.moves == Moves::local, "moves = \"local\"", [&](FieldVisitor& in) {
    in.field(
        {"exchanges", "",
         "Share of the moves in which two particles of different shape exchange their places. "
         "Where "
         "sizes are spread, 0.2 relaxes dense liquids many times sooner; two sizes far apart gain "
         "nothing."},
        p.exchanges);
  });
  const bool has_length = p.method == Method::sample || p.method == Method::compress;
  visit.when(has_length, "method = \"sample\" or \"compress\"", [&](FieldVisitor& in) {
    in.field({"sweeps", "",
              "Sweeps; one is as many trial moves as there are particles. To compress: without a "
              "packing fraction."},
             p.sweeps);
  });
}

void describe_contact(ContactParameters& p, FieldVisitor& visit) {
  using Law = ContactParameters::Law;
  visit.quantity({"radius", "m", "Radius of a particle of size 1."}, p.radius);
  visit.quantity(
      {"density", "kg/m^3",
       "Density. A particle of mass 1 weighs as much as a sphere of this radius and density."},
      p.density);
  visit.quantity(
      {"thermal_speed", "m/s", "Thermal speed √(kT/m) of a particle of mass 1 at kT = 1."},
      p.thermal_speed);
  visit.field(
      {"law", "",
       "Force in contact: spring and dashpot, k ξ + γ dξ/dt, or that of viscoelastic spheres, "
       "ρ (ξ + (3/2) A dξ/dt) √ξ with ρ = 2 Y √R_eff/(3 (1 − ν²)), where ξ is the compression."},
      p.law, law_names);
  visit.when(p.law == Law::linear_dashpot, "law = \"linear_dashpot\"", [&](FieldVisitor& in) {
    in.quantity({"stiffness", "N/m", "Spring constant k."}, p.linear_dashpot.stiffness);
    in.quantity({"damping", "kg/s", "Damping γ of the dashpot; \"0 kg/s\" for elastic particles."},
                p.linear_dashpot.damping);
  });
  visit.when(p.law == Law::viscoelastic, "law = \"viscoelastic\"", [&](FieldVisitor& in) {
    in.quantity({"youngs_modulus", "Pa", "Young's modulus Y."}, p.viscoelastic.youngs_modulus);
    in.field({"poissons_ratio", "", "Poisson's ratio ν."}, p.viscoelastic.poissons_ratio);
    in.quantity({"dissipative_time", "s",
                 "Dissipative time A of the material; \"0 s\" for elastic particles."},
                p.viscoelastic.dissipative_time);
  });
  visit.field(
      {"coefficients", "",
       "What a contact does to a pair, from a table that is made once and kept in the user's "
       "cache folder, or integrated anew for every contact, which takes longer."},
      p.coefficients, coefficients_names);
  visit.field(
      {"early_release", "",
       "A particle that is hit while in contact is released from it alone, as published, or "
       "together with its partner, which keeps the angular momentum."},
      p.early_release, early_release_names);
}

void describe_dynamics(DynamicsParameters& p, FieldVisitor& visit) {
  visit.field({"kind", "",
               "Free flight and collisions (newtonian), or the same with all velocities redrawn "
               "every brownian_step (brownian)."},
              p.kind, kind_names);
  visit.field({"brownian_step", "time",
               "Time τ_B between redrawings; a free particle then diffuses with D = kT τ_B/(2 m). "
               "Brownian dynamics only."},
              p.brownian_step);
  visit.field(
      {"equilibration", "time", "Length of the run before sampling starts; time 0 is its end."},
      p.equilibration);
  visit.field({"duration", "time", "Length of the sampled part of the run."}, p.duration);
  visit.field({"restitution", "", "Coefficient of restitution, 1 for elastic collisions."},
              p.restitution);
  visit.field({"on_overlap", "",
               "What to do if two particles are found overlapping: stop with exit code 4, or the "
               "thesis's correction move, counted."},
              p.on_overlap, on_overlap_names);
  visit.field({"temperature", "",
               "Which energy means kT = 1 when velocities are drawn: a translational energy of N "
               "kT (total) or of (N − 1) kT (relative, the degrees of freedom left once the net "
               "momentum is removed)."},
              p.temperature, temperature_names);
  visit.field({"initial_velocities", "",
               "Equilibrium at kT = 1 (maxwell), the same energy all in translation or all in "
               "rotation, or those of the state started from (keep)."},
              p.initial_velocities, velocity_names);
  const Field contact{
      "contact", "",
      "Soft particles, which must be round: what happens in their contacts. Without this "
      "section particles are hard."};
  visit.optional(contact, p.contact, ContactParameters(),
                 [&](FieldVisitor& in, ContactParameters& inner) {
                   in.table(contact, Style::section, section_of(inner, describe_contact));
                 });
}

void describe_samples(OutputParameters& p, FieldVisitor& visit) {
  using Spacing = OutputParameters::Spacing;
  visit.field({"spacing", "", "How the sample times follow each other."}, p.spacing, spacing_names);
  visit.when(p.spacing == Spacing::linear, "spacing = \"linear\"", [&](FieldVisitor& in) {
    in.field({"interval", "time", "Time between samples."}, p.interval);
  });
  visit.when(p.spacing == Spacing::logarithmic, "spacing = \"logarithmic\"", [&](FieldVisitor& in) {
    in.field({"first", "time", "First sample after the one at time 0."}, p.first);
    in.field({"per_decade", "", "Samples per factor of ten in time."}, p.per_decade);
  });
}

void describe_correlations(CorrelationParameters& p, FieldVisitor& visit) {
  visit.field({"interval", "time",
               "Time between the states that are correlated, the shortest time difference."},
              p.interval);
  visit.field({"wave_numbers", "1/length",
               "Wave numbers q of the self scattering functions F_s(q, t); none: about that of the "
               "main peak of the structure factor, 2π √(2ρ/√3) with ρ the number density."},
              p.wave_numbers);
}

void describe_output(OutputParameters& p, FieldVisitor& visit) {
  visit.table({"samples", "", "When the state is written to the trajectory."}, Style::inline_table,
              [&](FieldVisitor& in) { describe_samples(p, in); });
  visit.field({"velocities", "",
               "Whether the velocities of all particles are written, too. Energies and the "
               "pressure are measured without."},
              p.velocities);
  const Field correlations{"correlations", "",
                           "Correlations measured while the run goes on, from states that need not "
                           "be written: displacement, rotation, self scattering and orientation "
                           "over times from the interval to half the run, in a file of the "
                           "run's name with .correlations.h5 behind it. None if left out."};
  visit.optional(correlations, p.correlations, CorrelationParameters(),
                 [&](FieldVisitor& in, CorrelationParameters& inner) {
                   in.table(correlations, Style::inline_table,
                            section_of(inner, describe_correlations));
                 });
  visit.field(
      {"checkpoint_interval", "seconds of wall time",
       "Time between checkpoints, from which a preparation or a run that was killed continues."},
      p.checkpoint_interval);
}

void describe_analysis(DisplacementOptions& p, FieldVisitor& visit) {
  visit.field(
      {"longest_lag", "",
       "Longest time difference, as a fraction of an evenly sampled run; those of others go "
       "to the end."},
      p.axis.longest_lag);
  visit.field(
      {"every_lag_up_to", "sample intervals",
       "Up to here every time difference is evaluated, beyond they are spaced logarithmically; of "
       "runs that are not evenly sampled all are."},
      p.axis.every_lag_up_to);
  visit.field(
      {"lags_per_decade", "", "Time differences per factor of ten in the logarithmic part."},
      p.axis.lags_per_decade);
  visit.field({"most_origins", "", "Time origins per time difference; evenly thinned beyond."},
              p.axis.most_origins);
  visit.field({"wave_numbers", "1/length",
               "Wave numbers q of the intermediate scattering functions; if empty one, about that "
               "of the main peak of the structure factor: 2π√(2ρ/√3) of the number density ρ."},
              p.wave_numbers);
  visit.field({"orders", "", "Orders n of the orientational correlations ⟨cos n(θ(t) − θ(0))⟩."},
              p.orders);
  visit.field({"overlap_distance", "length",
               "A particle counts as being where it was, in overlap and four-point susceptibility, "
               "if it has moved by less: somewhat more than it rattles in its cage."},
              p.overlap_distance);
  visit.field({"memory", "bytes", "Memory for particle tracks."}, p.memory);
}

void describe_structure(StructureOptions& p, FieldVisitor& visit) {
  visit.field({"frames", "", "Frames averaged over; evenly thinned beyond."}, p.most_frames);
  visit.field({"wave_number_max", "1/length", "Largest wave number q of structure factors."},
              p.shells.wave_number_max);
  visit.field({"wave_number_step", "1/length", "Width of the shells of q averaged over."},
              p.shells.wave_number_step);
  visit.field({"distance_max", "length",
               "Largest distance of pair correlations, but at most half the shorter side of the "
               "box."},
              p.pairs.distance_max);
  visit.field({"distance_step", "length", "Width of the bins of distance."}, p.pairs.distance_step);
}

std::string show(double value) {
  return to_toml(value);
}

// Collects the rules of one table; every rule says what is wrong and what would be right.
class Rules {
 public:
  explicit Rules(std::string path) : path_(std::move(path)) {}

  void require(bool holds, const std::string& key, const std::string& complaint) const {
    if (!holds) throw BadValue(path_ + "." + key, complaint);
  }
  void positive(double value, const std::string& key) const {
    require(value > 0 && std::isfinite(value), key,
            fmt::format("is {}, but must be positive", show(value)));
  }
  void not_negative(double value, const std::string& key) const {
    require(value >= 0 && std::isfinite(value), key,
            fmt::format("is {}, but must be 0 or more", show(value)));
  }
  void at_least(std::int64_t value, std::int64_t least, const std::string& key) const {
    require(value >= least, key, fmt::format("is {}, but must be at least {}", value, least));
  }
  void packing_fraction(double value, const std::string& key, int dimension) const {
    // Ellipses of one kind pack no denser than disks: π/√12. Of ellipsoids no such bound is known.
    const double densest = dimension == 2 ? std::numbers::pi / std::sqrt(12.0) : 1;
    require(value > 0 && value < densest, key,
            fmt::format("is {}, but a packing fraction lies between 0 and {}", show(value),
                        dimension == 2 ? "π/√12 = 0.9069" : "1"));
  }

 private:
  std::string path_;
};

void validate_system(const SystemParameters& p) {
  const Rules rules("system");
  rules.require(p.dimension == 2 || p.dimension == 3, "dimension",
                fmt::format("is {}, but must be 2 or 3", p.dimension));
  rules.require(p.particles >= 1 && p.particles <= 100'000'000, "particles",
                fmt::format("is {}, but must lie between 1 and 100000000", p.particles));
  rules.packing_fraction(p.packing_fraction, "packing_fraction", p.dimension);
  rules.require(p.box_aspect >= 0.001 && p.box_aspect <= 1000, "box_aspect",
                fmt::format("is {}, but must lie between 0.001 and 1000", show(p.box_aspect)));
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
  if (p.size) validate_distribution(*p.size, least_size, path + ".size");
  if (p.aspect_ratios) {
    rules.require(dimension == 3, "aspect_ratios",
                  "has a meaning only with dimension = 3; give aspect_ratio");
    rules.require(!p.aspect_ratio, "aspect_ratios", "excludes aspect_ratio; give one or the other");
    for (int k = 0; k < 2; ++k)
      validate_distribution((*p.aspect_ratios)[k], least_ratio,
                            fmt::format("{}.aspect_ratios.{}", path, k));
    return;
  }
  rules.require(p.aspect_ratio.has_value(), "aspect_ratio",
                dimension == 2
                    ? "is missing; give aspect_ratio (1 for disks) or semi_axes"
                    : "is missing; give aspect_ratio (1 for spheres), aspect_ratios or semi_axes");
  validate_distribution(*p.aspect_ratio, 1, path + ".aspect_ratio");
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

void validate_stages(const std::vector<PrepareStage>& stages, const SystemParameters& system) {
  using Method = PrepareStage::Method;
  if (stages.empty())
    throw BadValue("prepare.stage", "is empty, but there must be at least one [[prepare.stage]]");
  double reached = 0;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const Rules rules(fmt::format("prepare.stage.{}", i));
    const PrepareStage& p = stages[i];
    rules.require(
        system.dimension == 2 || p.method == Method::insert || p.method == Method::grow, "method",
        fmt::format("is \"{}\", but in three dimensions there are \"insert\" and \"grow\"",
                    method_name(p.method)));
    const bool places = p.method == Method::lattice || p.method == Method::insert;
    rules.require(
        places == (i == 0), "method",
        i == 0 ? "of the first stage must be \"lattice\" or \"insert\", which place the particles"
               : "of a later stage must be \"swell\", \"compress\", \"grow\", \"hybrid\" or "
                 "\"sample\": the particles have their places");
    const LatticeOptions& lattice = p.lattice;
    rules.require(std::isfinite(lattice.angle), "angle", "must be a finite number");
    rules.require(
        lattice.arrangement == Arrangement::square || lattice.angle == 0, "angle",
        fmt::format("is {}, but must be 0 on the triangular lattice", show(lattice.angle)));
    rules.require(p.attempts >= 1, "attempts", "is 0, but must be at least 1");
    rules.require(p.most_sweeps >= 1, "most_sweeps", "is 0, but must be at least 1");
    rules.require(p.sweeps >= 1, "sweeps", "is 0, but must be at least 1");
    rules.require(
        p.exchanges >= 0 && p.exchanges < 1, "exchanges",
        fmt::format("is {}, but a share of the moves lies between 0 and 1, 1 excluded: they "
                    "move nothing by themselves",
                    show(p.exchanges)));
    rules.require(p.stretch_sweeps >= 1, "stretch_sweeps",
                  "is 0, but must be at least 1; without sweeps the method is \"grow\"");
    rules.require(p.growth_rate > 0 && p.growth_rate <= 1, "growth_rate",
                  fmt::format("is {}, but must lie above 0 and not above 1, where the surfaces "
                              "are as fast as the particles",
                              show(p.growth_rate)));
    rules.positive(p.pressure, "pressure");
    if (p.reduced_pressure)
      rules.require(*p.reduced_pressure > 1 && *p.reduced_pressure <= max_reduced_pressure,
                    "reduced_pressure",
                    fmt::format("is {}, but must lie above 1 (an ideal gas) and not above {}",
                                show(*p.reduced_pressure), show(max_reduced_pressure)));
    if (p.packing_fraction)
      rules.packing_fraction(*p.packing_fraction, "packing_fraction", system.dimension);
    const double end = end_of_stage(p, system, reached);
    const double goal = p.packing_fraction.value_or(end);
    // A stage without a packing fraction of its own ends at that of the system.
    (p.packing_fraction ? rules : Rules("system"))
        .require(goal >= reached * (1 - packing_fraction_slack), "packing_fraction",
                 fmt::format("is {}, but the stage before ends at {}, and no stage shrinks",
                             show(goal), show(reached)));
    reached = end;
  }
  if (!ends_at_pressure(stages) &&
      std::abs(reached - system.packing_fraction) > packing_fraction_slack)
    throw BadValue(
        fmt::format("prepare.stage.{}", stages.size() - 1),
        fmt::format("ends at the packing fraction {}, but system.packing_fraction is {}; let the "
                    "last stage that is not \"sample\" end there (insert: packing_fraction = {}, "
                    "or a stage that swells, compresses or grows)",
                    show(reached), show(system.packing_fraction), show(system.packing_fraction)));
}

void validate_dynamics(const DynamicsParameters& p) {
  const Rules rules("dynamics");
  rules.positive(p.brownian_step, "brownian_step");
  rules.not_negative(p.equilibration, "equilibration");
  rules.positive(p.duration, "duration");
  rules.require(
      p.restitution > 0 && p.restitution <= 1, "restitution",
      fmt::format("is {}, but must lie above 0 and not above 1 (elastic)", show(p.restitution)));
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

/// Whether contacts at the thermal speed are such that coefficients can be had.
void validate_impact(const ContactParameters& p, const Rules& rules) {
  constexpr double most_damping = 1e5, least_distance = 0.01;
  const bool is_dashpot = p.law == ContactParameters::Law::linear_dashpot;
  const ContactScales scales = thermal_scales(p);
  rules.require(
      scales.damping <= most_damping, is_dashpot ? "damping" : "dissipative_time",
      fmt::format("is so large that nothing is left of the thermal speed (c_dis = {:.3g}, at "
                  "most {:g}, with this radius, density and stiffness); lower it",
                  scales.damping, most_damping));
  rules.require(
      2 * p.radius >= least_distance * scales.length, is_dashpot ? "stiffness" : "youngs_modulus",
      fmt::format("is so small that particles pass through each other at the thermal speed "
                  "(2 R/X = {:.3g}, at least {:g}); raise it",
                  2 * p.radius / scales.length, least_distance));
}

void validate_contact(const Parameters& parameters) {
  const ContactParameters& p = *parameters.dynamics.contact;
  const Rules rules("dynamics.contact");
  rules.positive(p.radius, "radius");
  rules.positive(p.density, "density");
  rules.positive(p.thermal_speed, "thermal_speed");
  rules.positive(p.linear_dashpot.stiffness, "stiffness");
  rules.not_negative(p.linear_dashpot.damping, "damping");
  rules.positive(p.viscoelastic.youngs_modulus, "youngs_modulus");
  const double ratio = p.viscoelastic.poissons_ratio;
  rules.require(ratio > -1 && ratio <= 0.5, "poissons_ratio",
                fmt::format("is {}, but must lie above -1 and not above 0.5", show(ratio)));
  rules.not_negative(p.viscoelastic.dissipative_time, "dissipative_time");
  validate_impact(p, rules);
  for (std::size_t k = 0; k < parameters.species.size(); ++k)
    if (!is_round(parameters.species[k]))
      throw BadValue(fmt::format("species.{}", k),
                     "is not round, but soft particles ([dynamics.contact]) must be; set "
                     "aspect_ratio = 1");
  const Rules dynamics("dynamics");
  const std::string hard_only =
      "is for hard particles, but [dynamics.contact] makes them soft; leave it out";
  dynamics.require(parameters.dynamics.restitution == 1, "restitution", hard_only);
  dynamics.require(parameters.dynamics.on_overlap == OnOverlap::stop, "on_overlap", hard_only);
}

void validate_correlations(const CorrelationParameters& p, double duration) {
  const Rules rules("output.correlations");
  rules.positive(p.interval, "interval");
  rules.require(p.interval <= duration && duration / p.interval <= 1e12, "interval",
                fmt::format("is {}, but must lie between 1e-12 of dynamics.duration = {} and all "
                            "of it",
                            show(p.interval), show(duration)));
  for (std::size_t k = 0; k < p.wave_numbers.size(); ++k)
    rules.positive(p.wave_numbers[k], fmt::format("wave_numbers.{}", k));
}

void validate_output(const Parameters& parameters) {
  const OutputParameters& p = parameters.output;
  const Rules samples("output.samples");
  const double duration = parameters.dynamics.duration;
  const auto within = [&](double value, const char* key) {
    samples.positive(value, key);
    samples.require(value <= duration, key,
                    fmt::format("is {}, but must not exceed dynamics.duration = {}", show(value),
                                show(duration)));
  };
  if (p.spacing == OutputParameters::Spacing::linear) {
    within(p.interval, "interval");
    samples.require(duration / p.interval <= 1e8, "interval",
                    fmt::format("is {}, which makes {:.3g} samples; at most 1e8 are possible",
                                show(p.interval), duration / p.interval));
  } else {
    within(p.first, "first");
    samples.at_least(p.per_decade, 1, "per_decade");
  }
  if (p.correlations) {
    if (parameters.system.dimension != 2)
      throw BadValue("output.correlations", "is for two dimensions only; leave it out");
    validate_correlations(*p.correlations, duration);
  }
  Rules("output").not_negative(p.checkpoint_interval, "checkpoint_interval");
}

void validate_analysis(const DisplacementOptions& p) {
  const Rules rules("analysis");
  rules.require(
      p.axis.longest_lag > 0 && p.axis.longest_lag <= 1, "longest_lag",
      fmt::format("is {}, but must lie above 0 and not above 1", show(p.axis.longest_lag)));
  rules.at_least(static_cast<std::int64_t>(p.axis.every_lag_up_to), 1, "every_lag_up_to");
  rules.at_least(static_cast<std::int64_t>(p.axis.lags_per_decade), 1, "lags_per_decade");
  rules.at_least(static_cast<std::int64_t>(p.axis.most_origins), 1, "most_origins");
  for (const double q : p.wave_numbers) rules.positive(q, "wave_numbers");
  for (const double n : p.orders)
    rules.require(n >= 1 && n <= 100 && n == std::floor(n), "orders",
                  fmt::format("has {}, but must hold whole numbers from 1 to 100", show(n)));
  for (std::size_t k = 1; k < p.orders.size(); ++k)
    rules.require(p.orders[k] > p.orders[k - 1], "orders", "must hold increasing numbers");
  rules.positive(p.overlap_distance, "overlap_distance");
  rules.at_least(static_cast<std::int64_t>(p.memory), 1 << 20, "memory");
}

void validate_structure(const StructureOptions& p) {
  const Rules rules("analysis.structure");
  rules.at_least(static_cast<std::int64_t>(p.most_frames), 1, "frames");
  const auto steps = [&](double longest, double step, const char* longest_key,
                         const char* step_key) {
    rules.positive(longest, longest_key);
    rules.positive(step, step_key);
    rules.require(step <= longest && longest / step <= 1e4, step_key,
                  fmt::format("is {}, but must lie between {} and {} = {}, a ten-thousandth of it "
                              "and all of it",
                              show(step), show(longest / 1e4), longest_key, show(longest)));
  };
  steps(p.shells.wave_number_max, p.shells.wave_number_step, "wave_number_max", "wave_number_step");
  steps(p.pairs.distance_max, p.pairs.distance_step, "distance_max", "distance_step");
}

void validate_sweep(const SweepParameters& p) {
  std::set<std::string> keys;
  for (const auto& [table, grid] :
       {std::pair("sweep.together.", &p.together), {"sweep.grid.", &p.grid}})
    for (const auto& [key, values] : *grid)
      if (!keys.insert(key).second)
        throw BadValue(table + key,
                       "stands twice in [sweep.grid] and [sweep.together]; leave one out");
  for (const auto& [key, values] : p.together) {
    const auto& [first, wanted] = p.together.front();
    if (values.size() != wanted.size())
      throw BadValue(
          "sweep.together." + key,
          fmt::format("has {} value(s), but '{}' has {}; the keys of [sweep.together] advance "
                      "together and need as many values each",
                      values.size(), first, wanted.size()));
  }
}

Parameters read(const TomlNode& root) {
  Parameters parameters;
  read_parameters(root, fields(parameters), [&] { validate(parameters); });
  return parameters;
}

void apply(TomlNode& root, const std::vector<std::string>& overrides) {
  for (const std::string& assignment : overrides)
    apply_override(root, assignment, "--set " + assignment);
}

Species default_species() {
  Species species;
  species.aspect_ratio = Distribution{Distribution::Kind::constant, 2, 0.1, 1, 2, 1};
  return species;
}

std::vector<PrepareStage> default_stages() {
  std::vector<PrepareStage> stages(2);
  stages[1].method = PrepareStage::Method::grow;
  return stages;
}

}  // namespace

Parameters::Parameters() : species{default_species()}, stages(default_stages()) {}

const char* method_name(PrepareStage::Method method) {
  return method_names[static_cast<std::size_t>(method)];
}

const char* law_name(ContactParameters::Law law) {
  return law_names[static_cast<std::size_t>(law)];
}

double end_of_stage(const PrepareStage& stage, const SystemParameters& system, double before) {
  switch (stage.method) {
    case PrepareStage::Method::lattice:
      return system.packing_fraction;
    case PrepareStage::Method::insert:
      return stage.packing_fraction.value_or(
          std::min(system.dimension == 2 ? easy_insertion : easy_insertion_of_solids,
                   system.packing_fraction));
    case PrepareStage::Method::swell:
      return stage.packing_fraction.value_or(system.packing_fraction);
    case PrepareStage::Method::compress:
      return stage.packing_fraction.value_or(before);
    case PrepareStage::Method::grow:
    case PrepareStage::Method::hybrid:
      if (stage.reduced_pressure) return before;
      return stage.packing_fraction.value_or(system.packing_fraction);
    case PrepareStage::Method::sample:
      return before;
  }
  return before;
}

bool ends_at_pressure(const std::vector<PrepareStage>& stages) {
  const auto last = std::find_if(stages.rbegin(), stages.rend(), [](const PrepareStage& stage) {
    return stage.method != PrepareStage::Method::sample;
  });
  return last != stages.rend() &&
         (last->reduced_pressure ||
          (last->method == PrepareStage::Method::compress && !last->packing_fraction));
}

FieldVisitor::Inside fields(Parameters& p, const Sections& sections) {
  return [&p, sections](FieldVisitor& visit) {
    if (sections.system) {
      visit.table({"system", "",
                   "The system. Units: kT = 1; a b = 1 and mass 1 for particles of size 1; time in "
                   "√(m a b/kT)."},
                  Style::section, section_of(p.system, describe_system));
      visit.list({"species", "", "A species of particles; any number of them."}, p.species,
                 describe_species);
    }
    if (sections.prepare)
      visit.table(
          {"prepare", "", "How the first state is made: stages, one after the other."},
          Style::section, [&](FieldVisitor& in) {
            in.field({"quality_sweeps", "",
                      "Monte Carlo sweeps on a copy of the prepared state, in which `vitrel "
                      "prepare` measures pressure and time correlations for its quality report. 0: "
                      "none, then these are left out. The state itself stays."},
                     p.quality_sweeps);
            in.list({"stage", "", "The first stage places the particles, later ones move them."},
                    p.stages, describe_stage);
          });
    if (sections.run) {
      visit.table({"dynamics", "", "The event-driven run."}, Style::section,
                  section_of(p.dynamics, describe_dynamics));
      visit.table({"output", "", "What a run writes."}, Style::section,
                  section_of(p.output, describe_output));
    }
    if (sections.analysis)
      visit.table(
          {"analysis", "", "How saved runs are evaluated."}, Style::section, [&](FieldVisitor& in) {
            describe_analysis(p.analysis, in);
            in.table(
                {"structure", "", "Structure factors, pair correlations, order of single frames."},
                Style::inline_table, section_of(p.structure, describe_structure));
          });
    if (sections.sweep)
      visit.table({"sweep", "", "Many runs from one file."}, Style::section, [&](FieldVisitor& in) {
        in.grid({"grid", "",
                 "Keys of this file in quotes, and the values each of them runs through; every "
                 "combination is one job."},
                p.sweep.grid);
        in.grid(
            {"together", "",
             "Keys that advance together, each with as many values: the first values of all make "
             "one job, the second ones the next; with a grid, each of them is combined with all of "
             "the grid. The job is named after the first of these keys, and those of the grid."},
            p.sweep.together);
      });
  };
}

void validate(const Parameters& parameters) {
  validate_system(parameters.system);
  validate_species(parameters.species, parameters.system.dimension);
  validate_stages(parameters.stages, parameters.system);
  validate_dynamics(parameters.dynamics);
  if (parameters.dynamics.contact) validate_contact(parameters);
  validate_output(parameters);
  validate_analysis(parameters.analysis);
  validate_structure(parameters.structure);
  validate_sweep(parameters.sweep);
}

void require_two_dimensions(const Parameters& parameters, const std::string& what) {
  if (parameters.system.dimension != 2)
    throw BadValue("system.dimension",
                   fmt::format("is {}, but {} is there for two dimensions only; in three there are "
                               "vitrel prepare, run, check, export and report",
                               parameters.system.dimension, what));
}

Parameters load_parameters(const ParameterSource& source) {
  TomlNode root = read_toml_file(source.file);
  apply(root, source.overrides);
  if (source.seed)
    apply_override(root, fmt::format("system.seed={}", *source.seed),
                   fmt::format("--seed {}", *source.seed));
  return read(root);
}

Parameters parse_parameters(const std::string& text, const std::string& name,
                            const std::vector<std::string>& overrides) {
  TomlNode root = parse_toml(text, name);
  apply(root, overrides);
  return read(root);
}

std::string effective_parameters(const Parameters& parameters) {
  Parameters copy = parameters;
  Sections all_but_sweep;
  all_but_sweep.sweep = false;
  return write_parameters(fields(copy, all_but_sweep));
}

std::string command_template(const std::string& command) {
  static const std::map<std::string, Sections> sections = {
      {"prepare", {true, true, false, false, false}},
      {"run", {true, true, true, false, false}},
      {"analyze", {false, false, false, true, false}},
      {"sweep", {true, true, true, true, true}},
  };
  const auto found = sections.find(command);
  if (found == sections.end())
    throw UserError(fmt::format(
        "'{}' has no parameter file; commands that have one: prepare, run, analyze, sweep",
        command));
  Parameters parameters;
  if (found->second.sweep)
    parameters.sweep = {
        {{"system.seed", {"1", "2"}}},
        {{"system.packing_fraction", {"0.4", "0.6"}}, {"dynamics.duration", {"100.0", "400.0"}}}};
  return fmt::format("# Parameters of `vitrel {}`, all at their defaults.\n\n", command) +
         parameter_template(fields(parameters, found->second));
}

std::string parameter_page() {
  Parameters parameters;
  return "# Parameters\n\n"
         "<!-- Made by `vitrel params --reference`; a test compares. -->\n\n"
         "Parameter files are TOML. Every key may be left out; any key can be set on the command "
         "line, "
         "too: `--set dynamics.duration=10`, `--set species.0.aspect_ratio=3`. An unknown key, a "
         "wrong "
         "type or an impossible value is refused with file, line and column.\n\n" +
         parameter_tables(fields(parameters));
}

std::optional<ParameterDifference> forbidden_change(const std::string& before,
                                                    const std::string& after, Work work) {
  return first_difference(before, after, [work](const std::string& key) {
    if (key == "output.checkpoint_interval" || key == "prepare.quality_sweeps") return true;
    return key.starts_with("analysis.") ||
           (work == Work::preparation &&
            (key.starts_with("dynamics.") || key.starts_with("output.")));
  });
}

DynamicsOptions dynamics_options(const Parameters& parameters) {
  const DynamicsParameters& p = parameters.dynamics;
  DynamicsOptions options;
  options.engine.restitution = p.restitution;
  options.engine.on_overlap = p.on_overlap;
  options.brownian = p.kind == DynamicsParameters::Kind::brownian;
  options.brownian_step = p.brownian_step;
  options.temperature = p.temperature;
  options.seed = parameters.system.seed;
  return options;
}

std::vector<double> sample_times(const Parameters& parameters) {
  const OutputParameters& p = parameters.output;
  const double duration = parameters.dynamics.duration;
  return p.spacing == OutputParameters::Spacing::linear
             ? linear_times(p.interval, duration)
             : logarithmic_times(p.first, p.per_decade, duration);
}

}  // namespace vitrel
