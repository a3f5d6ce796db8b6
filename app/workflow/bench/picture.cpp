#include "app/workflow/bench/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "app/workflow/bench/svg.h"
#include "core/contact/ellipse_vieillard_baron.h"
#include "core/contact/perram_wertheim.h"

namespace vitrel {
namespace {

using lab::CollisionCase;
using lab::FailingCase;
using lab::Verdict;
using TruthOutcome = lab::TrueContact::Outcome;

constexpr int panel = 260, gutter = 16, header = 48;
constexpr const char* colour_one = "#1f78c8";
constexpr const char* colour_two = "#d9822b";
constexpr const char* colour_overlap = "#c8374d";

struct Placed {
  Ellipse body;
  Vec2 position;
  double angle;
};

Placed placed(const Flight<GrowingEllipse>& flight, double time) {
  const Pose2 pose = advanced(flight.pose, flight.motion, time);
  return {flight.body.at(time), pose.position, pose.angle};
}

struct Moment {
  std::string title;
  double time;
  bool magnified = false;  // a small overlap, close up
};

bool overlap(const Placed& one, const Placed& two) {
  if (one.body.b <= 0 || two.body.b <= 0) return false;
  const Vec2 d = two.position - one.position;
  return !vieillard_baron(one.body, one.angle, two.body, two.angle, d).disjoint_or_touching();
}

/// How deep two overlapping ellipses are in each other: −(n·d − h₁ − h₂) along the common normal n of
/// the ellipses scaled by μ to touch, where n·d = μ (h₁ + h₂).
double depth(const Placed& one, const Placed& two) {
  const Vec2 d = two.position - one.position;
  const PerramWertheim<2> scaled = perram_wertheim(one.body, one.angle, two.body, two.angle, d);
  return scaled.normal.dot(d) * (1 / std::sqrt(scaled.value) - 1);
}

/// Where both ellipses must shrink most to come apart, among the times of the overlap that starts
/// at `from`, up to `to`. Sampled evenly in the logarithm of the time since, since a grazing overlap
/// lasts a tiny part of the horizon.
double deepest_overlap(const CollisionCase& asked, double from, double to) {
  constexpr int samples = 6000;
  constexpr double decades = 12;
  double deepest = from, largest = 0;
  for (int k = 0; k <= samples; ++k) {
    const double time = from + (to - from) * std::pow(10, decades * (k - samples) / samples);
    const Placed one = placed(asked.one, time), two = placed(asked.two, time);
    if (overlap(one, two)) {
      const double deep = depth(one, two);
      if (deep > largest) largest = deep, deepest = time;
    } else if (largest > 1e-13 * (one.body.a + two.body.a)) {
      break;  // not if rounding still hides the overlap
    }
  }
  return deepest;
}

bool has_contact(const FailingCase& failure) {
  return failure.truth.outcome == TruthOutcome::contact ||
         failure.truth.outcome == TruthOutcome::undecided;
}

/// The deepest overlap that a late or missing answer overlooks.
double overlooked_time(const FailingCase& failure) {
  const double from = has_contact(failure) ? static_cast<double>(failure.truth.time) : 0;
  const bool late = failure.judgement.verdict == Verdict::late;
  return deepest_overlap(failure.asked, from, late ? failure.answer.time : failure.asked.horizon);
}

bool overlooks_overlap(const FailingCase& failure) {
  const Verdict verdict = failure.judgement.verdict;
  return verdict == Verdict::late || verdict == Verdict::missed;
}

/// Curvature of the surface where its normal is n: h³/(a²b²), h the support function.
double curvature(const Placed& one, const Vec2& n) {
  const Vec2 major(std::cos(one.angle), std::sin(one.angle));
  const double h = std::hypot(one.body.a * major.dot(n), one.body.b * cross(major, n));
  return h * h * h / (one.body.a * one.body.a * one.body.b * one.body.b);
}

/// The length of the lens in which two ellipses overlap, about 2 √(2 depth/(sum of curvatures)).
double lens_size(const Placed& one, const Placed& two) {
  const Vec2 d = two.position - one.position;
  const Vec2 n = perram_wertheim(one.body, one.angle, two.body, two.angle, d).normal;
  return 2 * std::sqrt(2 * depth(one, two) / (curvature(one, n) + curvature(two, n)));
}

/// Too small to be seen beside whole ellipses, large enough for the arithmetic of a browser.
bool deserves_close_up(const CollisionCase& asked, double time) {
  const Placed one = placed(asked.one, time), two = placed(asked.two, time);
  if (!overlap(one, two)) return false;
  const double part = lens_size(one, two) / std::min(one.body.a, two.body.a);
  return part > 1e-3 && part < 0.25;
}

std::vector<Moment> moments(const FailingCase& failure) {
  std::vector<Moment> shown = {{"start", 0}};
  const auto truth = static_cast<double>(failure.truth.time);
  if (has_contact(failure)) shown.push_back({"true contact", truth});
  if (overlooks_overlap(failure)) {
    const double time = overlooked_time(failure);
    if (failure.answer.outcome != Outcome::contact || time < failure.answer.time)
      shown.push_back({failure.answer.outcome == Outcome::contact ? "deepest overlap before"
                                                                  : "deepest overlap",
                       time});
  }
  if (failure.answer.outcome == Outcome::contact)
    shown.push_back({"contact reported", failure.answer.time});
  std::ranges::stable_sort(shown, {}, &Moment::time);
  if (overlooks_overlap(failure) && deserves_close_up(failure.asked, overlooked_time(failure)))
    shown.push_back({"deepest overlap, magnified", overlooked_time(failure), true});
  return shown;
}

/// Maps lengths to the pixels of a panel, y upwards.
class View {
 public:
  View(const Placed& one, const Placed& two, bool magnified) {
    const Placed& small = one.body.a < two.body.a ? one : two;
    const double reach = std::max(small.body.a, 1e-300);
    if (magnified) {
      const Vec2 d = two.position - one.position;
      middle_ = one.position + perram_wertheim(one.body, one.angle, two.body, two.angle, d).point;
      half_ = 0.8 * lens_size(one, two);
    } else if (std::max(one.body.a, two.body.a) > 12 * reach) {
      middle_ = small.position;
      half_ = 3 * reach;
    } else {
      const Vec2 a(one.body.a, one.body.a), b(two.body.a, two.body.a);
      const Vec2 low = (one.position - a).cwiseMin(two.position - b);
      const Vec2 high = (one.position + a).cwiseMax(two.position + b);
      middle_ = 0.5 * (low + high);
      half_ = 0.54 * (high - low).maxCoeff();
    }
  }

