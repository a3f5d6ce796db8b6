#include "edmd/hard_fluid.h"

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace vitrel {
namespace {

constexpr double pi = std::numbers::pi;

/// Returns unit vectors spread evenly over a half circle or half sphere, in the axes of the body.
template <int Dim>
std::vector<Vec<Dim>> directions() {
  constexpr int count = Dim == 2 ? 64 : 256;
  constexpr double golden_angle = 2.399963229728653;
  std::vector<Vec<Dim>> result;
  for (int k = 0; k < count; ++k) {
    const double place = (k + 0.5) / count;
    if constexpr (Dim == 2) {
      result.push_back(direction(pi * place));
    } else {
      const Vec2 across = std::sqrt(1 - place * place) * direction(golden_angle * k);
      result.emplace_back(across.x(), across.y(), place);
    }
  }
  return result;
}

/// Returns ℓ²/I of a contact at the surface point with normal n.
double lever_term(double inertia, const Vec2& point, const Vec2& n) {
  const double lever = point.x() * n.y() - point.y() * n.x();
  return lever * lever / inertia;
}
double lever_term(const Vec3& inertia, const Vec3& point, const Vec3& n) {
  return sum(point.cross(n).cwiseAbs2().cwiseQuotient(inertia));
}

/// Returns a term whose mean over all n is the perimeter or the surface: 2π times the support function of an ellipse,
/// or 4 times the projected area of an ellipsoid along n.
double boundary_term(const Vec2& axes, const Vec2& n) {
  return 2 * pi * norm(axes.cwiseProduct(n));
}
double boundary_term(const Vec3& axes, const Vec3& n) {
  return 4 * pi * norm(prod(axes) * n.cwiseQuotient(axes));
}

}  // namespace

void HardFluid::Averages::add(const Averages& other, double weight) {
  support += weight * other.support;
  boundary += weight * other.boundary;
  size += weight * other.size;
  inverse_mass += weight * other.inverse_mass;
  squared_support += weight * other.squared_support;
}

template <int Dim>
HardFluid::Averages HardFluid::averages_of(const Configuration<Dim>& c, std::size_t i) {
  static const std::vector<Vec<Dim>> normals = directions<Dim>();
  const bool is_round = c.shape[i].is_round();  // all directions are then equivalent
  const std::span<const Vec<Dim>> seen = std::span(normals).first(is_round ? 1 : normals.size());
  const Vec<Dim> axes = c.shape[i].half_lengths();
  const auto inertia = c.inertia(i);
  const double weight = 1.0 / static_cast<double>(seen.size());
  Averages one;
  for (const Vec<Dim>& n : seen) {
    const double h = norm(axes.cwiseProduct(n));
    const Vec<Dim> point = axes.cwiseAbs2().cwiseProduct(n) / h;
    one.support += weight * h;
    one.boundary += weight * boundary_term(axes, n);
    one.inverse_mass += weight * (1 / c.mass[i] + (is_round ? 0 : lever_term(inertia, point, n)));
  }
  one.size = Dim == 2 ? pi * prod(axes) : 4 * pi / 3 * prod(axes);
  one.squared_support = one.support * one.support;
  return one;
}

template <int Dim>
HardFluid::HardFluid(const Configuration<Dim>& some)
    : dimension_(Dim), is_round_(rotor_count(some) == 0) {
  for (std::size_t i = 0; i < some.size(); ++i)
    mean_.add(averages_of(some, i), 1.0 / static_cast<double>(some.size()));
}

double HardFluid::compressibility_factor(double phi) const {
  const double free = 1 - phi;
  if (dimension_ == 2)
    return 1 / free + mean_.boundary * mean_.boundary / (4 * pi * mean_.size) * phi / (free * free);
  const double ratio = mean_.boundary / mean_.size;
  return 1 / free + mean_.support * ratio * phi / (free * free) +
         mean_.squared_support * ratio * ratio / 3 * phi * phi / (free * free * free);
}

double HardFluid::collision_rate(double phi) const {
  const double impulse = std::sqrt(2 * pi / (2 * mean_.inverse_mass));
  return (compressibility_factor(phi) - 1) * dimension_ / (impulse * 2 * mean_.support);
}

template HardFluid::HardFluid(const Configuration2&);
template HardFluid::HardFluid(const Configuration3&);

}  // namespace vitrel
