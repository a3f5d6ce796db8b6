// How accurate and how fast is the restitution matrix of soft spheres, integrated and from tables, in the
// whole domain of the source (mueller2013, tables 1 and 2)?
//
// Prints JSON. scripts/validate restitution builds and runs this, compares with what is wanted, and writes
// its section of docs/validation.md.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "bench/baselines/plain_contact.h"
#include "bench/programs/parts.h"
#include "core/io/json.h"
#include "core/io/provenance.h"
#include "core/parallel.h"
#include "core/random/stream.h"
#include "edmd/soft/linear_dashpot.h"
#include "edmd/soft/restitution_table.h"
#include "edmd/soft/viscoelastic.h"

namespace vitrel::bench {
namespace {

constexpr double pi = std::numbers::pi;

struct Effort {
  int integrations = 1000;  // compared with the plain one
  int random_points = 200'000;
  int cells = 60;  // of the lattice of points, along each axis
  int timed = 200'000;
};
const Effort quick{20, 500, 8, 2000};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// --- the domain ------------------------------------------------------------------------------------------

constexpr ValueRange radius{0.001, 0.1}, density{250, 3250}, speed{0.001, 25},
    eccentricity{0.01, 0.99};

double log_uniform(const ValueRange& interval, Stream& draw) {
  return interval.low * std::pow(interval.high / interval.low, draw.uniform());
}

/// Ranges of the material, and one of the corners or a random place of them.
template <class Force>
struct Materials;

template <>
struct Materials<LinearDashpot> {
  static constexpr std::array ranges{ValueRange{1e3, 1e6}, ValueRange{0.01, 1.25}};
  static LinearDashpot material(const std::array<double, 2>& x) { return {x[0], x[1]}; }
};

template <>
struct Materials<Viscoelastic> {
  static constexpr std::array ranges{ValueRange{1e7, 1e11}, ValueRange{0.2, 0.5},
                                     ValueRange{1e-6, 1}};
  static Viscoelastic material(const std::array<double, 3>& x) { return {x[0], x[1], x[2]}; }
};

double mass_of(double of_radius, double of_density) {
  return 4 * pi / 3 * std::pow(of_radius, 3) * of_density;
}

template <class Force>
Force corner_material(int corner) {
  constexpr auto& ranges = Materials<Force>::ranges;
  std::array<double, ranges.size()> x;
  for (std::size_t k = 0; k < ranges.size(); ++k)
    x[k] = corner >> k & 1 ? ranges[k].high : ranges[k].low;
  return Materials<Force>::material(x);
}

template <class Force>
Force random_material(Stream& draw) {
  constexpr auto& ranges = Materials<Force>::ranges;
  std::array<double, ranges.size()> x;
  for (std::size_t k = 0; k < ranges.size(); ++k) x[k] = log_uniform(ranges[k], draw);
  return Materials<Force>::material(x);
}

ContactPair pair_of(double radius1, double radius2, double of_density) {
  return contact_pair(radius1, mass_of(radius1, of_density), radius2, mass_of(radius2, of_density));
}

double obliqueness(double of_eccentricity) {
  return std::log(of_eccentricity / std::sqrt(1 - of_eccentricity * of_eccentricity));
}

/// What the corners of all ranges span.
template <class Force>
RestitutionDomain domain_of_the_source() {
  std::vector<ContactPair> pairs;
  for (const double one : {radius.low, radius.high})
    for (const double two : {radius.low, radius.high})
      for (const double of_density : {density.low, density.high})
        pairs.push_back(pair_of(one, two, of_density));
  RestitutionDomain all{{obliqueness(eccentricity.low), obliqueness(eccentricity.high)},
                        {INFINITY, -INFINITY},
                        {INFINITY, -INFINITY}};
  for (int corner = 0; corner < 1 << Materials<Force>::ranges.size(); ++corner) {
    const RestitutionDomain one =
        restitution_domain(corner_material<Force>(corner), pairs, speed.low, speed.high);
    all.m = {std::min(all.m.low, one.m.low), std::max(all.m.high, one.m.high)};
    all.d = {std::min(all.d.low, one.d.low), std::max(all.d.high, one.d.high)};
  }
  return all;
}

template <class Force>
ScaledImpact random_impact_of_the_source(Stream& draw) {
  const Force force = random_material<Force>(draw);
  const double rho = log_uniform(density, draw);
  const double r2 = log_uniform(radius, draw), r1 = log_uniform(radius, draw);
  const ContactPair pair = pair_of(r1, r2, rho);
  const double v = log_uniform(speed, draw), e = draw.uniform(eccentricity.low, eccentricity.high);
  return scaled_impact(force, pair, v * std::sqrt(1 - e * e), v * e);
}

// --- impacts in a domain -----------------------------------------------------------------------------------

template <class Force>
ScaledImpact impact_at(const RestitutionDomain& domain, double g, double m, double d) {
  const auto within = [](const ValueRange& interval, double share) {
    return interval.low == interval.high ? interval.low
                                         : interval.low + share * (interval.high - interval.low);
  };
  const double tangent = std::exp(within(domain.g, g));
  const double distance =
      std::exp(within(domain.m, m)) * std::pow(1 + tangent * tangent, Force::length_exponent);
  return {distance, distance * tangent,
          std::exp(within(domain.d, d)) * std::pow(distance, -Force::damping_exponent)};
}

/// Uniform in g, m and d.
template <class Force>
std::vector<ScaledImpact> random_impacts(const RestitutionDomain& domain, int count) {
  Stream draw(1, Purpose::benchmark_cases);
  std::vector<ScaledImpact> all;
  for (int k = 0; k < count; ++k) {
    const double d = draw.uniform(), m = draw.uniform(), g = draw.uniform();
    all.push_back(impact_at<Force>(domain, g, m, d));
  }
  return all;
}

/// The middles of equal cells.
template <class Force>
std::vector<ScaledImpact> lattice_impacts(const RestitutionDomain& domain, int cells) {
  const int layers = domain.d.low == domain.d.high ? 1 : cells;
  std::vector<ScaledImpact> all;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      for (int k = 0; k < layers; ++k)
        all.push_back(
            impact_at<Force>(domain, (i + 0.5) / cells, (j + 0.5) / cells, (k + 0.5) / layers));
  return all;
}

// --- errors --------------------------------------------------------------------------------------------------

/// ε_φ, ε_t and ε_ṙ relative, and ε_r absolute.
using Errors = std::array<double, 4>;

Errors errors_of(const Restitution& found, const Restitution& expected) {
  return {std::abs(found.distance - expected.distance), std::abs(found.angle / expected.angle - 1),
          std::abs(found.duration / expected.duration - 1),
          std::abs(found.rate / expected.rate - 1)};
}

Json errors_json(const Errors& errors) {
  return {
      {"distance", errors[0]}, {"angle", errors[1]}, {"duration", errors[2]}, {"rate", errors[3]}};
}

Errors largest(const std::vector<Errors>& all) {
  Errors most{};
  for (const Errors& one : all)
    for (std::size_t k = 0; k < most.size(); ++k) most[k] = std::max(most[k], one[k]);
  return most;
}

/// Of the integration, beside the plain equations in extended precision where these are good for it.
template <class Force>
Json integration_json(const Effort& effort) {
  fmt::print(stderr, "{}, integration\n", Force::name);
  std::vector<ScaledImpact> impacts =
      random_impacts<Force>(domain_of_the_source<Force>(), effort.integrations);
  std::erase_if(impacts, [](const ScaledImpact& impact) { return impact.damping > 20; });
  std::vector<Errors> errors(impacts.size());
  in_parallel(impacts.size(), all_cores, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      errors[k] =
          errors_of(integrate_contact<Force>(impacts[k]), PlainContact<Force>(impacts[k])());
  });
  return {{"impacts", impacts.size()}, {"errors", errors_json(largest(errors))}};
}

template <class Find>
double nanoseconds(const std::vector<ScaledImpact>& impacts, Find&& find) {
  const auto start = std::chrono::steady_clock::now();
  double sum = 0;
  for (const ScaledImpact& impact : impacts) sum += find(impact);
  if (std::isnan(sum)) throw std::runtime_error("a coefficient is no number");
  return 1e9 * seconds_since(start) / static_cast<double>(impacts.size());
}

Json range_json(const ValueRange& interval) {
  return Json::array({interval.low, interval.high});
}

template <class Force>
Json table_json(const std::string& kind, const RestitutionDomain& domain, double tolerance,
                const Effort& effort) {
  fmt::print(stderr, "{}, {}\n", Force::name, kind);
  const ForceForm form = form_of<Force>();
  const auto start = std::chrono::steady_clock::now();
  const RestitutionTable table(form, domain, {tolerance, 0.02}, all_cores);
  const double seconds = seconds_since(start);

  std::vector<ScaledImpact> impacts = random_impacts<Force>(domain, effort.random_points);
  const std::vector<ScaledImpact> lattice = lattice_impacts<Force>(domain, effort.cells);
  impacts.insert(impacts.end(), lattice.begin(), lattice.end());
  std::vector<Errors> errors(impacts.size(), Errors{});
  std::vector<char> without(impacts.size(), 0);
  in_parallel(impacts.size(), all_cores, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      if (const auto found = table(impacts[k]))
        errors[k] = errors_of(*found, form.integrate(impacts[k]));
      else
        without[k] = 1;
  });
  impacts.resize(static_cast<std::size_t>(effort.timed));
  Json row = {{"force", Force::name},
              {"kind", kind},
              {"g", range_json(domain.g)},
              {"m", range_json(domain.m)}};
  if (std::isfinite(domain.d.low)) row["d"] = range_json(domain.d);
  row["tolerance"] = tolerance;
  row["panels"] = table.panels();
  row["megabytes"] = 1e-6 * static_cast<double>(table.bytes());
  row["seconds"] = seconds;
  row["points"] = errors.size();
  row["without_value"] = std::ranges::count(without, 1);
  row["errors"] = errors_json(largest(errors));
  row["nanoseconds"] = nanoseconds(impacts, [&](const ScaledImpact& impact) {
    const auto found = table(impact);
    return found ? found->angle : 0;
  });
  impacts.resize(impacts.size() / 20);
  row["integration_nanoseconds"] = nanoseconds(
      impacts, [&](const ScaledImpact& impact) { return form.integrate(impact).angle; });
  if (domain.d.high > domain.d.low && domain == domain_of_the_source<Force>()) {
    Stream draw(2, Purpose::benchmark_cases);
    int outside = 0;
    for (int k = 0; k < effort.random_points; ++k)
      outside += !table(random_impact_of_the_source<Force>(draw));
    row["source_impacts"] = effort.random_points;
    row["source_impacts_without_value"] = outside;
  }
  return row;
}

