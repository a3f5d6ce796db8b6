#include "workflow/pair/impact_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/special_values.h"
#include "edmd/soft/restitution_table.h"

namespace vitrel {
namespace {

constexpr const char* si_units = "SI units.";

struct Coefficient {
  const char *column, *symbol;
  double Restitution::*of;
};
/// In the order of the source's figures.
constexpr Coefficient matrix_elements[] = {{"angle", "ε_φ", &Restitution::angle},
                                           {"rate", "ε_ṙ", &Restitution::rate},
                                           {"distance", "ε_r", &Restitution::distance},
                                           {"duration", "ε_t", &Restitution::duration}};

// --- maps of all materials ------------------------------------------------------------------------

/// Of g, m and, by the law, of ln c_dis or c.
struct ScaledRanges {
  ValueRange g, m, damping;
};

ScaledRanges ranges_of(ContactParameters::Law law) {
  constexpr ValueRange eccentricities{-4.605120, 1.948493};  // ln(e/√(1 − e²))
  if (law == ContactParameters::Law::linear_dashpot)
    return {eccentricities, {-2.3, 14.83}, {-12.47, 4.00}};
  return {eccentricities, {0.75, 13.66}, {-18.71, 9.84}};
}

constexpr int lattice_side = 41, dampings = 5;

double at_step(const ValueRange& range, int step, int steps) {
  return range.low + (range.high - range.low) * step / (steps - 1);
}

struct ScaledPoint {
  double damping, g, m;  ///< damping −∞: elastic
};

std::vector<ScaledPoint> lattice_points(const ScaledRanges& ranges) {
  std::vector<ScaledPoint> points;
  for (int row = 0; row <= dampings; ++row)
    for (int j = 0; j < lattice_side; ++j)
      for (int i = 0; i < lattice_side; ++i)
        points.push_back({row == 0 ? -infinity : at_step(ranges.damping, row - 1, dampings),
                          at_step(ranges.g, i, lattice_side), at_step(ranges.m, j, lattice_side)});
  return points;
}

ScaledImpact impact_at(const ScaledPoint& at, const ForceForm& form, bool is_relative) {
  const double tangent = std::exp(at.g), oblique = std::log1p(tangent * tangent);
  const double size = at.m + form.length_exponent * oblique;
  const double damping = is_relative ? at.damping + size - 0.5 * oblique : at.damping;
  const double distance = std::exp(size);
  return {distance, distance * tangent, std::exp(damping)};
}

std::vector<Figure> figures_of(const std::string& damping_symbol, const ScaledRanges& ranges) {
  std::vector<Figure> figures;
  for (int row = 0; row <= dampings; ++row)
    for (const auto& [column, symbol, of] : matrix_elements) {
      const std::string which = row == 0 ? "elastic"
                                         : fmt::format("{} = {:.4g}", damping_symbol,
                                                       at_step(ranges.damping, row - 1, dampings));
      figures.push_back({.kind = Figure::Kind::map,
                         .heading = fmt::format("{}, {}", symbol, which),
                         .x_symbol = "ln c_φ/c_φ,min",
                         .y_symbol = "ln l/l_min",
                         .curves = {{"ln_c_phi_over_min", "ln_l_over_min", symbol}},
                         .value = column,
                         .first_row = static_cast<std::size_t>(row) * lattice_side * lattice_side,
                         .side = lattice_side});
    }
  Figure figure3 = figures.front();
  figure3.heading = "ε_φ, elastic, over c_φ and l";
  figure3.x_symbol = "ln c_φ", figure3.y_symbol = "ln l";
  figure3.curves = {{"ln_c_phi", "ln_l", "ε_φ"}};
  figures.push_back(figure3);
  return figures;
}

// --- paths of one impact --------------------------------------------------------------------------

using Relative = RelativeMotion<2>;

Relative flown(const Relative& from, double time) {
  return {from.position + time * from.velocity, from.velocity};
}

/// A step of the classical Runge–Kutta method.
Relative runge_kutta(const Relative& x, double step, const auto& acceleration) {
  const auto later = [&](const Relative& slope, double time) -> Relative {
    return {x.position + time * slope.position, x.velocity + time * slope.velocity};
  };
  const auto slope = [&](const Relative& at) -> Relative {
    return {at.velocity, acceleration(at)};
  };
  const Relative a = slope(x), b = slope(later(a, step / 2)), c = slope(later(b, step / 2)),
                 d = slope(later(c, step));
  return {x.position + step / 6 * (a.position + 2 * b.position + 2 * c.position + d.position),
          x.velocity + step / 6 * (a.velocity + 2 * b.velocity + 2 * c.velocity + d.velocity)};
}

constexpr int sevenths = 7, parts_of_seventh = 10;  // of the contact, and of a seventh

/// At every part of a seventh from first contact on.
std::vector<Relative> integrated_path(const Impact& impact, Relative at, double interval,
                                      int count) {
  constexpr int steps = 1000;
  const ContactPair pair = impact.pair();
  const auto acceleration = [&](const Relative& x) -> Vec2 {
    const double distance = x.position.norm(), compression = pair.distance - distance;
    if (compression < -1e-12 * pair.distance) return Vec2::Zero();
    const Vec2 normal = x.position / distance;
    const double force =
        contact_force(impact.contact, pair, std::max(0.0, compression), -normal.dot(x.velocity));
    return std::max(0.0, force) / pair.mass * normal;
  };
  std::vector<Relative> path = {at};
  while (std::ssize(path) < count) {
    for (int k = 0; k < steps; ++k) at = runge_kutta(at, interval / steps, acceleration);
    path.push_back(at);
  }
  return path;
}

Relative after_hard_rule(const Relative& at, double restitution) {
  const Vec2 normal = at.position.normalized();
  return {at.position, at.velocity - (1 + restitution) * normal.dot(at.velocity) * normal};
}

/// At first contact, particle 2 above.
Relative touching(const Impact& impact) {
  const double sine = impact.impact_parameter, cosine = impact.normal_speed() / impact.speed;
  return {impact.pair().distance * Vec2(sine, cosine), {0, -impact.speed}};
}

constexpr const char* path_methods[] = {"integrated", "hard", "soft"};

Table empty_paths() {
  Table table{
      "impact",
      "Centres of two soft spheres that touch at t = 0, at every tenth of a seventh of the "
      "duration of the contact (instant 7 is its end): integrated from the force, by the "
      "instantaneous rule of hard spheres, and by the rule of soft spheres, which turns "
      "them at first contact and is exact from its end on. Dashed: the spheres at first contact.",
      {{"time", "s", {}, {}}, {"instant", "1", {}, {}}}};
  for (const char* method : path_methods)
    for (const char* sphere : {"1", "2"})
      for (const char* axis : {"x", "y"})
        table.columns.push_back({fmt::format("{}_{}_{}", method, axis, sphere), "m", {}, {}});
  return table;
}

Figure paths_figure(const std::string& heading,
                    const std::vector<std::pair<const char*, const char*>>& shown) {
  Figure figure{.kind = Figure::Kind::paths, .heading = heading, .x_symbol = "x", .y_symbol = "y"};
  for (const auto& [method, label] : shown)
    for (const char* sphere : {"1", "2"})
      figure.curves.push_back(
          {fmt::format("{}_x_{}", method, sphere), fmt::format("{}_y_{}", method, sphere), label});
  return figure;
}

}  // namespace

FigurePage coefficient_maps(const Impact& impact, const RestitutionTable& table) {
  FigurePage page{"Restitution of two soft spheres",
                  {{coefficients_on_lattice(impact, table)}, {}},
                  {},
                  {},
                  si_units};
  for (const auto& [column, symbol, of] : matrix_elements)
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
  const bool is_relative = law == ContactParameters::Law::viscoelastic;
  ContactParameters parameters;
  parameters.law = law;
  const ForceForm form = form_of_law(parameters);
  const ScaledRanges ranges = ranges_of(law);
  const std::vector<ScaledPoint> points = lattice_points(ranges);
  std::vector<Restitution> found(points.size());
  in_parallel(points.size(), all_cores, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      found[k] = form.integrate(impact_at(points[k], form, is_relative));
  });

