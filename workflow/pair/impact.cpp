#include "workflow/pair/impact.h"

#include <fmt/format.h>

#include <cmath>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/special_values.h"
#include "edmd/soft/restitution_table.h"
#include "workflow/configuration/sections.h"
#include "workflow/rules.h"

namespace vitrel {
namespace {

void describe_impact(Impact& p, FieldVisitor& visit) {
  visit.quantity({"speed", "m/s", "Relative speed of the centres at first contact."}, p.speed);
  visit.field({"impact_parameter", "",
               "Impact parameter over the sum of the radii, the sine of the impact angle."},
              p.impact_parameter);
  visit.quantity({"second_radius", "m", "Radius of the second particle."}, p.second_radius);
}

/// Reads the contact from the file or, without one, takes the defaults for spheres.
ContactParameters load_contact(const ImpactSource& source) {
  std::vector<std::string> overrides;
  for (const std::string& assignment : source.overrides)
    overrides.push_back("dynamics.contact." + assignment);
  const char* const spheres = "[[species]]\naspect_ratio = 1\n[dynamics.contact]\n";
  const Parameters parameters = source.file.empty()
                                    ? parse_parameters(spheres, "defaults", overrides)
                                    : load_parameters({source.file, overrides, std::nullopt});
  if (!parameters.dynamics.contact)
    throw UserError(source.file.string() +
                    ": has no section [dynamics.contact], which makes particles soft");
  return *parameters.dynamics.contact;
}

void apply_option(TomlNode& root, const std::string& option, const std::string& key,
                  const std::string& value) {
  if (!value.empty()) apply_override(root, key + "=" + value, option + " " + value);
}

constexpr Restitution no_value{unknown, unknown, unknown, unknown};

/// The centre of cell k if the interval [low, high] is divided into `side` equal cells.
double within(double low, double high, int k, int side) {
  return low + (k + 0.5) / side * (high - low);
}

}  // namespace

ContactPair Impact::pair() const {
  const double mass = units_of_run(contact).mass;
  return contact_pair(contact.radius, mass, second_radius,
                      mass * power(second_radius / contact.radius, 3));
}

double Impact::normal_speed() const {
  return speed * std::sqrt((1 - impact_parameter) * (1 + impact_parameter));
}

ContactScales Impact::scales() const {
  return contact_scales(contact, pair(), normal_speed());
}

ScaledImpact Impact::scaled() const {
  return scaled_impact(scales(), pair(), normal_speed(), speed * impact_parameter);
}

void validate(const Impact& p) {
  const Rules rules("");
  rules.positive(p.speed, "speed");
  rules.require(p.impact_parameter >= 0 && p.impact_parameter < 1, "impact_parameter",
                fmt::format("is {}, but must lie from 0 (head-on) to below 1 (grazing)",
                            show(p.impact_parameter)));
  constexpr double largest_ratio = 1000;
  const double ratio = p.second_radius / p.contact.radius;
  rules.require(
      ratio >= 1 / largest_ratio && ratio <= largest_ratio, "second_radius",
      fmt::format("is {} m, but must lie between {} m and {} m, in proportion to the first",
                  show(p.second_radius), p.contact.radius / largest_ratio,
                  p.contact.radius * largest_ratio));
  const ScaledImpact scaled = p.scaled();
  rules.require(scaled.damping <= max_scaled_damping, "second_radius",
                fmt::format("is so small that nothing is left of the speed (c_dis = {:.3g}, at "
                            "most {:g}); raise it",
                            scaled.damping, max_scaled_damping));
  rules.require(scaled.distance >= min_scaled_distance, "speed",
                fmt::format("is so high that the spheres pass through each other (l/X = {:.3g}, at "
                            "least {:g}); lower it",
                            scaled.distance, min_scaled_distance));
}

Impact load_impact(const ImpactSource& source) {
  Impact impact;
  impact.contact = load_contact(source);
  impact.speed = impact.contact.thermal_speed;
  impact.second_radius = impact.contact.radius;
  TomlNode root;
  apply_option(root, "--speed", "speed", source.speed);
  apply_option(root, "--impact-parameter", "impact_parameter", source.impact_parameter);
  apply_option(root, "--second-radius", "second_radius", source.second_radius);
  read_parameters(
      root, [&](FieldVisitor& visit) { describe_impact(impact, visit); },
      [&] { validate(impact); });
  return impact;
}

Restitution integrated(const Impact& impact) {
  return form_of_law(impact.contact).integrate(impact.scaled());
}

RestitutionTable table_of(const Impact& impact, const Log& log) {
  const double size = impact.second_radius / impact.contact.radius;
  return restitution_table(impact.contact, {{1, 1}, {size, power(size, 3)}}, all_cores, log);
}

Table coefficients_on_lattice(const Impact& impact, const RestitutionTable& table) {
  constexpr int side = 100;
  Table lattice{"restitution",
                "Restitution matrix of two soft spheres from the table: ε_r (distance), ε_φ "
                "(angle), ε_t (duration, in units of the time scale of the force) and ε_ṙ (rate), "
                "for relative speeds and impact parameters (over the sum of the radii).",
                {{"relative_speed", "m/s"},
                 {"impact_parameter", "1"},
                 {"distance", "1"},
                 {"angle", "rad"},
                 {"duration", "1"},
                 {"rate", "1"},
                 {"contact_time", "s"}}};
  Impact at = impact;
  for (int i = 0; i < side; ++i) {
    const double size = within(logarithm(slowest_tabulated), logarithm(fastest_tabulated), i, side);
    at.speed = impact.contact.thermal_speed * exponential(size);
    for (int j = 0; j < side; ++j) {
      const double tangent =
          exponential(within(typical_obliqueness.low, typical_obliqueness.high, j, side));
      at.impact_parameter = tangent / std::sqrt(1 + tangent * tangent);
      const Restitution found = table(at.scaled()).value_or(no_value);
      add_row(lattice, {at.speed, at.impact_parameter, found.distance, found.angle, found.duration,
                        found.rate, found.duration * at.scales().time});
    }
  }
  return lattice;
}

std::string impact_text(const Impact& impact) {
  Impact copy = impact;
  return write_parameters([&](FieldVisitor& visit) {
    describe_impact(copy, visit);
    visit.table({"contact", "", "The material."}, FieldVisitor::TableStyle::section,
                section_of(copy.contact, describe_contact));
  });
}

}  // namespace vitrel