/// Equal spheres of the source's figure 7, with some damping; and radii that differ by 20 %.
template <class Force>
Json scene_tables(const Force& material, const Effort& effort) {
  const std::array pairs{pair_of(0.1, 0.1, 1140), pair_of(0.1, 0.12, 1140),
                         pair_of(0.12, 0.12, 1140)};
  return Json::array(
      {table_json<Force>("one pair",
                         restitution_domain(material, std::span(pairs).first(1), 1e-3, 25), 1e-8,
                         effort),
       table_json<Force>("radii that differ by 20 %", restitution_domain(material, pairs, 1e-3, 25),
                         1e-7, effort)});
}

template <class Force>
Json tables_of_the_source(const Effort& effort) {
  RestitutionDomain domain = domain_of_the_source<Force>();
  Json rows = Json::array({table_json<Force>("the source's", domain, 1e-6, effort)});
  domain.d = elastic_damping;
  rows.push_back(table_json<Force>("the source's, elastic", domain, 1e-6, effort));
  rows.push_back(table_json<Force>("the source's, elastic", domain, 1e-8, effort));
  return rows;
}

Json measure(const Effort& effort) {
  Json result = {{"commit", program_commit()}};
  result["integration"] = {{"linear_dashpot", integration_json<LinearDashpot>(effort)},
                           {"viscoelastic", integration_json<Viscoelastic>(effort)}};
  result["tables"] = Json::array();
  for (const Json& rows :
       {tables_of_the_source<LinearDashpot>(effort), scene_tables(LinearDashpot{1e5, 1.25}, effort),
        tables_of_the_source<Viscoelastic>(effort),
        scene_tables(Viscoelastic{1e9, 0.4, 1e-4}, effort)})
    for (const Json& row : rows) result["tables"].push_back(row);
  return result;
}

}  // namespace

int restitution(bool is_quick) {
  print(measure(is_quick ? quick : Effort{}));
  return 0;
}

}  // namespace vitrel::bench
