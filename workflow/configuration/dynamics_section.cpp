#include "workflow/configuration/sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "workflow/configuration/soft_particles.h"

namespace vitrel {
namespace {

using Style = FieldVisitor::TableStyle;

constexpr Bounds poissons_bounds{-1, 0.5, true};
constexpr const char* kind_names[] = {"newtonian", "brownian"};
constexpr const char* on_overlap_names[] = {"stop", "correct"};
constexpr const char* temperature_names[] = {"total", "relative"};
constexpr const char* velocity_names[] = {"maxwell", "translation", "rotation", "keep"};
constexpr const char* law_names[] = {"linear_dashpot", "viscoelastic"};
constexpr const char* coefficients_names[] = {"tabulated", "integrated"};
constexpr const char* early_release_names[] = {"alone", "together"};

void describe_material(MaterialParameters& p, FieldVisitor& visit) {
  const auto quantity = [&](const Field& field, std::optional<double>& value, double example) {
    visit.optional(field, value, example,
                   [&](FieldVisitor& in, double& inner) { in.quantity(field, inner); });
  };
  visit.field({"species", "", "Name of the species."}, p.species);
  quantity({"stiffness", "N/m", "Of law = \"linear_dashpot\".", bounds::positive}, p.stiffness,
           1e6);
  quantity({"damping", "kg/s", "Of law = \"linear_dashpot\".", bounds::not_negative}, p.damping, 0);
  quantity({"youngs_modulus", "Pa", "Of law = \"viscoelastic\".", bounds::positive},
           p.youngs_modulus, 1e9);
  visit.optional({"poissons_ratio", "", "Of law = \"viscoelastic\".", poissons_bounds},
                 p.poissons_ratio, 0.4);
  quantity({"dissipative_time", "s", "Of law = \"viscoelastic\".", bounds::not_negative},
           p.dissipative_time, 0);
}

/// Requires that contacts at the thermal speed have coefficients of restitution.
void validate_impact(const ContactParameters& p, const Rules& rules) {
  const bool is_dashpot = p.law == ContactParameters::Law::linear_dashpot;
  const ContactScales scales = thermal_scales(p);
  rules.require(
      scales.damping <= max_scaled_damping, is_dashpot ? "damping" : "dissipative_time",
      fmt::format("is so large that nothing is left of the thermal speed (c_dis = {:.3g}, at "
                  "most {:g}, with this radius, density and stiffness); lower it",
                  scales.damping, max_scaled_damping));
  rules.require(
      2 * p.radius >= min_scaled_distance * scales.length,
      is_dashpot ? "stiffness" : "youngs_modulus",
      fmt::format("is so small that particles pass through each other at the thermal speed "
                  "(2 R/X = {:.3g}, at least {:g}); raise it",
                  2 * p.radius / scales.length, min_scaled_distance));
}

void validate_materials(const Parameters& parameters) {
  const ContactParameters& p = *parameters.dynamics.contact;
  const bool is_dashpot = p.law == ContactParameters::Law::linear_dashpot;
  for (std::size_t k = 0; k < p.materials.size(); ++k) {
    const MaterialParameters& material = p.materials[k];
    const Rules rules(fmt::format("dynamics.contact.material.{}", k));
    rules.require(species_index(parameters, material.species).has_value(), "species",
                  fmt::format("is \"{}\", but must be the name of a species", material.species));
    for (std::size_t j = 0; j < k; ++j)
      rules.require(material.species != p.materials[j].species, "species",
                    fmt::format("is that of dynamics.contact.material.{}", j));
    const auto other_law = [&](const std::optional<double>& value, const char* key) {
      rules.require(!value, key, fmt::format("is not a key of law = \"{}\"", law_name(p.law)));
    };
    if (is_dashpot) {
      other_law(material.youngs_modulus, "youngs_modulus");
      other_law(material.poissons_ratio, "poissons_ratio");
      other_law(material.dissipative_time, "dissipative_time");
    } else {
      other_law(material.stiffness, "stiffness");
      other_law(material.damping, "damping");
    }
    validate_impact(of_material(p, material), rules);
  }
}

/// The time between two collisions of a particle of size 1, correct within a factor of about ten. It is infinite if
/// all particles are at rest.
double time_between_collisions(const Parameters& parameters) {
  double fastest = 0;
  for (const Species& species : parameters.species)
    fastest = std::max(
        fastest, std::sqrt(species.initial_temperature.value_or(1) / species.mass.value_or(1)));
  return 0.3 / (parameters.system.packing_fraction * fastest);
}

}  // namespace

const char* law_name(ContactParameters::Law law) {
  return law_names[static_cast<std::size_t>(law)];
}

void describe_contact(ContactParameters& p, FieldVisitor& visit) {
  using Law = ContactParameters::Law;
  visit.quantity({"radius", "m", "Radius of a particle of size 1.", bounds::length}, p.radius);
  visit.quantity(
      {"density", "kg/m^3",
       "Density. A particle of mass 1 has the mass of a sphere of this radius and density.",
       bounds::positive},
      p.density);
  visit.quantity({"thermal_speed", "m/s",
                  "Thermal speed √(kT/m) of a particle of mass 1 at kT = 1.", bounds::positive},
                 p.thermal_speed);
  visit.field(
      {"law", "",
       "Contact force as a function of the compression ξ: spring and dashpot, k ξ + γ dξ/dt, or "
       "viscoelastic spheres, ρ (ξ + (3/2) A dξ/dt) √ξ with ρ = 2 Y √R_eff/(3 (1 − ν²))."},
      p.law, law_names);
  visit.when(p.law == Law::linear_dashpot, "law = \"linear_dashpot\"", [&](FieldVisitor& in) {
    in.quantity({"stiffness", "N/m", "Spring constant k.", bounds::positive},
                p.linear_dashpot.stiffness);
    in.quantity({"damping", "kg/s", "Damping γ of the dashpot; \"0 kg/s\" for elastic particles.",
                 bounds::not_negative},
                p.linear_dashpot.damping);
  });
  visit.when(p.law == Law::viscoelastic, "law = \"viscoelastic\"", [&](FieldVisitor& in) {
    in.quantity({"youngs_modulus", "Pa", "Young's modulus Y.", bounds::positive, "", "Y"},
                p.viscoelastic.youngs_modulus);
    in.field({"poissons_ratio", "", "Poisson's ratio ν.", poissons_bounds},
             p.viscoelastic.poissons_ratio);
    in.quantity({"dissipative_time", "s",
                 "Dissipative time A of the material; \"0 s\" for elastic particles.",
                 bounds::not_negative},
                p.viscoelastic.dissipative_time);
  });
  visit.field({"coefficients", "",
               "Source of the restitution matrix: a table that is computed once and kept in the "
               "user's cache folder, or a slower integration of every contact."},
              p.coefficients, coefficients_names);
  visit.field({"early_release", "",
               "A particle that is hit during a contact is released alone, as published, or "
               "together with its partner, which conserves the angular momentum."},
              p.early_release, early_release_names);
}

void describe_materials(ContactParameters& p, FieldVisitor& visit) {
  visit.list({"material", "",
              "The material of a species. What is not given is as for all. Different materials "
              "touch as bodies in series: each takes its share of the compression."},
             p.materials, describe_material);
}

void describe_initial_velocities(DynamicsParameters& p, FieldVisitor& visit) {
  const Field field{"initial_velocities", "",
                    "Equilibrium at kT = 1 (maxwell), the same energy entirely in translation or "
                    "entirely in rotation, or the velocities of the initial state (keep). As a "
                    "table, any split of the energy."};
  bool is_split = p.initial_velocities == InitialVelocities::split;
  InitialVelocities kind = is_split ? InitialVelocities::maxwell : p.initial_velocities;
  visit.value_or_table(
      field, is_split, [&](FieldVisitor& in) { in.field(field, kind, velocity_names); },
      [&](FieldVisitor& in) {
        in.field({"translation", "", "Share of the energy in translation; the rest is in rotation.",
                  bounds::share},
                 p.translation_share);
      });
  p.initial_velocities = is_split ? InitialVelocities::split : kind;
}

void describe_duration(DynamicsParameters& p, FieldVisitor& visit) {
  const Field field{"duration", "time",
                    "Duration of the sampled part of the run. As a table, the run ends as soon as "
                    "it has lasted so many relaxation times.",
                    bounds::time};
  bool has_goal = p.relaxation_times.has_value();
  double times = p.relaxation_times.value_or(20);
  visit.value_or_table(
      field, has_goal, [&](FieldVisitor& in) { in.field(field, p.duration); },
      [&](FieldVisitor& in) {
        in.field(
            {"relaxation_times",
             "",
             "The run ends after so many of the longer of the relaxation times of translation "
             "and, if particles are not round, rotation, as correlations on the fly give them. "
             "This is looked at after at_most/2, at_most/4 …",
             {1, 1e6}},
            times);
        in.field({"at_most", "time", "Duration if the relaxation is slower.", bounds::time},
                 p.duration);
      });
  p.relaxation_times = has_goal ? std::optional(times) : std::nullopt;
}

void describe_dynamics(DynamicsParameters& p, FieldVisitor& visit) {
  visit.field({"kind", "",
               "Free flight and collisions (newtonian), or the same with all velocities redrawn "
               "after every brownian_step (brownian)."},
              p.kind, kind_names);
  visit.field({"brownian_step", "time",
               "Time τ_B between draws of the velocities. A free particle diffuses with D = kT "
               "τ_B/(2 m). Brownian dynamics only.",
               bounds::time, "", "τ_B"},
              p.brownian_step);
  visit.field({"equilibration", "time", "Duration of the run before sampling starts, at time 0.",
               bounds::time_or_none},
              p.equilibration);
  describe_duration(p, visit);
  describe_collisions(p, visit);
  visit.field({"on_overlap", "",
               "Action if two particles overlap: stop with exit code 4, or apply and count the "
               "correction move of the thesis."},
              p.on_overlap, on_overlap_names);
  visit.field({"temperature", "",
               "Energy that corresponds to kT = 1 when velocities are drawn: a translational "
               "energy of N kT (total) or of (N − 1) kT (relative: the degrees of freedom that "
               "remain once the net momentum is removed)."},
              p.temperature, temperature_names);
  describe_initial_velocities(p, visit);
  visit.field({"rotation", "",
               "Rotation of ellipsoids with three different semi-axes in free flight: by Euler's "
               "equations (euler), or about a constant angular velocity (constant), which is "
               "faster and has the same static averages. Preparation by growth keeps it constant."},
              p.rotation, rotation_names);
  const Field contact{"contact", "",
                      "Contact force of soft particles, which must be round. Without this section "
                      "particles are hard."};
  visit.optional(contact, p.contact, ContactParameters(),
                 [&](FieldVisitor& in, ContactParameters& inner) {
                   in.table(contact, Style::section, [&](FieldVisitor& of) {
                     describe_contact(inner, of);
                     describe_materials(inner, of);
                   });
                 });
}

/// Limits the collisions and the steps of a run, so that doubles still resolve its times.
void validate_times(const Parameters& parameters) {
  constexpr double max_flights = 1e10, max_steps = 1e12;
  const DynamicsParameters& p = parameters.dynamics;
  const Rules rules("dynamics");
  const double longest = max_flights * time_between_collisions(parameters);
  for (const auto& [key, time] :
       {std::pair("equilibration", p.equilibration), {"duration", p.duration}})
    rules.require(time <= longest, key,
                  fmt::format("is {}, but must not exceed {:.3g}, some {:g} times the time between "
                              "collisions: longer ones are not resolved",
                              show(time), longest, max_flights));
  const auto require_few = [&](double interval, const char* key) {
    const double steps = (p.equilibration + p.duration) / interval;
    rules.require(steps <= max_steps, key,
                  fmt::format("is {}, which makes {:.3g} steps; at most {:g} are possible",
                              show(interval), steps, max_steps));
  };
  if (p.kind == DynamicsParameters::Kind::brownian) require_few(p.brownian_step, "brownian_step");
  if (p.driving) require_few(p.driving->interval, "driving.interval");
}

void validate_contact(const Parameters& parameters) {
  const ContactParameters& p = *parameters.dynamics.contact;
  const Rules rules("dynamics.contact");
  validate_impact(p, rules);
  validate_materials(parameters);
  for (std::size_t k = 0; k < parameters.species.size(); ++k)
    if (!is_round(parameters.species[k]))
      throw BadValue(fmt::format("species.{}", k),
                     "is not round, but soft particles ([dynamics.contact]) must be; set "
                     "aspect_ratio = 1");
  const Rules dynamics("dynamics");
  const std::string hard_only =
      "is for hard particles, but [dynamics.contact] makes them soft; leave it out";
  const DynamicsParameters& all = parameters.dynamics;
  dynamics.require(
      all.restitution.form == RestitutionParameters::Form::constant && all.restitution.value == 1,
      "restitution", hard_only);
  dynamics.require(all.friction == 0, "friction", hard_only);
  dynamics.require(all.pairs.empty(), "pair", hard_only);
  dynamics.require(all.contact_duration == 0, "contact_duration", hard_only);
  dynamics.require(!all.driving, "driving", hard_only);
  dynamics.require(parameters.dynamics.on_overlap == OnOverlap::stop, "on_overlap", hard_only);
}

}  // namespace vitrel
