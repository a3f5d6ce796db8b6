#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/state/configuration.h"

/// @file
/// Configurations as files of other programs, or people, state them.
namespace vitrel {

/// One configuration in the box centred at the origin. What is not stated is empty; every other vector has an entry per
/// particle. In the plane third components mean nothing, and those of positions must be 0 to single precision.
struct ForeignFrame {
  std::optional<int> dimension;
  std::optional<double> time;
  std::optional<std::int64_t> step;
  std::optional<Vec3> box;  ///< edge lengths

  std::vector<Vec3> position;  ///< anywhere
  std::vector<Vec3> unwrapped;
  std::vector<Shift<3>> image;
  std::vector<double> angle;            ///< of the first semi-axis, radians; in the plane only
  std::vector<Quaternion> orientation;  ///< from the axes of the body to those of space
  std::vector<Vec3> semi_axes;
  std::vector<double> mass;
  std::vector<Vec3> velocity, angular_velocity;  ///< both in the axes of space
  std::vector<std::string> species;
};

/// In the plane the first semi-axis is the longer one: exchanges those for which it is not, and turns their particles
/// by π/2. Whether there were any.
bool put_longer_axis_first(ForeignFrame& frame);

/// A species by its name; with semi-axes and mass where all its particles have the same.
struct KnownSpecies {
  std::string name;
  std::optional<Vec3> semi_axes = {};
  std::optional<double> mass = {};
};

/// What is known beforehand, and used where a frame does not state it.
struct KnownSystem {
  std::optional<int> dimension;
  std::optional<Vec3> box;
  std::vector<KnownSpecies> species;
  bool unwrap_nearest =
      false;  ///< box crossings that no frame states are those of the nearest images
};

/// A quaternion as it is, or normalised if it is a unit quaternion in single precision only. UserError, which names the
/// particle, if it is neither.
Quaternion unit_quaternion(const Quaternion& q, std::size_t particle);

/// The dimension of the frame, or the one known, or, with neither, three.
int dimension_of(const ForeignFrame& frame, const KnownSystem& known);

/// The configuration that the frame describes. Where nothing says otherwise, particles are of one species "A", at rest,
/// and have the natural mass (core/state/species.h). Species are numbered as they are known, others follow in alphabetical order.
/// UserError, which says what is missing or wrong and of which particle.
template <int Dim>
Configuration<Dim> configuration_of(const ForeignFrame& frame, const KnownSystem& known);

/// The frames of a file, one after the other.
class ForeignFrames {
 public:
  virtual ~ForeignFrames() = default;
  /// False after the last. FileError, which names the place, if the file is damaged.
  virtual bool next(ForeignFrame& frame) = 0;
  /// What the file would have to state box crossings, in the words of the format, after "it has no".
  virtual const char* box_crossings() const = 0;
};

}  // namespace vitrel