  Vec2 pixel(const Vec2& position) const {
    const Vec2 r = (position - middle_) / half_;
    return {0.5 * panel * (1 + r.x()), 0.5 * panel * (1 - r.y())};
  }
  double pixels(double length) const { return 0.5 * panel * length / half_; }

  std::string ellipse(const Placed& body, const std::string& paint) const {
    const Vec2 centre = pixel(body.position);
    const double degrees = -body.angle * 180 / std::numbers::pi;
    return fmt::format(
        "<ellipse rx=\"{:.3f}\" ry=\"{:.3f}\" transform=\"translate({:.3f} {:.3f}) "
        "rotate({:.4f})\"{}/>",
        pixels(body.body.a), pixels(body.body.b), centre.x(), centre.y(),
        std::remainder(degrees, 360), paint);
  }

 private:
  Vec2 middle_;
  double half_ = 1;
};

std::string outline(const char* colour) {
  return fmt::format(" fill=\"{0}\" fill-opacity=\"0.16\" stroke=\"{0}\" stroke-width=\"1.6\"",
                     colour);
}

/// Which way the second body comes, as the first one sees it.
std::string arrow(const View& view, const CollisionCase& asked) {
  const Vec2 v = asked.two.motion.velocity - asked.one.motion.velocity;
  if (v.norm() == 0) return "";
  const Vec2 from = view.pixel(asked.two.pose.position);
  const Vec2 way = Vec2(v.x(), -v.y()).normalized(), side = perpendicular(way);
  const Vec2 tip = from + 44 * way, neck = from + 34 * way;
  const Vec2 left = neck + 5 * side, right = neck - 5 * side;
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"{} stroke-width=\"1.6\"/>"
      "<polygon points=\"{:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f}\"{}/>",
      from.x(), from.y(), neck.x(), neck.y(), stroke(Tone::ink), tip.x(), tip.y(), left.x(),
      left.y(), right.x(), right.y(), fill(Tone::ink));
}

std::string draw(const CollisionCase& asked, const Moment& moment, const std::string& name) {
  const Placed one = placed(asked.one, moment.time), two = placed(asked.two, moment.time);
  const View view(one, two, moment.magnified);
  std::string text =
      view.ellipse(one, outline(colour_one)) + view.ellipse(two, outline(colour_two)) + "\n";
  if (overlap(one, two))
    text += fmt::format(
        "<clipPath id=\"{0}\">{1}</clipPath><g clip-path=\"url(#{0})\">{2}</g>\n", name,
        view.ellipse(one, ""),
        view.ellipse(two, fmt::format(" fill=\"{}\" fill-opacity=\"0.75\"", colour_overlap)));
  if (moment.time == 0) text += arrow(view, asked);
  return text;
}

std::string overlap_text(const CollisionCase& asked, double time, const char* words) {
  const Placed one = placed(asked.one, time), two = placed(asked.two, time);
  if (!overlap(one, two)) return "";
  return fmt::format("{} {:.2g} semi-minor axes", words, depth(one, two) / asked.gap_unit());
}

}  // namespace