  const std::string damping = is_relative ? "ln c_dis/c_dis,min" : "ln c_dis";
  Table table{"scaled_restitution",
              fmt::format("Restitution matrix of soft spheres, {} force, in scaled variables: ε_φ "
                          "(angle), ε_ṙ (rate), ε_r (distance) and ε_t (duration), for elastic "
                          "contacts and at five values of {}.",
                          is_relative ? "viscoelastic" : "linear dashpot", damping),
              {}};
  for (const char* name : {is_relative ? "ln_c_dis_over_min" : "ln_c_dis", "ln_c_phi_over_min",
                           "ln_l_over_min", "ln_c_phi", "ln_l", "c_dis"})
    table.columns.push_back({name, "1", {}, {}});
  for (const auto& [column, symbol, of] : matrix_elements)
    table.columns.push_back({column, of == &Restitution::angle ? "rad" : "1", {}, {}});
  ScaledRanges shown = ranges;
  if (is_relative) shown.damping = {0, ranges.damping.high - ranges.damping.low};
  for (std::size_t k = 0; k < points.size(); ++k) {
    const ScaledImpact impact = impact_at(points[k], form, is_relative);
    const double row[] = {points[k].damping - (is_relative ? ranges.damping.low : 0),
                          points[k].g - ranges.g.low,
                          points[k].m - ranges.m.low,
                          std::log(impact.angular_momentum),
                          std::log(impact.distance),
                          impact.damping,
                          found[k].angle,
                          found[k].rate,
                          found[k].distance,
                          found[k].duration};
    for (std::size_t c = 0; c < std::size(row); ++c) table.columns[c].value.push_back(row[c]);
  }
  return {"Matrix of restitution",
          {{table}, {}},
          figures_of(damping, shown),
          "",
          "Variables are scaled (docs: Müller and Pöschel 2013)."};
}

