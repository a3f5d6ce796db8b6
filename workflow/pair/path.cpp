#include "workflow/pair/path.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "core/geometry/free_flight.h"
#include "core/parallel.h"

namespace vitrel {
namespace {

using Row = std::vector<double>;

void add_own_values(const Pair<2>& pair, double time, const PairGap<2>& at, Row& row) {
  const auto& [psi, g1, g2] = at.criterion;
  row.insert(row.end(), {unit_circle_distance(pair, time, at.image), psi, g1, g2});
}

void add_own_values(const Pair<3>&, double, const PairGap<3>& at, Row& row) {
  const EllipsoidEta<double>& eta = at.criterion;
  row.insert(row.end(), {eta.eta1, eta.eta2, eta.eta3, eta.eta4, eta.eta5});
}

Table empty_table(int dimension) {
  std::vector<Column> columns = {
      {"time", "time", {}, {}}, {"gap", "length", {}, {}}, {"touching_scale", "1", {}, {}}};
  const std::vector<std::string> own =
      dimension == 2 ? std::vector<std::string>{"d", "psi", "g_1", "g_2"}
                     : std::vector<std::string>{"eta_1", "eta_2", "eta_3", "eta_4", "eta_5"};
  for (const std::string& name : own) columns.push_back({name, "1", {}, {}});
  return {"path",
          std::string("Two bodies in free flight: the gap, of an overlap minus its depth, and the "
                      "factor of both sizes at which they touch, √F of Perram and Wertheim; ") +
              (dimension == 2
                   ? "d, the distance of the second ellipse from the first, where that is made the "
                     "unit circle; and the contact function Ψ of Vieillard-Baron with G₁ and G₂ "
                     "(disjoint if Ψ > 0, and G₁ or G₂ is negative)."
                   : "and η₁ … η₅ of Ghossein and Lévesque."),
          columns};
}

Figure curves(const std::string& heading, const std::string& symbol,
              const std::vector<std::pair<std::string, std::string>>& columns) {
  Figure figure{.heading = heading, .x_symbol = "t", .y_symbol = symbol, .shows_zero = true};
  for (const auto& [name, label] : columns) figure.curves.push_back({"time", name, label});
  return figure;
}

std::vector<Figure> figures_of(int dimension) {
  const Figure gap = curves("Gap of the surfaces", "gap", {{"gap", "gap"}});
  if (dimension == 2)
    return {curves("Distance from the unit circle", "d(t)", {{"d", "d"}}),
            curves("Contact function", "Ψ(t)", {{"psi", "Ψ"}}), gap,
            curves("Sign condition", "G₁, G₂", {{"g_1", "G₁"}, {"g_2", "G₂"}})};
  return {gap, curves("Discriminant of the characteristic polynomial", "η₁(t)", {{"eta_1", "η₁"}}),
          curves("Subdiscriminants", "η₂, η₅", {{"eta_2", "η₂"}, {"eta_5", "η₅"}}),
          curves("Further signs", "η₃, η₄", {{"eta_3", "η₃"}, {"eta_4", "η₄"}})};
}

}  // namespace

double unit_circle_distance(const Pair<2>& pair, double time, const Shift<2>& image) {
  const Pose2 pose1 = pose_at(pair.one, time), pose2 = pose_at(pair.two, time);
  Vec2 d = pose2.position - pose1.position;
  if (pair.box) d += pair.box->translation(image);
  const Mat2 to_circle = Vec2(1 / pair.one.body.a, 1 / pair.one.body.b).asDiagonal() *
                         Eigen::Rotation2Dd(-pose1.angle).toRotationMatrix();
  const Mat2 semi_axes = to_circle * Eigen::Rotation2Dd(pose2.angle).toRotationMatrix() *
                         Vec2(pair.two.body.a, pair.two.body.b).asDiagonal();
  const Eigen::JacobiSVD<Mat2> mapped(semi_axes, Eigen::ComputeFullU);
  const Vec2 lengths = mapped.singularValues(), axis = mapped.matrixU().col(0);
  Pair<2> circle_and_ellipse = {{{1, 1}, {}, {}}, {{lengths[0], lengths[1]}, {}, {}}, std::nullopt};
  circle_and_ellipse.two.pose = {to_circle * d, std::atan2(axis.y(), axis.x())};
  return gap_at(circle_and_ellipse, 0).gap;
}

template <int Dim>
double usual_end(const Pair<Dim>& pair) {
  Vec<Dim> d = pair.two.pose.position - pair.one.pose.position;
  if (pair.box) d += pair.box->translation(first_contact(pair).image);
  const Vec<Dim> v = pair.two.motion.velocity - pair.one.motion.velocity;
  const double touch = pair.one.body.circumradius() + pair.two.body.circumradius();
  const double speed = v.norm(), closest = -d.dot(v) / (speed * speed);
  const double half_chord =
      std::sqrt(std::max(0.0, touch * touch - (d + closest * v).squaredNorm())) / speed;
  if (half_chord > 0 && closest + half_chord > 0) return closest + half_chord;
  if (closest > 0) return 2 * closest;
  const auto turns = [](const auto& motion) {
    if constexpr (Dim == 2)
      return std::abs(motion.angular_velocity);
    else
      return motion.angular_velocity.norm();
  };
  const double fastest = std::max(turns(pair.one.motion), turns(pair.two.motion));
  return fastest > 0 ? 2 * std::numbers::pi / fastest : 1;
}

template <int Dim>
FigurePage path_of_pair(const Pair<Dim>& pair, double end, int points) {
  const auto count = static_cast<std::size_t>(points);
  std::vector<Row> rows(count);
  in_parallel(count, all_cores, [&](std::size_t begin, std::size_t behind) {
    for (std::size_t k = begin; k < behind; ++k) {
      const double time = end * static_cast<double>(k) / static_cast<double>(count - 1);
      const PairGap<Dim> at = gap_at(pair, time);
      rows[k] = {time, at.gap, at.touching_scale};
      add_own_values(pair, time, at, rows[k]);
    }
  });
  Table path = empty_table(Dim);
  for (const Row& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) path.columns[k].value.push_back(row[k]);

  Pair<Dim> until_end = pair;
  until_end.horizon = end;
  const Prediction<Dim> contact = first_contact(until_end).prediction;
  Table first{"first_contact", "When the bodies first touch.", {{"time", "time", {}, {}}}};
  std::vector<Figure> figures = figures_of(Dim);
  if (contact.outcome == Outcome::contact) {
    first.columns[0].value = {contact.time};
    for (Figure& figure : figures)
      figure.mark = {contact.time, fmt::format("first contact, t = {:.5g}", contact.time)};
  }
  return {"Two bodies in free flight",
          {{path, first}, {}},
          figures,
          "",
          "Lengths and times are in the units of the bodies."};
}

template double usual_end(const Pair<2>&);
template double usual_end(const Pair<3>&);
template FigurePage path_of_pair(const Pair<2>&, double, int);
template FigurePage path_of_pair(const Pair<3>&, double, int);

}  // namespace vitrel
