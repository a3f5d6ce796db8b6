// How accurate and how fast is the restitution matrix of soft spheres, integrated and from tables, in the
// whole domain of the source (mueller2013, tables 1 and 2)?

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "bench/studies/soft_contacts.h"
#include "bench/surveys/best_seconds.h"
#include "core/io/json.h"
#include "core/parallel.h"
#include "core/random/stream.h"
#include "edmd/soft/linear_dashpot.h"
#include "edmd/soft/restitution_table.h"
#include "edmd/soft/viscoelastic.h"

namespace vitrel::bench {
namespace {

constexpr double pi = std::numbers::pi;

struct Effort {
  int random_points = 200'000;
  int cells = 60;  // of the lattice of points, along each axis
  int timed = 200'000;
};
const Effort quick{500, 8, 2000};

// --- the domain ------------------------------------------------------------------------------------------

constexpr ValueRange radius{0.001, 0.1}, density{250, 3250}, speed{0.001, 25},
    eccentricity{0.01, 0.99};

/// The ranges of the parameters of a material, and the material at given values of them.
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

ContactPair pair_of(double radius1, double radius2, double of_density) {
  return contact_pair(radius1, mass_of(radius1, of_density), radius2, mass_of(radius2, of_density));
}

double obliqueness(double of_eccentricity) {
  return std::log(of_eccentricity / std::sqrt(1 - of_eccentricity * of_eccentricity));
}

/// The domain that the corners of all ranges span.
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

/// Impacts that are uniformly distributed in g, m and d.
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

/// Impacts at the centres of the cells of a lattice in g, m and d.
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

/// Absolute error of ε_r, and relative errors of ε_φ, ε_t and ε_ṙ.
using Errors = std::array<double, 4>;

Errors errors_of(const Restitution& found, const Restitution& expected) {
  return {std::abs(found.distance - expected.distance), std::abs(found.angle / expected.angle - 1),
          std::abs(found.duration / expected.duration - 1),
          std::abs(found.rate / expected.rate - 1)};
}

Json errors_json(const Errors& errors) {
  return {{"error", std::ranges::max(errors)},
          {"distance", errors[0]},
          {"angle", errors[1]},
          {"duration", errors[2]},
          {"rate", errors[3]}};
}

Errors largest(const std::vector<Errors>& all) {
  Errors most{};
  for (const Errors& one : all)
    for (std::size_t k = 0; k < most.size(); ++k) most[k] = std::max(most[k], one[k]);
  return most;
}

Effort effort_of(const StudyContext& context) {
  return context.options.quick ? quick : Effort{};
}

template <class Find>
double nanoseconds(const std::vector<ScaledImpact>& impacts, Find&& find) {
  double sum = 0;
  const double seconds = seconds_of([&] {
    for (const ScaledImpact& impact : impacts) sum += find(impact);
  });
  if (std::isnan(sum)) throw std::runtime_error("a coefficient is no number");
  return 1e9 * seconds / static_cast<double>(impacts.size());
}

/// Measures a table, and the integration for the same impacts.
template <class Force>
Json table_rows(const std::string& kind, const RestitutionDomain& domain, double tolerance,
                const Effort& effort) {
  const ForceForm form = form_of<Force>();
  std::optional<RestitutionTable> built;
  const double seconds = seconds_of([&] {
    built.emplace(form, domain, PanelOptions{tolerance, 0.02}, all_cores);
  });
  const RestitutionTable& table = *built;

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
  const Json about = {{"force", Force::name}, {"domain", kind}, {"tolerance", tolerance}};
  Json row = {{"method", "table"}};
  row.update(about);
  row.update(errors_json(largest(errors)));
  row["ns_per_impact"] = nanoseconds(impacts, [&](const ScaledImpact& impact) {
    const auto found = table(impact);
    return found ? found->angle : 0;
  });
  row["megabytes"] = 1e-6 * static_cast<double>(table.bytes());
  row["seconds"] = seconds;
  row["points"] = errors.size();
  row["without_value"] = std::ranges::count(without, 1);
  impacts.resize(impacts.size() / 20);
  Json other = {{"method", "integration"}};
  other.update(about);
  other["ns_per_impact"] = nanoseconds(
      impacts, [&](const ScaledImpact& impact) { return form.integrate(impact).angle; });
  return Json::array({row, other});
}

Json joined(std::initializer_list<Json> tables) {
  Json rows = Json::array();
  for (const Json& table : tables)
    for (const Json& row : table) rows.push_back(row);
  return rows;
}

/// Tables for the domain of the source, for the equal spheres of its figure 7 with some damping, and for radii that
/// differ by 20 %.
template <class Force>
Json all_tables(const Force& material, const Effort& effort) {
  RestitutionDomain whole = domain_of_the_source<Force>(), elastic = whole;
  elastic.d = elastic_damping;
  const std::array pairs{pair_of(0.1, 0.1, 1140), pair_of(0.1, 0.12, 1140),
                         pair_of(0.12, 0.12, 1140)};
  return joined({table_rows<Force>("the source's", whole, 1e-6, effort),
                 table_rows<Force>("the source's, elastic", elastic, 1e-6, effort),
                 table_rows<Force>("the source's, elastic", elastic, 1e-8, effort),
                 table_rows<Force>(
                     "one pair", restitution_domain(material, std::span(pairs).first(1), 1e-3, 25),
                     1e-8, effort),
                 table_rows<Force>("radii that differ by 20 %",
                                   restitution_domain(material, pairs, 1e-3, 25), 1e-7, effort)});
}

Json measure_tables(const StudyContext& context) {
  const Effort effort = effort_of(context);
  return joined({all_tables(LinearDashpot{1e5, 1.25}, effort),
                 all_tables(Viscoelastic{1e9, 0.4, 1e-4}, effort)});
}

}  // namespace

Part restitution_part() {
  const Column error = {"error", "largest error", Shown::error};
  const std::vector<Column> coefficients = {{"distance", "ε_r", Shown::error},
                                            {"angle", "ε_φ", Shown::error},
                                            {"duration", "ε_t", Shown::error},
                                            {"rate", "ε_ṙ", Shown::error}};
  std::vector<Column> of_tables = coefficients;
  for (const Column& column :
       {Column{"megabytes", "MB"}, Column{"seconds", "build", Shown::number, "s"}, Column{"points"},
        Column{"without_value", "without a value", Shown::count}})
    of_tables.push_back(column);
  return {.name = "restitution",
          .about =
              "Tables of coefficients (edmd/soft/restitution_table.h) beside the "
              "integration, at random points and at the centres of a grid of cells. The "
              "domain of the source is that of its tables 1 and 2, for any two radii. Times "
              "include the logarithms of a random impact and cache misses.",
          .measure = measure_tables,
          .cases = {{"force"}, {"domain"}, {"tolerance", "tolerance", Shown::error}},
          .cost = {"ns_per_impact", "time per impact", Shown::time},
          .error = error,
          .others = of_tables};
}

}  // namespace vitrel::bench
