#include "workflow/configuration/soft_particles.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <vector>

#include "core/elementary.h"
#include "edmd/soft/restitution_table.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

LinearDashpot in_units(const LinearDashpot& force, const UnitsOfRun& unit) {
  return {force.stiffness * unit.time * unit.time / unit.mass,
          force.damping * unit.time / unit.mass};
}
Viscoelastic in_units(const Viscoelastic& force, const UnitsOfRun& unit) {
  return {force.youngs_modulus * unit.length * unit.time * unit.time / unit.mass,
          force.poissons_ratio, force.dissipative_time / unit.time};
}

using Kinds = std::set<KindOfSphere>;

template <int Dim>
Kinds kinds_of(const Configuration<Dim>& configuration,
               std::optional<std::size_t> species = std::nullopt) {
  Kinds kinds;
  for (std::size_t i = 0; i < configuration.size(); ++i)
    if (!species || static_cast<std::size_t>(configuration.species[i]) == *species)
      kinds.insert({configuration.shape[i].circumradius(), configuration.mass[i]});
  return kinds;
}

/// All kinds or, if there are many, a selection that is spread over all radii.
std::vector<KindOfSphere> some_of(const Kinds& all) {
  constexpr std::size_t enough = 32;
  const std::vector<KindOfSphere> sorted(all.begin(), all.end());
  std::vector<KindOfSphere> kinds;
  const std::size_t count = std::min(sorted.size(), enough);
  for (std::size_t k = 0; k < count; ++k)
    kinds.push_back(sorted[count > 1 ? k * (sorted.size() - 1) / (count - 1) : 0]);
  return kinds;
}

std::vector<ContactPair> pairs_of(const Kinds& some, const Kinds& others) {
  std::vector<ContactPair> pairs;
  for (const auto& [radius1, mass1] : some_of(some))
    for (const auto& [radius2, mass2] : some_of(others))
      pairs.push_back(contact_pair(radius1, mass1, radius2, mass2));
  return pairs;
}

/// The path is empty if the user has no such folder.
fs::path cache_folder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache)
    return fs::path(cache) / "vitrel";
  if (const char* home = std::getenv("HOME"); home && *home)
    return fs::path(home) / ".cache" / "vitrel";
  return {};
}

fs::path table_file(const ForceForm& form, const RestitutionDomain& domain) {
  const fs::path folder = cache_folder();
  if (folder.empty()) return {};
  std::error_code none;  // saving the table reports any error
  fs::create_directories(folder, none);
  return folder / fmt::format("{}_{:.6g}_{:.6g}_{:.6g}_{:.6g}.h5", form.name, domain.m.low,
                              domain.m.high, domain.d.low, domain.d.high);
}

RestitutionTable table_for(const ForceForm& form, const RestitutionDomain& domain, int threads,
                           const Log& log) {
  const bool one_damping = domain.d.low == domain.d.high;
  const PanelOptions options{one_damping ? 1e-8 : 1e-6};
  const fs::path file = table_file(form, domain);
  if (auto loaded = RestitutionTable::load(file, form, domain, options)) return std::move(*loaded);
  log_line(log, "making the table of restitution coefficients");
  CachedTable kept = load_or_build_table(file, form, domain, options, threads);
  if (!kept.save_error.empty()) log_line(log, "the table is not kept: " + kept.save_error);
  return std::move(kept.table);
}

/// `force` is in the units of the run.
template <ContactForce Force>
RestitutionTable table_of(const Force& force, const std::vector<ContactPair>& pairs, int threads,
                          const Log& log) {
  const RestitutionDomain domain =
      restitution_domain(force, pairs, slowest_tabulated, fastest_tabulated);
  return table_for(form_of<Force>(), domain, threads, log);
}

template <ContactForce Force>
std::shared_ptr<SoftContact> contact_by(const Force& force,
                                        ContactParameters::Coefficients coefficients,
                                        const std::vector<ContactPair>& pairs, int threads,
                                        const Log& log) {
  const ForceForm form = form_of<Force>();
  if (coefficients == ContactParameters::Coefficients::integrated)
    return std::make_shared<SoftContactOf<Force, IntegratedRestitution>>(
        force, IntegratedRestitution(form));
  return std::make_shared<SoftContactOf<Force, TabulatedRestitution>>(
      force, TabulatedRestitution(form, table_of(force, pairs, threads, log)));
}

/// with_force_member calls `use` with a pointer to the member that holds the force of the law, with_force with the
/// force.
auto with_force_member(const ContactParameters& p, auto&& use) {
  return p.law == ContactParameters::Law::linear_dashpot ? use(&ContactParameters::linear_dashpot)
                                                         : use(&ContactParameters::viscoelastic);
}
auto with_force(const ContactParameters& p, auto&& use) {
  return with_force_member(p, [&](auto member) { return use(p.*member); });
}

ContactPair reference_pair(const ContactParameters& p) {
  const UnitsOfRun unit = units_of_run(p);
  return contact_pair(unit.length, unit.mass, unit.length, unit.mass);
}

