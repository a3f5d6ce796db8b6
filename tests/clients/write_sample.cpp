#include <cmath>
#include <cstdint>
#include <string>

#include "core/io/h5md.h"

/// Writes a trajectory whose every number follows from the particle i and the frame k by a formula:
/// write_sample <path> <kind>. The scripts beside repeat that of the binary one.
namespace {

using namespace vitrel;

Configuration2 binary(int k) {
  Configuration2 configuration;
  configuration.box = PeriodicBox<2>(Vec2(20 + k, 10));
  configuration.time = 0.25 * k;
  configuration.resize(7);
  configuration.species_names = {"long", "round"};
  for (int i = 0; i < 7; ++i) {
    configuration.position[i] = {i - 3.0 + 0.125 * k, 0.5 * i - 2};
    configuration.image[i] = {k - i, i};
    configuration.angle[i] = 0.5 * i - 3.0 * k;
    configuration.velocity[i] = {0.25 * i, -0.5 * k};
    configuration.angular_velocity[i] = i + 0.125 * k;
    configuration.species[i] = i % 2;
    configuration.shape[i] = i % 2 ? Ellipse{1, 1} : Ellipse{2, 0.5};
    configuration.mass[i] = i % 2 ? 1.5 : 1;
  }
  return configuration;
}

/// Equal ellipses.
Configuration2 monodisperse(int k) {
  Configuration2 configuration = binary(k);
  configuration.species_names = {"A"};
  configuration.species.assign(7, 0);
  configuration.shape.assign(7, Ellipse{2, 0.5});
  configuration.mass.assign(7, 1);
  return configuration;
}

/// Each particle of its own shape but the last two, in three species; no number is exact in single
/// precision, and some particles are as close to the edges of the box as can be.
Configuration2 polydisperse(int k) {
  Configuration2 configuration = binary(k);
  const Vec2 box(7.1 + 0.1 * k, 13.3);
  configuration.box = PeriodicBox<2>(box);
  configuration.species_names = {"A small", "say \"B\", large", "A small#2"};
  for (int i = 0; i < 7; ++i) {
    const double x = i % 2 ? std::nextafter(0.5 * box.x(), 0) : -0.5 * box.x();
    configuration.position[i] = {i < 4 ? x : 0.1 * i, -0.5 * box.y() + 1.9 * i};
    configuration.species[i] = i < 4 ? 0 : i == 4 ? 1 : 2;
    configuration.shape[i] = i < 5 ? Ellipse{1.1 + 0.1 * i, 0.7} : Ellipse{2.3, 0.3};
    configuration.mass[i] = 0.1 * (i + 1);
    configuration.velocity[i] = {0.1 * i, -0.3 * k};
    configuration.angular_velocity[i] = 0.7 - 0.1 * i;
  }
  configuration.position[6].y() = std::nextafter(0.5 * box.y(), 0);
  return configuration;
}

/// The same in space: spheroids about each of their axes, a scalene ellipsoid, and spheres, of which two are of
/// one type.
Configuration3 ellipsoids(int k) {
  Configuration3 configuration;
  const Vec3 box(7.1 + 0.1 * k, 13.3, 9.7);
  const Vec3 axes[] = {{2.1, 0.7, 0.7}, {0.6, 1.1, 0.6}, {0.9, 0.9, 0.4}, {1.3, 0.8, 0.6},
                       {0.8, 0.8, 0.8}, {0.8, 0.8, 0.8}, {0.8, 0.8, 0.8}};
  configuration.box = PeriodicBox<3>(box);
  configuration.time = 0.3 * k;
  configuration.resize(7);
  configuration.species_names = {"A small", "say \"B\", large", "A small#2"};
  for (int i = 0; i < 7; ++i) {
    const double x = i % 2 ? std::nextafter(0.5 * box.x(), 0) : -0.5 * box.x();
    configuration.position[i] = {i < 4 ? x : 0.1 * i, -0.5 * box.y() + 1.9 * i, 0.7 * i - 0.1 * k};
    configuration.image[i] = {k - i, i, -k};
    configuration.orientation[i] =
        Quaternion(Eigen::AngleAxisd(0.7 * i + 0.2 * k + 0.3, Vec3(1, i, 2).normalized()));
    configuration.velocity[i] = {0.1 * i, -0.3 * k, 0.7 - 0.1 * i};
    configuration.angular_velocity[i] = {0.7 - 0.1 * i, 0.3 * k, -0.9};
    configuration.species[i] = i < 4 ? 0 : i == 4 ? 1 : 2;
    configuration.shape[i] = {axes[i]};
    configuration.mass[i] = 0.1 * (i + 1);
  }
  configuration.position[6].z() = std::nextafter(0.5 * box.z(), 0);
  return configuration;
}

/// Equal spheres.
Configuration3 spheres(int k) {
  Configuration3 configuration = ellipsoids(k);
  configuration.species_names = {"A"};
  configuration.species.assign(7, 0);
  configuration.shape.assign(7, {Vec3::Constant(0.7)});
  configuration.mass.assign(7, 1);
  return configuration;
}

/// Four frames.
template <int Dim>
void write(const std::string& path, Configuration<Dim> sample(int), bool velocities) {
  const Provenance provenance = current_provenance("write_sample", "[system]\nseed = 3\n", 3);
  auto writer = TrajectoryWriter::create(
      path, sample(0), provenance,
      {.velocities = velocities, .observables = {"collisions"}, .overwrite = true});
  for (int k = 0; k < 4; ++k)
    writer.write(sample(k), std::int64_t{10} * k, {{"collisions", 100.0 * k}});
  writer.close();
}

}  // namespace

int main(int, char** arguments) {
  const std::string path = arguments[1], kind = arguments[2];
  if (kind == "binary") write(path, binary, true);
  if (kind == "monodisperse") write(path, monodisperse, false);
  if (kind == "polydisperse") write(path, polydisperse, true);
  if (kind == "ellipsoids") write(path, ellipsoids, true);
  if (kind == "spheres") write(path, spheres, false);
}
