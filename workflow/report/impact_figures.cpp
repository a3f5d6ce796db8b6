#include "workflow/report/pair_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/special_values.h"
#include "edmd/soft/restitution_table.h"

namespace vitrel {
namespace {

/// The columns of the coefficients with their symbols, in the order of the figures of mueller2013.
constexpr std::pair<const char*, const char*> element_columns[] = {
    {"angle", "ε_φ"}, {"rate", "ε_ṙ"}, {"distance", "ε_r"}, {"duration", "ε_t"}};

// --- maps of all materials ------------------------------------------------------------------------

constexpr int lattice_side = 41, lattice_size = lattice_side * lattice_side, dampings = 5;

/// The variables over which the source tabulates a law.
struct ScaledAxes {
  double m_min, m_max;
  double damping_low, damping_high;  ///< range of ln c_dis, or of ln c_dis/c_dis^min
  double c_min;
  const char *column, *symbol;  ///< of the damping

  /// The damping of a map; −∞ for the first map, which is elastic.
  double damping_of(int map) const {
    const double share = static_cast<double>(map - 1) / (dampings - 1);
    return map == 0 ? -infinity : damping_low + share * (damping_high - damping_low);
  }
};
constexpr double g_min = -4.605120, g_max = 1.948493;  // ln(e/√(1 − e²)) of the eccentricities e
constexpr ScaledAxes dashpot_axes{-2.3, 14.83, -12.47, 4.00, 0, "ln_c_dis", "ln c_dis"};
constexpr ScaledAxes viscoelastic_axes{
    0.75, 13.66, 0, 9.84 + 18.71, -18.71, "ln_c_dis_over_min", "ln c_dis/c_dis,min"};

/// Row k of the table that holds all maps one after the other.
std::vector<double> scaled_row(const ScaledAxes& of, const ForceForm& form, int k) {
  const double g = (g_max - g_min) * (k % lattice_side) / (lattice_side - 1);
  const double m = (of.m_max - of.m_min) * (k / lattice_side % lattice_side) / (lattice_side - 1);
  const double damping = of.damping_of(k / lattice_size);
  const double oblique = std::log1p(std::exp(2 * (g_min + g)));
  const double ln_l = of.m_min + m + form.length_exponent * oblique;
  const double ln_c_phi = ln_l + g_min + g;
  const double ln_c_min = of.c_min == 0 ? 0 : of.c_min + ln_l - 0.5 * oblique;
  const double c_dis = std::exp(damping + ln_c_min);
  const Restitution found = form.integrate({std::exp(ln_l), std::exp(ln_c_phi), c_dis});
  return {damping, g,           m,          ln_c_phi,       ln_l,
          c_dis,   found.angle, found.rate, found.distance, found.duration};
}

// --- paths of one impact --------------------------------------------------------------------------

using Relative = RelativeMotion<2>;

constexpr int parts_of_seventh = 10;

Relative flown(const Relative& from, double time) {
  return {from.position + time * from.velocity, from.velocity};
}

/// Integrates the contact by the midpoint rule, with errors ∝ step². The path has a point at first contact and after
/// every `interval`.
std::vector<Relative> integrated_path(const Impact& impact, Relative at, double interval,
                                      int count) {
  constexpr int steps = 2000;
  const double step = interval / steps;
  const ContactPair pair = impact.pair();
  const auto acceleration = [&](const Relative& x) -> Vec2 {
    const double distance = x.position.norm(), compression = pair.distance - distance;
    // The spheres have separated if the gap is more than rounding.
    if (compression < -1e-12 * pair.distance) return Vec2::Zero();
    const Vec2 normal = x.position / distance;
    const double force =
        contact_force(impact.contact, pair, std::max(0.0, compression), -normal.dot(x.velocity));
    return std::max(0.0, force) / pair.mass * normal;
  };
  std::vector<Relative> path = {at};
  while (std::ssize(path) < count) {
    for (int k = 0; k < steps; ++k) {
      const Relative middle{at.position + step / 2 * at.velocity,
                            at.velocity + step / 2 * acceleration(at)};
      at = {at.position + step * middle.velocity, at.velocity + step * acceleration(middle)};
    }
    path.push_back(at);
  }
  return path;
}

Relative after_hard_rule(const Relative& at, double restitution) {
  const Vec2 normal = at.position.normalized();
  return {at.position, at.velocity - (1 + restitution) * normal.dot(at.velocity) * normal};
}

std::string centre_column(const std::string& method, const char* axis, const char* sphere) {
  return method + "_" + axis + "_" + sphere;
}

Figure paths_figure(const std::string& heading, const std::string& method,
                    const std::vector<Figure::Disk>& outlines) {
  Figure figure{.kind = Figure::Kind::paths,
                .heading = heading,
                .x_symbol = "x",
                .y_symbol = "y",
                .outlines = outlines};
  for (const auto& [of, label] : {std::pair(std::string("integrated"), std::string("integrated")),
                                  {method, method + " spheres"}})
    for (const char* sphere : {"1", "2"})
      figure.curves.push_back(
          {centre_column(of, "x", sphere), centre_column(of, "y", sphere), label});
  return figure;
}

}  // namespace

FigurePage coefficient_maps(const Impact& impact, const RestitutionTable& table) {
  FigurePage page{"Restitution of two soft spheres",
                  {{coefficients_on_lattice(impact, table)}, {}},
                  {},
                  {},
                  "SI units."};
  for (const auto& [column, symbol] : element_columns)
    page.figures.push_back({.kind = Figure::Kind::map,
                            .heading = symbol,
                            .x_symbol = "impact parameter",
                            .y_symbol = "speed",
                            .curves = {{"impact_parameter", "relative_speed", symbol}},
                            .value = column,
                            .side = 100,
                            .has_logarithmic_y = true});
  return page;
}

FigurePage scaled_maps(ContactParameters::Law law) {
  ContactParameters parameters;
  parameters.law = law;
  const ForceForm form = form_of_law(parameters);
  const bool is_dashpot = law == ContactParameters::Law::linear_dashpot;
  const ScaledAxes& axes = is_dashpot ? dashpot_axes : viscoelastic_axes;
  std::vector<std::vector<double>> rows((1 + dampings) * lattice_size);
  each_in_parallel(rows.size(), all_cores,
                   [&](std::size_t k) { rows[k] = scaled_row(axes, form, static_cast<int>(k)); });
  std::vector<Figure> figures;
  for (int map = 0; map <= dampings; ++map)
    for (const auto& [column, symbol] : element_columns) {
      const std::string damping =
          map == 0 ? "elastic" : fmt::format("{} = {:.4g}", axes.symbol, axes.damping_of(map));
      figures.push_back({.kind = Figure::Kind::map,
                         .heading = fmt::format("{}, {}", symbol, damping),
                         .x_symbol = "ln c_φ/c_φ,min",
                         .y_symbol = "ln l/l_min",
                         .curves = {{"ln_c_phi_over_min", "ln_l_over_min", symbol}},
                         .value = column,
                         .first_row = static_cast<std::size_t>(map) * lattice_size,
                         .side = lattice_side});
    }
  figures.push_back(figures.front());
  figures.back().heading = "ε_φ, elastic, over c_φ and l";
  figures.back().x_symbol = "ln c_φ", figures.back().y_symbol = "ln l";
  figures.back().curves = {{"ln_c_phi", "ln_l", "ε_φ"}};
  const std::string description = fmt::format(
      "Restitution matrix of soft spheres, {} force, in scaled variables: ε_φ (angle), ε_ṙ (rate), "
      "ε_r (distance) and ε_t (duration), of elastic contacts and at five values of {}.",
      is_dashpot ? "linear dashpot" : "viscoelastic", axes.symbol);
  return {"Matrix of restitution",
          {{table_of_rows("scaled_restitution", description,
                          {{axes.column, "1"},
                           {"ln_c_phi_over_min", "1"},
                           {"ln_l_over_min", "1"},
                           {"ln_c_phi", "1"},
                           {"ln_l", "1"},
                           {"c_dis", "1"},
                           {"angle", "rad"},
                           {"rate", "1"},
                           {"distance", "1"},
                           {"duration", "1"}},
                          rows)},
           {}},
          figures,
          "",
          "Scaled variables."};
}

FigurePage impact_paths(const Impact& impact) {
  const Restitution restitution = integrated(impact);
  const double sine = impact.impact_parameter, cosine = impact.normal_speed() / impact.speed;
  const Relative first{impact.pair().distance * Vec2(sine, cosine), {0, -impact.speed}};
  const Relative hard = after_hard_rule(first, -restitution.rate);
  const Relative soft = after_contact<2>(first, restitution);
  const double contact_time = restitution.duration * impact.scales().time;
  const double interval = contact_time / (7 * parts_of_seventh);
  constexpr int before = 3 * parts_of_seventh, after = 10 * parts_of_seventh;
  const std::vector<Relative> path = integrated_path(impact, first, interval, after + 1);

  const double mass_ratio = std::pow(impact.second_radius / impact.contact.radius, 3);
  const double share1 = mass_ratio / (1 + mass_ratio), share2 = 1 - share1;
  std::vector<std::vector<double>> rows;
  for (int k = -before; k <= after; ++k) {
    const double time = k * interval, drift = time * impact.speed / 4;
    std::vector<double>& row = rows.emplace_back();
    row = {time, static_cast<double>(k) / parts_of_seventh};
    const auto add = [&](const Relative& way) {
      const Vec2& d = way.position;
      row.insert(row.end(),
                 {drift - share1 * d.x(), -share1 * d.y(), drift + share2 * d.x(), share2 * d.y()});
    };
    const Relative straight = flown(first, time);
    add(k < 0 ? straight : path[static_cast<std::size_t>(k)]);
    add(k < 0 ? straight : flown(hard, time));
    add(k < 0 ? straight : flown(soft, std::max(0.0, time - contact_time)));
  }
  std::vector<std::pair<std::string, std::string>> columns = {{"time", "s"}, {"instant", "1"}};
  for (const char* method : {"integrated", "hard", "soft"})
    for (const char* sphere : {"1", "2"})
      for (const char* axis : {"x", "y"})
        columns.emplace_back(centre_column(method, axis, sphere), "m");
  const Vec2 centre1 = -share1 * first.position, centre2 = share2 * first.position;
  const std::vector<Figure::Disk> spheres = {{centre1.x(), centre1.y(), impact.contact.radius},
                                             {centre2.x(), centre2.y(), impact.second_radius}};
  return {
      "An impact of two soft spheres",
      {{table_of_rows(
           "impact",
           "Centres of two soft spheres that touch at t = 0, at every tenth of a seventh of the "
           "duration of the contact (instant 7 is its end): integrated from the force, by the "
           "instantaneous rule of hard spheres, and by the rule of soft spheres, which turns "
           "them at first contact and is exact from its end on. Dashed: the spheres at first "
           "contact.",
           columns, rows)},
       {}},
      {paths_figure("Instantaneous collision", "hard", spheres),
       paths_figure("Collision of finite duration", "soft", spheres)},
      "",
      "SI units."};
}

}  // namespace vitrel
