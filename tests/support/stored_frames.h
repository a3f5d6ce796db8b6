#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/io/h5md.h"
#include "core/random/stream.h"

/// This header has configurations of arbitrary numbers and trajectories of them, and checks that
/// they come back from a file.
namespace vitrel {

/// Two species, wrapped positions, arbitrary doubles in everything that is stored.
inline Configuration2 random_configuration(std::size_t n, std::uint64_t step) {
  Stream draw(11, Purpose::tests, step);
  Configuration2 c;
  const double scale = std::sqrt(static_cast<double>(n));
  const Vec2 lengths = scale * Vec2{draw.uniform(3, 9), draw.uniform(3, 9)};
  c.box = PeriodicBox<2>(lengths);
  c.time = 0.1 * static_cast<double>(step);
  c.resize(n);
  c.species_names = {"large", "small"};
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 place{draw.uniform(-0.5, 0.5), draw.uniform(-0.5, 0.5)};
    c.position[i] = lengths.cwiseProduct(place);
    c.image[i] = {static_cast<int>(draw.below(9)) - 4, static_cast<int>(draw.below(9)) - 4};
    c.angle[i] = draw.uniform(-40, 40);
    c.velocity[i] = {draw.normal(), draw.normal()};
    c.angular_velocity[i] = draw.normal();
    const double size = i % 2 ? 1 / 1.4 : 1;
    c.shape[i] = {size * std::sqrt(3.0), size / std::sqrt(3.0)};
    c.mass[i] = size * size;
    c.species[i] = i % 2;
  }
  // The doubles next to the faces, where wrapping would round.
  c.position[0] = -0.5 * lengths;
  c.position[1].x() = std::nextafter(0.5 * lengths.x(), 0.0);
  return c;
}

/// The same in three dimensions, scalene and turned.
inline Configuration3 random_solids(std::size_t n, std::uint64_t step) {
  Stream draw(12, Purpose::tests, step);
  const auto normal = [&] { return Vec3{draw.normal(), draw.normal(), draw.normal()}; };
  Configuration3 c;
  c.box = PeriodicBox<3>(Vec3(5, 6, 7) + 0.1 * normal());
  c.time = 0.1 * static_cast<double>(step);
  c.resize(n);
  c.species_names = {"large", "small"};
  for (std::size_t i = 0; i < n; ++i) {
    c.position[i] = normal();
    c.box.wrap(c.position[i], c.image[i]);
    c.image[i] += Shift<3>(2, -1, static_cast<int>(draw.below(9)));
    c.orientation[i].coeffs() << normal(), draw.normal();
    c.orientation[i].normalize();
    c.velocity[i] = normal();
    c.angular_velocity[i] = normal();
    c.shape[i] = {i % 2 ? Vec3(0.3, 1.7, 0.9) : Vec3(2, 1, 0.5)};
    c.mass[i] = i % 2 ? 0.459 : 1;
    c.species[i] = i % 2;
  }
  c.position[0] = -0.5 * c.box.lengths();
  return c;
}

/// Adds this number of close pairs, between images.
template <int Dim>
Configuration<Dim> with_close_pairs(Configuration<Dim> c, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    const Shift<Dim> shift = Shift<Dim>::Unit(static_cast<int>(k) % Dim) * (k % 2 ? 1 : -1);
    c.close_pairs.push_back({{k, k + 1, shift}, 0.1 + static_cast<double>(k)});
  }
  return c;
}

template <class T>
bool same_bits(const std::vector<T>& x, const std::vector<T>& y) {
  if (x.size() != y.size()) return false;
  return x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(T)) == 0;
}

template <int Dim>
void expect_same_bits(const Configuration<Dim>& x, const Configuration<Dim>& y) {
  EXPECT_EQ(x.box.lengths(), y.box.lengths());
  EXPECT_EQ(std::bit_cast<std::uint64_t>(x.time), std::bit_cast<std::uint64_t>(y.time));
  EXPECT_TRUE(same_bits(x.position, y.position));
  EXPECT_TRUE(same_bits(x.image, y.image));
  if constexpr (Dim == 2)
    EXPECT_TRUE(same_bits(x.angle, y.angle));
  else
    EXPECT_TRUE(same_bits(x.orientation, y.orientation));
  EXPECT_TRUE(same_bits(x.velocity, y.velocity));
  EXPECT_TRUE(same_bits(x.angular_velocity, y.angular_velocity));
  EXPECT_TRUE(same_bits(x.shape, y.shape));
  EXPECT_TRUE(same_bits(x.mass, y.mass));
  EXPECT_EQ(x.species, y.species);
  EXPECT_EQ(x.species_names, y.species_names);
}

inline Provenance some_provenance() {
  return current_provenance("vitrel run glass.toml", "[system]\nparticles = 12 # κ\n", 77,
                            "state.h5");
}

inline Observables observables_at(std::uint64_t step) {
  return {{"collisions", 10.0 * static_cast<double>(step)}, {"energy", std::sqrt(step + 2.0)}};
}

/// Creates a trajectory with velocities and observables, and no frame yet.
inline TrajectoryWriter begin_run(const std::filesystem::path& path, std::size_t particles = 12) {
  const TrajectoryOptions with_everything{
      .velocities = true, .observables = {"collisions", "energy"}, .overwrite = false};
  return TrajectoryWriter::create(path, random_configuration(particles, 0), some_provenance(),
                                  with_everything);
}

inline void write_frames(TrajectoryWriter& writer, std::uint64_t first, std::uint64_t end,
                         std::size_t particles = 12) {
  for (std::uint64_t step = first; step < end; ++step)
    writer.write(random_configuration(particles, step), static_cast<std::int64_t>(step),
                 observables_at(step));
}

inline void write_run(const std::filesystem::path& path, std::uint64_t frames) {
  TrajectoryWriter writer = begin_run(path);
  write_frames(writer, 0, frames);
  writer.close();
}

/// Continues the trajectory after `first` frames of it.
inline void continue_run(const std::filesystem::path& path, std::uint64_t first, std::uint64_t end,
                         std::size_t particles = 12) {
  TrajectoryWriter writer = TrajectoryWriter::append_to(path, first);
  EXPECT_EQ(writer.frames(), first);
  write_frames(writer, first, end, particles);
  writer.close();
}

/// Frames 0 … frames − 1 of `path` are those that write_frames writes; the file may hold more.
inline void expect_frames(const std::filesystem::path& path, std::uint64_t frames,
                          std::size_t particles = 12) {
  const TrajectoryReader reader(path);
  ASSERT_GE(reader.frames(), frames);
  for (std::uint64_t k = 0; k < frames; ++k) {
    EXPECT_EQ(reader.steps()[k], static_cast<std::int64_t>(k));
    expect_same_bits(reader.read(k), random_configuration(particles, k));
    EXPECT_EQ(reader.observable("collisions")[k], observables_at(k).at("collisions"));
    EXPECT_EQ(reader.observable("energy")[k], observables_at(k).at("energy"));
  }
}

/// The message of the FileError that `action` throws.
template <class Action>
std::string file_error(Action&& action) {
  try {
    action();
  } catch (const FileError& error) {
    return error.what();
  }
  return "(no FileError)";
}

inline std::string contents(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline void overwrite(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

inline std::string with_a_flipped_bit(std::string bytes, Stream& draw) {
  const auto bit = static_cast<char>(1 << draw.below(8));
  bytes[draw.below(bytes.size())] ^= bit;
  return bytes;
}

}  // namespace vitrel
