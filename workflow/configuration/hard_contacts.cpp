#include "workflow/configuration/hard_contacts.h"

#include <fmt/format.h>

#include <algorithm>

#include "workflow/configuration/sections.h"

namespace vitrel {
namespace {

using Form = RestitutionParameters::Form;

constexpr Bounds restitution_bounds{0, 1, false, false, "lie between 0 and 1 (elastic)"};
constexpr Bounds friction_bounds{.low = 0, .words = "be 0 (smooth) or above, or inf (no slip)"};
constexpr const char* form_names[] = {"viscoelastic", "table"};

NormalRestitution normal_restitution(const RestitutionParameters& p) {
  switch (p.form) {
    case Form::constant:
      return p.value;
    case Form::viscoelastic:
      return NormalRestitution::viscoelastic(p.value, p.speed);
    case Form::table:
      return NormalRestitution::tabulated(p.speeds, p.values);
  }
  return {};
}

/// The law of a pair of species. Keys that the pair does not give come from those of all pairs.
ContactLaw contact_law(const DynamicsParameters& all, const PairLawParameters& pair) {
  return {normal_restitution(pair.restitution.value_or(all.restitution)),
          pair.friction.value_or(all.friction),
          pair.tangential_restitution.value_or(all.tangential_restitution)};
}

void describe_restitution(const Field& field, RestitutionParameters& p, FieldVisitor& visit) {
  bool is_table = p.form != Form::constant;
  std::size_t form = p.form == Form::table ? 1 : 0;
  visit.value_or_table(
      field, is_table, [&](FieldVisitor& in) { in.field(field, p.value); },
      [&](FieldVisitor& in) {
        in.choice({"form", "",
                   "Dependence on the approach speed of the surfaces: viscoelastic spheres, or a "
                   "table."},
                  form, form_names);
        in.when(form == 0, "form = \"viscoelastic\"", [&](FieldVisitor& of) {
          of.field({"value",
                    "",
                    "Coefficient at this speed; it tends to 1 for slow impacts.",
                    {0, 1, true, true, "lie above 0 and below 1"}},
                   p.value);
          of.field({"speed", "speed", "The speed.", bounds::positive}, p.speed);
        });
        in.when(form == 1, "form = \"table\"", [&](FieldVisitor& of) {
          of.field({"speeds", "speed", "Speeds in ascending order.", bounds::not_negative},
                   p.speeds);
          of.field(
              {"values", "", "Coefficients at these speeds: linear between them, constant outside.",
               restitution_bounds},
              p.values);
        });
      });
  p.form = !is_table ? Form::constant : form == 0 ? Form::viscoelastic : Form::table;
}

void describe_pair(PairLawParameters& p, FieldVisitor& visit) {
  visit.field({"first", "", "Name of a species."}, p.first);
  visit.field({"second", "", "Name of the other species, or of the same."}, p.second);
  const Field restitution{"restitution", "", "As for all pairs.", restitution_bounds};
  visit.optional(restitution, p.restitution, RestitutionParameters(),
                 [&](FieldVisitor& in, RestitutionParameters& inner) {
                   describe_restitution(restitution, inner, in);
                 });
  visit.optional({"friction", "", "As for all pairs.", friction_bounds}, p.friction, 0.0);
  visit.optional({"tangential_restitution", "", "As for all pairs.", {-1, 1}},
                 p.tangential_restitution, 0.0);
}

void validate_restitution(const RestitutionParameters& p, const std::string& path,
                          const std::string& key) {
  const Rules rules(path);
  if (p.form == Form::table) {
    rules.require(!p.speeds.empty() && p.speeds.size() == p.values.size(), key + ".values",
                  fmt::format("has {} numbers, but must have as many as {}.speeds, which has {}, "
                              "and at least one",
                              p.values.size(), key, p.speeds.size()));
    rules.require(std::ranges::is_sorted(p.speeds, std::less_equal()), key + ".speeds",
                  "must hold numbers from 0 on, each above the one before");
  }
}

void validate_pairs(const Parameters& parameters) {
  const std::vector<PairLawParameters>& pairs = parameters.dynamics.pairs;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const PairLawParameters& pair = pairs[k];
    const std::string path = fmt::format("dynamics.pair.{}", k);
    const Rules rules(path);
    for (const auto& [key, name] : {std::pair("first", pair.first), {"second", pair.second}})
      rules.require(species_index(parameters, name).has_value(), key,
                    fmt::format("is \"{}\", but must be the name of a species", name));
    for (std::size_t j = 0; j < k; ++j)
      rules.require(
          std::minmax(pair.first, pair.second) != std::minmax(pairs[j].first, pairs[j].second),
          "second", fmt::format("makes the same pair as dynamics.pair.{}", j));
    if (pair.restitution) validate_restitution(*pair.restitution, path, "restitution");
  }
}

std::string restitution_text(const RestitutionParameters& p) {
  switch (p.form) {
    case Form::constant:
      return fmt::format("e = {:g}", p.value);
    case Form::viscoelastic:
      return fmt::format("e = {:g} at speed {:g}, viscoelastic", p.value, p.speed);
    case Form::table:
      return fmt::format("e = {:g} … {:g} at speeds {:g} … {:g}, from a table", p.values.front(),
                         p.values.back(), p.speeds.front(), p.speeds.back());
  }
  return {};
}

std::string law_text(const RestitutionParameters& restitution, double friction, double beta) {
  if (!ContactLaw{0.0, friction, beta}.is_rough())
    return restitution_text(restitution) + ", smooth";
  return fmt::format("{}, μ = {:g}, β = {:g}", restitution_text(restitution), friction, beta);
}

bool may_lose_energy(const RestitutionParameters& p) {
  return p.form != Form::constant || p.value < 1;
}

bool is_rough(const DynamicsParameters& p, const PairLawParameters& pair) {
  return ContactLaw{0.0, pair.friction.value_or(p.friction),
                    pair.tangential_restitution.value_or(p.tangential_restitution)}
      .is_rough();
}

}  // namespace

