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

/// Cells × cells × cells cubic cells of this lattice, with a particle of that shape at each point of the
/// basis (in units of the side of a cell); masses 1.
inline Configuration3 cubic_lattice(int cells, const std::vector<Vec3>& basis,
                                    double packing_fraction, const Ellipsoid& shape) {
  Configuration3 c;
  c.resize(basis.size() * static_cast<std::size_t>(cells * cells * cells));
  c.species_names = {"A"};
  c.shape.assign(c.size(), shape);
  const double side =
      std::cbrt(shape.volume() * static_cast<double>(basis.size()) / packing_fraction);
  c.box = PeriodicBox<3>(Vec3::Constant(cells * side));
  std::size_t i = 0;
  for (int x = 0; x < cells; ++x)
    for (int y = 0; y < cells; ++y)
      for (int z = 0; z < cells; ++z)
        for (const Vec3& point : basis)
          c.position[i++] = side * (Vec3(x, y, z) + point) - 0.5 * c.box.lengths();
  return c;
}

inline const std::vector<Vec3> simple_cubic = {{0.5, 0.5, 0.5}};
inline const std::vector<Vec3> face_centred_cubic = {
    {0.25, 0.25, 0.25}, {0.75, 0.75, 0.25}, {0.75, 0.25, 0.75}, {0.25, 0.75, 0.75}};

/// Keeps every frame.
template <int Dim>
class FrameRecorder : public Observer<Dim> {
 public:
  void observe(const Frame<Dim>& frame) override {
    frames.push_back(frame.configuration);
    tallies.push_back(frame.tally);
  }
  std::vector<Configuration<Dim>> frames;
  std::vector<Tally> tallies;
};
using Recorder = FrameRecorder<2>;

}  // namespace vitrel
