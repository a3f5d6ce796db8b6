#pragma once

#include <cmath>

#include "bench/surveys/stability_suite.h"
#include "core/geometry/free_flight.h"
#include "core/random/stream.h"

/// @file
/// How the cases of a class are drawn.
namespace vitrel::bench {

/// The end of the horizon of most cases.
inline constexpr double usual_horizon = 2;

inline double sign(Stream& draw) {
  return draw.uniform() < 0.5 ? -1 : 1;
}
inline double log_uniform(Stream& draw, double low, double high) {
  return low * std::pow(high / low, draw.uniform());
}
/// Of either sign.
inline double signed_log_uniform(Stream& draw, double low, double high) {
  const double of_sign = sign(draw);
  return of_sign * log_uniform(draw, low, high);
}

/// kT = 1 and mass 1.
inline Vec3 thermal_vector(Stream& draw) {
  const double x = draw.normal(), y = draw.normal();
  return {x, y, draw.normal()};
}
inline Vec3 any_direction(Stream& draw) {
  return thermal_vector(draw).normalized();
}
inline Quaternion any_orientation(Stream& draw) {
  const Vec3 v = thermal_vector(draw);
  return Quaternion(draw.normal(), v.x(), v.y(), v.z()).normalized();
}

/// A body of unit a b c.
inline Ellipsoid any_shape(Stream& draw, double kappa) {
  const double kind = draw.uniform();
  const double middle = kind < 0.25 ? 1 : kind < 0.5 ? kappa : log_uniform(draw, 1, kappa);
  return {Vec3(kappa, middle, 1) / std::cbrt(kappa * middle)};
}

/// FNV-1a, so that a class keeps its cases whatever classes stand beside it.
template <int Dim>
std::uint64_t key_of(const CaseClassOf<Dim>& of) {
  std::uint64_t key = 0xcbf29ce484222325U;
  for (const char c : of.name + std::to_string(of.aspect_ratio)) {
    key ^= static_cast<unsigned char>(c);
    key *= 0x100000001b3U;
  }
  return key;
}

template <int Dim>
using Maker = CollisionCaseOf<Dim> (*)(Stream&, double kappa);

/// The list of classes, class by class at all its aspect ratios.
template <int Dim>
class DrawnClasses {
 public:
  void add(const char* name, const char* meaning, Maker<Dim> make,
           std::initializer_list<double> aspect_ratios) {
    for (const double kappa : aspect_ratios) {
      CaseClassOf<Dim> of{name, meaning, kappa, {}};
      of.make = [make, kappa, key = key_of(of)](std::uint64_t seed, std::uint64_t index) {
        Stream draw(seed, Purpose::benchmark_cases, key, index);
        return make(draw, kappa);
      };
      list_.push_back(of);
    }
  }
  const std::vector<CaseClassOf<Dim>>& list() const { return list_; }

 private:
  std::vector<CaseClassOf<Dim>> list_;
};

/// Lets what stands at time 0 happen at `time` instead.
template <int Dim>
void happen_at(CollisionCaseOf<Dim>& pair, double time) {
  for (Flight<GrowingBody<Dim>>* flight : {&pair.one, &pair.two})
    flight->pose = advanced(flight->pose, flight->motion, -time);
}

/// Lets both bodies grow or shrink, three in ten from a point.
template <int Dim>
void let_grow(Stream& draw, CollisionCaseOf<Dim>& pair) {
  for (GrowingBody<Dim>* body : {&pair.one.body, &pair.two.body}) {
    const bool from_a_point = draw.uniform() < 0.3;
    body->size = from_a_point ? 0 : 1;
    body->growth_rate = from_a_point ? draw.uniform(0.1, 0.6) : draw.uniform(-0.4, 0.4);
  }
}

}  // namespace vitrel::bench
