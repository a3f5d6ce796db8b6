#include "analysis/structure/contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/contact/contact_queries.h"
#include "core/neighbors/pairs.h"

namespace vitrel {

namespace {

/// Directions at a right angle to a normal are so only up to rounding.
constexpr double right_angle = 1e-9;

/// Decides whether no direction away from a particle is more than a right angle from all outward normals at its
/// contacts. If there are such directions, one of them is at a right angle to D − 1 independent normals.
template <int Dim>
class Blockade {
 public:
  explicit Blockade(const std::vector<Vec<Dim>>& normals) : normals_(normals) {}

  bool is_complete() const {
    bool spans = false;
    for (std::size_t k = 0; k < normals_.size(); ++k)
      for (std::size_t l = 0; l < (Dim == 2 ? 1 : k); ++l) {
        const Vec<Dim> v = perpendicular_to(k, l);
        if (!(v.norm() > right_angle)) continue;
        if (is_free(v.normalized()) || is_free(-v.normalized())) return false;
        spans = true;
      }
    return spans;
  }

 private:
  Vec<Dim> perpendicular_to(std::size_t k, [[maybe_unused]] std::size_t l) const {
    if constexpr (Dim == 2)
      return perpendicular(normals_[k]);
    else
      return normals_[k].cross(normals_[l]);
  }

  bool is_free(const Vec<Dim>& v) const {
    return std::ranges::all_of(normals_, [&](const Vec<Dim>& n) { return v.dot(n) < right_angle; });
  }

  const std::vector<Vec<Dim>>& normals_;
};

/// A contact as one of its two particles sees it.
template <int Dim>
struct Touch {
  std::size_t other;
  Vec<Dim> normal;  // outward
};

/// Removes rattlers until there are none.
template <int Dim>
class Removal {
 public:
  Removal(std::size_t particles, const std::vector<Contact<Dim>>& contacts)
      : touches_(particles), held_(particles, true) {
    for (const Contact<Dim>& contact : contacts) {
      touches_[contact.i].push_back({contact.j, contact.normal});
      touches_[contact.j].push_back({contact.i, -contact.normal});
    }
    for (std::size_t i = 0; i < particles; ++i) doubtful_.push_back(i);
    while (!doubtful_.empty()) judge_next();
  }

  bool holds(std::size_t i) const { return held_[i]; }

 private:
  void judge_next() {
    const std::size_t i = doubtful_.back();
    doubtful_.pop_back();
    if (!held_[i] || is_blocked(i)) return;
    held_[i] = false;
    for (const Touch<Dim>& touch : touches_[i]) doubtful_.push_back(touch.other);
  }

  bool is_blocked(std::size_t i) const {
    std::vector<Vec<Dim>> normals;
    for (const Touch<Dim>& touch : touches_[i])
      if (held_[touch.other]) normals.push_back(touch.normal);
    return Blockade<Dim>(normals).is_complete();
  }

  std::vector<std::vector<Touch<Dim>>> touches_;
  std::vector<bool> held_;
  std::vector<std::size_t> doubtful_;
};

/// Returns the mean diameter of the disks (spheres) of equal areas (volumes).
template <int Dim>
double mean_diameter(const Configuration<Dim>& configuration) {
  constexpr double of_unit = Dim == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3;
  double sum = 0;
  for (const ParticleShape<Dim>& shape : configuration.shape)
    sum += 2 * std::pow(shape.volume() / of_unit, 1.0 / Dim);
  return sum / static_cast<double>(configuration.size());
}

}  // namespace

template <int Dim>
std::vector<Contact<Dim>> contacts(const Configuration<Dim>& configuration, double tolerance) {
  std::vector<Contact<Dim>> found;
  const double scale = 1 + tolerance / largest_circumradius(configuration);
  for_each_pair(configuration, scale, [&](std::size_t i, std::size_t j, const Vec<Dim>& d) {
    const auto surfaces = support_gap(configuration.shape[i], configuration.pose(i),
                                      configuration.shape[j], configuration.pose(j), d);
    if (surfaces.gap < tolerance) found.push_back({i, j, surfaces.normal, surfaces.gap});
  });
  return found;
}

template <int Dim>
Backbone backbone(const Configuration<Dim>& configuration, double tolerance) {
  const std::vector<Contact<Dim>> all = contacts(configuration, tolerance);
  const Removal<Dim> removal(configuration.size(), all);
  std::size_t held = 0, freedom = 0;
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    if (!removal.holds(i)) continue;
    ++held;
    freedom += static_cast<std::size_t>(Dim + configuration.shape[i].rotations());
  }
  const auto left =
      static_cast<std::size_t>(std::ranges::count_if(all, [&](const Contact<Dim>& contact) {
        return removal.holds(contact.i) && removal.holds(contact.j);
      }));
  const double n = held > 0 ? static_cast<double>(held) : std::numeric_limits<double>::quiet_NaN();
  return {configuration.size() - held, left, 2 * static_cast<double>(left) / n,
          2 * static_cast<double>(freedom) / n};
}

template <int Dim>
JammedBackbone jammed_backbone(const Configuration<Dim>& configuration, double reduced_pressure) {
  const double diameter = mean_diameter(configuration);
  JammedBackbone result{};
  for (double tolerance = diameter / std::sqrt(reduced_pressure); tolerance <= diameter / 10;
       tolerance *= 2) {
    result = {backbone(configuration, tolerance), tolerance};
    if (2 * result.rattlers < configuration.size()) break;
  }
  return result;
}

template std::vector<Contact<2>> contacts(const Configuration2&, double);
template std::vector<Contact<3>> contacts(const Configuration3&, double);
template Backbone backbone(const Configuration2&, double);
template Backbone backbone(const Configuration3&, double);
template JammedBackbone jammed_backbone(const Configuration2&, double);
template JammedBackbone jammed_backbone(const Configuration3&, double);

}  // namespace vitrel
