#include "analysis/structure/contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/contact/ellipse_gap.h"
#include "core/neighbors/pairs.h"

namespace vitrel {

namespace {

/// Contacts that lie exactly opposite do so up to rounding.
constexpr double half_circle = std::numbers::pi - 1e-9;

/// A contact as one of its two particles sees it.
struct Touch {
  std::size_t other;
  double direction;  // of the outward normal
};

/// Takes rattlers out until there are none.
class Removal {
 public:
  Removal(std::size_t particles, const std::vector<Contact>& contacts)
      : touches_(particles), held_(particles, true) {
    for (const Contact& contact : contacts) {
      const Vec2& n = contact.normal;
      touches_[contact.i].push_back({contact.j, std::atan2(n.y(), n.x())});
      touches_[contact.j].push_back({contact.i, std::atan2(-n.y(), -n.x())});
    }
    for (std::size_t i = 0; i < particles; ++i) doubtful_.push_back(i);
    while (!doubtful_.empty()) judge_next();
  }

  bool holds(std::size_t i) const { return held_[i]; }

 private:
  void judge_next() {
    const std::size_t i = doubtful_.back();
    doubtful_.pop_back();
    if (!held_[i] || widest_opening(i) < half_circle) return;
    held_[i] = false;
    for (const Touch& touch : touches_[i]) doubtful_.push_back(touch.other);
  }

  // The widest angle between neighbouring normals.
  double widest_opening(std::size_t i) const {
    std::vector<double> directions;
    for (const Touch& touch : touches_[i])
      if (held_[touch.other]) directions.push_back(touch.direction);
    if (directions.empty()) return 2 * std::numbers::pi;
    std::sort(directions.begin(), directions.end());
    double widest = directions.front() + 2 * std::numbers::pi - directions.back();
    for (std::size_t k = 1; k < directions.size(); ++k)
      widest = std::max(widest, directions[k] - directions[k - 1]);
    return widest;
  }

  std::vector<std::vector<Touch>> touches_;
  std::vector<bool> held_;
  std::vector<std::size_t> doubtful_;
};

/// Mean diameter of the disks of equal areas.
double mean_diameter(const Configuration2& configuration) {
  double sum = 0;
  for (const Ellipse& shape : configuration.shape) sum += 2 * std::sqrt(shape.a * shape.b);
  return sum / static_cast<double>(configuration.size());
}

}  // namespace

std::vector<Contact> contacts(const Configuration2& configuration, double tolerance) {
  std::vector<Contact> found;
  const double scale = 1 + tolerance / largest_circumradius(configuration);
  for_each_pair(configuration, scale, [&](std::size_t i, std::size_t j, const Vec2& d) {
    const SupportGap surfaces = support_gap(configuration.shape[i], configuration.angle[i],
                                            configuration.shape[j], configuration.angle[j], d);
    if (surfaces.gap < tolerance) found.push_back({i, j, surfaces.normal, surfaces.gap});
  });
  return found;
}

Backbone backbone(const Configuration2& configuration, double tolerance) {
  const std::vector<Contact> all = contacts(configuration, tolerance);
  const Removal removal(configuration.size(), all);
  std::size_t held = 0, rotors = 0;
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    if (!removal.holds(i)) continue;
    ++held;
    if (!configuration.shape[i].is_round()) ++rotors;
  }
  const auto left =
      static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [&](const Contact& contact) {
        return removal.holds(contact.i) && removal.holds(contact.j);
      }));
  const double n = held > 0 ? static_cast<double>(held) : std::numeric_limits<double>::quiet_NaN();
  return {configuration.size() - held, left, 2 * static_cast<double>(left) / n,
          4 + 2 * static_cast<double>(rotors) / n};
}

JammedBackbone jammed_backbone(const Configuration2& configuration, double reduced_pressure) {
  const double diameter = mean_diameter(configuration);
  JammedBackbone result{};
  for (double tolerance = diameter / std::sqrt(reduced_pressure); tolerance <= diameter / 10;
       tolerance *= 2) {
    result = {backbone(configuration, tolerance), tolerance};
    if (2 * result.rattlers < configuration.size()) break;
  }
  return result;
}

}  // namespace vitrel
