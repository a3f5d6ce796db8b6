#include "workflow/report/pair_figures.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "core/geometry/free_flight.h"
#include "core/parallel.h"

namespace vitrel {
namespace {

using Row = std::vector<double>;
using Columns = std::vector<std::pair<std::string, std::string>>;

Columns own_columns(const Pair<2>&) {
  return {{"d", "1"}, {"psi", "1"}, {"g_1", "1"}, {"g_2", "1"}};
}
Columns own_columns(const Pair<3>&) {
  return {{"eta_1", "1"}, {"eta_2", "1"}, {"eta_3", "1"}, {"eta_4", "1"}, {"eta_5", "1"}};
}

Row own_values(const Pair<2>& pair, double time, const PairGap<2>& at) {
  const auto& [psi, g1, g2] = at.criterion;
  return {unit_circle_distance(pair, time, at.image), psi, g1, g2};
}
Row own_values(const Pair<3>&, double, const PairGap<3>& at) {
  const EllipsoidEta<double>& eta = at.criterion;
  return {eta.eta1, eta.eta2, eta.eta3, eta.eta4, eta.eta5};
}

constexpr const char* common_text =
    "Two bodies in free flight: the gap, of an overlap minus its depth, and the factor of both "
    "sizes at which they touch, √F of Perram and Wertheim; ";
constexpr const char* plane_text =
    "d, the distance of the second ellipse from the first, where that is made the unit circle; and "
    "the contact function Ψ of Vieillard-Baron with G₁ and G₂ (disjoint if Ψ > 0, and G₁ or G₂ is "
    "negative).";
constexpr const char* space_text = "and η₁ … η₅ of Ghossein and Lévesque.";

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
  const Mat2 mapped_axes = to_circle * Eigen::Rotation2Dd(pose2.angle).toRotationMatrix() *
                           Vec2(pair.two.body.a, pair.two.body.b).asDiagonal();
  const Eigen::JacobiSVD<Mat2> mapped(mapped_axes, Eigen::ComputeFullU);
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
  if (closest > 0 && std::isfinite(closest)) return 2 * closest;
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
  each_in_parallel(count, all_cores, [&](std::size_t k) {
    const double time = end * static_cast<double>(k) / static_cast<double>(count - 1);
    const PairGap<Dim> at = gap_at(pair, time);
    rows[k] = {time, at.gap, at.touching_scale};
    std::ranges::copy(own_values(pair, time, at), std::back_inserter(rows[k]));
  });
  Columns columns = {{"time", "time"}, {"gap", "length"}, {"touching_scale", "1"}};
  std::ranges::copy(own_columns(pair), std::back_inserter(columns));
  const Table path = table_of_rows(
      "path", std::string(common_text) + (Dim == 2 ? plane_text : space_text), columns, rows);

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