FigurePage impact_paths(const Impact& impact) {
  const Restitution restitution = integrated(impact);
  const Relative first = touching(impact);
  const Relative hard = after_hard_rule(first, -restitution.rate);
  const Relative soft = after_contact<2>(first, restitution);
  const double contact_time = restitution.duration * impact.scales().time;
  const double interval = contact_time / (sevenths * parts_of_seventh);
  constexpr int before = 3 * parts_of_seventh, after = 10 * parts_of_seventh;
  const std::vector<Relative> path = integrated_path(impact, first, interval, after + 1);

  const double mass_ratio = std::pow(impact.second_radius / impact.contact.radius, 3);
  const double share1 = mass_ratio / (1 + mass_ratio), share2 = 1 - share1;
  const Vec2 drift(impact.speed / 4, 0);
  Table table = empty_paths();
  for (int k = -before; k <= after; ++k) {
    const double time = k * interval;
    const Relative still{soft.position, Vec2::Zero()};
    const Relative ways[] = {k < 0 ? flown(first, time) : path[static_cast<std::size_t>(k)],
                             flown(k < 0 ? first : hard, time),
                             k < 0                             ? flown(first, time)
                             : k < sevenths * parts_of_seventh ? still
                                                               : flown(soft, time - contact_time)};
    std::vector<double> row = {time, static_cast<double>(k) / parts_of_seventh};
    for (const Relative& way : ways) {
      const Vec2 one = time * drift - share1 * way.position,
                 two = time * drift + share2 * way.position;
      row.insert(row.end(), {one.x(), one.y(), two.x(), two.y()});
    }
    for (std::size_t c = 0; c < row.size(); ++c) table.columns[c].value.push_back(row[c]);
  }
  FigurePage page{"An impact of two soft spheres",
                  {{table}, {}},
                  {paths_figure("Instantaneous collision",
                                {{"integrated", "integrated"}, {"hard", "hard spheres"}}),
                   paths_figure("Collision of finite duration",
                                {{"integrated", "integrated"}, {"soft", "soft spheres"}})},
                  {},
                  si_units};
  const Vec2 centre1 = -share1 * first.position, centre2 = share2 * first.position;
  for (Figure& figure : page.figures)
    figure.outlines = {{centre1.x(), centre1.y(), impact.contact.radius},
                       {centre2.x(), centre2.y(), impact.second_radius}};
  return page;
}

}  // namespace vitrel