std::string failure_svg(const FailingCase& failure) {
  const std::vector<Moment> shown = moments(failure);
  const int count = static_cast<int>(shown.size());
  const int width = count * (panel + gutter) + gutter;
  std::string text =
      svg_opening(width, panel + header + gutter, failure.method + ": " + failure_caption(failure));
  for (int k = 0; k < count; ++k) {
    const Moment& moment = shown[static_cast<std::size_t>(k)];
    const int x = gutter + k * (panel + gutter);
    text += svg_text(x, 20, moment.title);
    text += svg_text(x, 38, fmt::format("t = {:.9g}", moment.time), Anchor::start, Tone::quiet, 12);
    text += fmt::format(
        "<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" overflow=\"hidden\">\n"
        "<rect width=\"{}\" height=\"{}\"{} stroke-width=\"2\"/>\n{}</svg>\n",
        x, header, panel, panel, panel, panel, fill_and_stroke(Tone::ground, Tone::grid),
        draw(failure.asked, moment, fmt::format("overlap_{}_{}", failure.method, k)));
  }
  return text + "</svg>\n";
}

std::string failure_caption(const FailingCase& failure) {
  const CollisionCase& asked = failure.asked;
  const double off = std::abs(failure.answer.time - static_cast<double>(failure.truth.time));
  switch (failure.judgement.verdict) {
    case Verdict::late:
      return fmt::format("reports the contact {:.3g} too late{}", off,
                         overlap_text(asked, overlooked_time(failure),
                                      "; until then the ellipses overlap by up to"));
    case Verdict::early:
      return fmt::format("reports a contact {:.3g} too early", off);
    case Verdict::missed:
      return fmt::format(
          "{}{}",
          has_contact(failure)
              ? fmt::format("reports no contact up to the horizon, t = {:.4g}", asked.horizon)
              : std::string("does not notice that the pair overlaps at the start"),
          overlap_text(asked, overlooked_time(failure), ", but the ellipses overlap by up to"));
    case Verdict::false_contact:
      return "reports a contact of a pair that never touches";
    case Verdict::not_converged:
      return "finds no answer";
    case Verdict::correct:
      break;
  }
  return "answers correctly";
}

}  // namespace vitrel