void describe_collisions(DynamicsParameters& p, FieldVisitor& visit) {
  describe_restitution({"restitution", "",
                        "Coefficient of normal restitution, from 0 to 1 (elastic). As a table, a "
                        "function of the speed.",
                        restitution_bounds, "", "e"},
                       p.restitution, visit);
  visit.field({"friction", "",
               "Coulomb's friction coefficient μ: 0 for smooth particles, inf for contacts that do "
               "not slip. Where there is friction, round particles spin, too.",
               friction_bounds, "", "μ"},
              p.friction);
  visit.field({"tangential_restitution",
               "",
               "Coefficient β of rough contacts that do not slip: the tangential speed of the "
               "surfaces remains (-1), vanishes (0) or is reversed (1).",
               {-1, 1}},
              p.tangential_restitution);
  visit.list({"pair", "",
              "A pair of species whose contacts are different. What is not given is as for all "
              "pairs."},
             p.pairs, describe_pair);
  visit.field({"contact_duration", "time",
               "Time t_c of the contact-time model: a collision that comes sooner after the one "
               "before of either particle is elastic and smooth, so that inelastic collapse does "
               "not stop the run; 0 for none. It should be well below the time between collisions.",
               bounds::time_or_none},
              p.contact_duration);
  const Field driving{"driving", "",
                      "Random kicks of all particles, which conserve the momentum: homogeneous "
                      "heating, for steady states of inelastic particles."};
  visit.optional(driving, p.driving, Driving(), [&](FieldVisitor& in, Driving& inner) {
    in.table(driving, FieldVisitor::TableStyle::inline_table, [&](FieldVisitor& of) {
      of.field({"interval", "time",
                "Time between kicks. It should be well below the time between collisions.",
                bounds::time},
               inner.interval);
      of.field(
          {"power", "kT/time", "Mean energy that a particle gains per unit of time.", {1e-20, 1e9}},
          inner.power);
    });
  });
}

void validate_collisions(const Parameters& parameters) {
  const DynamicsParameters& p = parameters.dynamics;
  const Rules rules("dynamics");
  validate_restitution(p.restitution, "dynamics", "restitution");
  validate_pairs(parameters);
  if (!p.driving) return;
  rules.require(p.kind == DynamicsParameters::Kind::newtonian, "driving",
                "is for kind = \"newtonian\"; Brownian dynamics draws all velocities");
}

ContactLaws contact_laws(const Parameters& parameters) {
  const DynamicsParameters& p = parameters.dynamics;
  const ContactLaw all = contact_law(p, {});
  if (p.pairs.empty()) return all;
  ContactLaws laws(parameters.species.size(), all);
  for (const PairLawParameters& pair : p.pairs)
    laws.set(*species_index(parameters, pair.first), *species_index(parameters, pair.second),
             contact_law(p, pair));
  return laws;
}

Contacts contacts_of(const DynamicsParameters& p) {
  const auto rough = [&](const PairLawParameters& pair) { return is_rough(p, pair); };
  return rough({}) || std::ranges::any_of(p.pairs, rough) ? Contacts::rough : Contacts::smooth;
}

bool has_constant_restitution(const DynamicsParameters& p) {
  return p.pairs.empty() && p.restitution.form == Form::constant && p.restitution.value < 1 &&
         !is_rough(p, {});
}

bool cools_by_haff(const DynamicsParameters& p) {
  const auto is_constant = [&](const PairLawParameters& pair) {
    return pair.restitution.value_or(p.restitution).form == Form::constant;
  };
  const bool loses =
      may_lose_energy(p.restitution) || (is_rough(p, {}) && p.tangential_restitution < 1);
  return !p.contact && loses && is_constant({}) && std::ranges::all_of(p.pairs, is_constant);
}

bool is_dissipative(const DynamicsParameters& p) {
  const auto loses = [&](const PairLawParameters& pair) {
    return may_lose_energy(pair.restitution.value_or(p.restitution)) || is_rough(p, pair);
  };
  return loses({}) || std::ranges::any_of(p.pairs, loses);
}

std::string hard_contact_text(const DynamicsParameters& p) {
  std::string text;
  if (is_dissipative(p))
    text += fmt::format("contacts     {}\n",
                        law_text(p.restitution, p.friction, p.tangential_restitution));
  for (const PairLawParameters& pair : p.pairs)
    text += fmt::format(
        "             {} and {}: {}\n", pair.first, pair.second,
        law_text(pair.restitution.value_or(p.restitution), pair.friction.value_or(p.friction),
                 pair.tangential_restitution.value_or(p.tangential_restitution)));
  if (p.contact_duration > 0)
    text += fmt::format("             elastic and smooth within t_c = {:g} after a collision\n",
                        p.contact_duration);
  if (p.driving)
    text += fmt::format("driven       by kicks every {:g}, power {:g} per particle\n",
                        p.driving->interval, p.driving->power);
  return text;
}

}  // namespace vitrel
