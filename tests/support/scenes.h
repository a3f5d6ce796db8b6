#pragma once

#include <cmath>
#include <vector>

#include "core/state/configuration.h"
#include "core/state/observer.h"

/// Scenes and observers that several tests use.
namespace vitrel {

/// The reference ellipse of an aspect ratio: a b = 1.
inline Ellipse of_aspect_ratio(double aspect_ratio) {
  return {std::sqrt(aspect_ratio), 1 / std::sqrt(aspect_ratio)};
}

/// Side × side particles on a square lattice, shapes and masses by `shape_of` and a b.
template <class ShapeOf>
Configuration2 square_lattice(int side, double packing_fraction, double angle, ShapeOf shape_of) {
  Configuration2 c;
  c.resize(static_cast<std::size_t>(side) * side);
  c.species_names = {"A"};
  double area = 0;
  for (std::size_t i = 0; i < c.size(); ++i) {
    c.shape[i] = shape_of(i);
    c.mass[i] = c.shape[i].a * c.shape[i].b;
    c.angle[i] = angle;
    area += c.shape[i].volume();
  }
  const double length = std::sqrt(area / packing_fraction);
  c.box = PeriodicBox<2>(Vec2(length, length));
  for (std::size_t i = 0; i < c.size(); ++i) {
    const std::size_t column = i % side, row = i / side;
    const Vec2 cell(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
    c.position[i] = cell * length / side - Vec2(0.5 * length, 0.5 * length);
  }
  return c;
}

/// Keeps every frame.
class Recorder : public Observer<2> {
 public:
  void observe(const Frame<2>& frame) override {
    frames.push_back(frame.configuration);
    tallies.push_back(frame.tally);
  }
  std::vector<Configuration2> frames;
  std::vector<Tally> tallies;
};

}  // namespace vitrel