std::string head_on_text(const ContactParameters& p) {
  const ContactScales scales = thermal_scales(p);
  const Restitution head_on =
      form_of_law(p).integrate(scaled_impact(scales, reference_pair(p), p.thermal_speed, 0));
  return fmt::format("head-on at {:.4g} m/s it lasts {:.3g} s and leaves {:.4g} of the speed",
                     p.thermal_speed, head_on.duration * scales.time, -head_on.rate);
}

/// The contact parameters of every species.
std::vector<ContactParameters> contacts_by_species(const Parameters& parameters) {
  const ContactParameters& all = parameters.dynamics.contact.value();
  std::vector<ContactParameters> contacts(parameters.species.size(), all);
  for (const MaterialParameters& material : all.materials)
    contacts[species_index(parameters, material.species).value()] = of_material(all, material);
  return contacts;
}

}  // namespace

UnitsOfRun units_of_run(const ContactParameters& p) {
  return {p.radius, p.density * 4 * std::numbers::pi / 3 * power(p.radius, 3),
          p.radius / p.thermal_speed};
}

ContactScales thermal_scales(const ContactParameters& p) {
  return contact_scales(p, reference_pair(p), p.thermal_speed);
}

ContactScales contact_scales(const ContactParameters& p, const ContactPair& pair, double speed) {
  return with_force(p, [&](const auto& force) { return force.scales(speed, pair); });
}

ForceForm form_of_law(const ContactParameters& p) {
  return with_force(p, []<ContactForce Force>(const Force&) { return form_of<Force>(); });
}

double contact_force(const ContactParameters& p, const ContactPair& pair, double compression,
                     double rate) {
  return with_force(p, [&](const auto& force) { return force.force(compression, rate, pair); });
}

RestitutionTable restitution_table(const ContactParameters& p, const std::set<KindOfSphere>& kinds,
                                   int threads, const Log& log) {
  return with_force(p, [&](const auto& force) {
    return table_of(in_units(force, units_of_run(p)), pairs_of(kinds, kinds), threads, log);
  });
}

std::string contact_text(const ContactParameters& p) {
  const UnitsOfRun unit = units_of_run(p);
  std::string text = fmt::format("contact      {}; {}\n", law_name(p.law), head_on_text(p));
  for (const MaterialParameters& material : p.materials)
    text += fmt::format("             two of {}: {}\n", material.species,
                        head_on_text(of_material(p, material)));
  return text + fmt::format("units        length {:.4g} m, mass {:.4g} kg, time {:.4g} s\n",
                            unit.length, unit.mass, unit.time);
}

ContactParameters of_material(const ContactParameters& all, const MaterialParameters& material) {
  ContactParameters p = all;
  p.linear_dashpot = {material.stiffness.value_or(p.linear_dashpot.stiffness),
                      material.damping.value_or(p.linear_dashpot.damping)};
  p.viscoelastic = {material.youngs_modulus.value_or(p.viscoelastic.youngs_modulus),
                    material.poissons_ratio.value_or(p.viscoelastic.poissons_ratio),
                    material.dissipative_time.value_or(p.viscoelastic.dissipative_time)};
  return p;
}

template <int Dim>
PairsOfSpecies<std::shared_ptr<SoftContact>> soft_contact(const Parameters& parameters,
                                                          const Configuration<Dim>& configuration,
                                                          int threads, const Log& log) {
  const ContactParameters& all = parameters.dynamics.contact.value();
  const auto contact = [&]<ContactForce Force>(const Force& force, const Kinds& some,
                                               const Kinds& others) {
    return contact_by(in_units(force, units_of_run(all)), all.coefficients, pairs_of(some, others),
                      threads, log);
  };
  return with_force_member(all, [&](auto force) -> PairsOfSpecies<std::shared_ptr<SoftContact>> {
    if (all.materials.empty()) {
      const Kinds kinds = kinds_of(configuration);
      return contact(all.*force, kinds, kinds);
    }
    const std::vector<ContactParameters> of = contacts_by_species(parameters);
    std::vector<Kinds> kinds;
    for (std::size_t k = 0; k < of.size(); ++k) {
      kinds.push_back(kinds_of(configuration, k));
      if (kinds[k].empty()) kinds[k].insert({1, 1});  // a species so rare that no particle has it
    }
    PairsOfSpecies<std::shared_ptr<SoftContact>> contacts(of.size(), nullptr);
    for (std::size_t i = 0; i < of.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        const auto& mine = of[i].*force;
        contacts.set(i, j, contact(i == j ? mine : mixed(mine, of[j].*force), kinds[i], kinds[j]));
      }
    return contacts;
  });
}

template PairsOfSpecies<std::shared_ptr<SoftContact>> soft_contact(const Parameters&,
                                                                   const Configuration2&, int,
                                                                   const Log&);
template PairsOfSpecies<std::shared_ptr<SoftContact>> soft_contact(const Parameters&,
                                                                   const Configuration3&, int,
                                                                   const Log&);

}  // namespace vitrel
