#include "workflow/configuration/soft_particles.h"

#include <fmt/format.h>

#include <cmath>
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

template <int Dim>
std::set<KindOfSphere> kinds_of(const Configuration<Dim>& configuration) {
  std::set<KindOfSphere> kinds;
  for (std::size_t i = 0; i < configuration.size(); ++i)
    kinds.insert({configuration.shape[i].circumradius(), configuration.mass[i]});
  return kinds;
}

/// All pairs of the kinds; of many kinds, of some spread over all radii.
std::vector<ContactPair> pairs_of(const std::set<KindOfSphere>& all) {
  constexpr std::size_t enough = 32;
  const std::vector<KindOfSphere> sorted(all.begin(), all.end());
  std::vector<KindOfSphere> kinds;
  const std::size_t count = std::min(sorted.size(), enough);
  for (std::size_t k = 0; k < count; ++k)
    kinds.push_back(sorted[count > 1 ? k * (sorted.size() - 1) / (count - 1) : 0]);
  std::vector<ContactPair> pairs;
  for (const auto& [radius1, mass1] : kinds)
    for (const auto& [radius2, mass2] : kinds)
      pairs.push_back(contact_pair(radius1, mass1, radius2, mass2));
  return pairs;
}

/// Empty if the user has none.
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
  std::error_code none;  // whatever is wrong shows when the table is saved
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

/// `force` is in units of the run.
template <ContactForce Force>
RestitutionTable table_of(const Force& force, const std::set<KindOfSphere>& kinds, int threads,
                          const Log& log) {
  const RestitutionDomain domain =
      restitution_domain(force, pairs_of(kinds), slowest_tabulated, fastest_tabulated);
  return table_for(form_of<Force>(), domain, threads, log);
}

template <ContactForce Force>
std::shared_ptr<SoftContact> contact_by(const Force& force,
                                        ContactParameters::Coefficients coefficients,
                                        const std::set<KindOfSphere>& kinds, int threads,
                                        const Log& log) {
  const ForceForm form = form_of<Force>();
  if (coefficients == ContactParameters::Coefficients::integrated)
    return std::make_shared<SoftContactOf<Force, IntegratedRestitution>>(
        force, IntegratedRestitution(form));
  return std::make_shared<SoftContactOf<Force, TabulatedRestitution>>(
      force, TabulatedRestitution(form, table_of(force, kinds, threads, log)));
}

/// `use(force)` for the force of the law.
template <class Use>
auto with_force(const ContactParameters& p, Use&& use) {
  return p.law == ContactParameters::Law::linear_dashpot ? use(p.linear_dashpot)
                                                         : use(p.viscoelastic);
}

ContactPair reference_pair(const ContactParameters& p) {
  const UnitsOfRun unit = units_of_run(p);
  return contact_pair(unit.length, unit.mass, unit.length, unit.mass);
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

RestitutionTable restitution_table(const ContactParameters& p, const std::set<KindOfSphere>& kinds,
                                   int threads, const Log& log) {
  return with_force(p, [&](const auto& force) {
    return table_of(in_units(force, units_of_run(p)), kinds, threads, log);
  });
}

std::string contact_text(const ContactParameters& p) {
  const UnitsOfRun unit = units_of_run(p);
  const ContactPair pair = reference_pair(p);
  const ContactScales scales = thermal_scales(p);
  const Restitution head_on =
      form_of_law(p).integrate(scaled_impact(scales, pair, p.thermal_speed, 0));
  return fmt::format(
      "contact      {}; head-on at {:.4g} m/s it lasts {:.3g} s and leaves {:.4g} of the speed\n"
      "units        length {:.4g} m, mass {:.4g} kg, time {:.4g} s\n",
      law_name(p.law), p.thermal_speed, head_on.duration * scales.time, -head_on.rate, unit.length,
      unit.mass, unit.time);
}

template <int Dim>
std::shared_ptr<SoftContact> soft_contact(const ContactParameters& parameters,
                                          const Configuration<Dim>& configuration, int threads,
                                          const Log& log) {
  const UnitsOfRun unit = units_of_run(parameters);
  return with_force(parameters, [&](const auto& force) {
    return contact_by(in_units(force, unit), parameters.coefficients, kinds_of(configuration),
                      threads, log);
  });
}

template std::shared_ptr<SoftContact> soft_contact(const ContactParameters&, const Configuration2&,
                                                   int, const Log&);
template std::shared_ptr<SoftContact> soft_contact(const ContactParameters&, const Configuration3&,
                                                   int, const Log&);

}  // namespace vitrel
