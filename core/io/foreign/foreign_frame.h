#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/state/configuration.h"

/// @file
/// Configurations as files of other programs or users state them.
namespace vitrel {

/// One configuration in the box centred at the origin. A quantity that is not stated is empty; every other vector has
/// one entry per particle. In the plane, third components mean nothing, and those of positions must be the same to
/// single precision.
struct ForeignFrame {
  std::optional<int> dimension;
  std::optional<double> time;
  std::optional<std::int64_t> step;
  std::optional<Vec3> box;  ///< edge lengths

  std::vector<double> id;      ///< in ascending order, which all other vectors follow
  std::vector<Vec3> position;  ///< need not be in the box
  std::vector<Vec3> unwrapped;
  std::vector<Shift<3>> image;
  std::vector<double> angle;  ///< angle of the first semi-axis, radians; in the plane only
  std::vector<Quaternion> orientation;  ///< from the axes of the body to those of space
  std::vector<Vec3> half_lengths;       ///< along the axes of the body
  std::vector<double> mass;
  std::vector<Vec3> velocity, angular_velocity;  ///< both in the axes of space
  std::vector<std::string> species;

  std::map<std::string, std::string>
      assumed;  ///< maps what is absent to what the format puts in its place
  std::set<std::string>
      skipped;  ///< what the file has but vitrel does not use, as the format calls it
};

/// Returns the result of `work`, whose UserError becomes a FileError that says where in the file it arose.
template <class Work>
auto with_place(const std::string& place, Work&& work) {
  try {
    return work();
  } catch (const UserError& error) {
    throw FileError(fmt::format("{}: {}", place, error.what()));
  }
}

/// Checks a box that is periodic along these directions only. Throws UserError if it is not periodic along x or y; the
/// message begins with `statement`, which is what the file says. The third direction does not matter in the plane.
/// Returns the dimension that follows, if one does.
std::optional<int> dimension_of_boundaries(const std::array<bool, 3>& periodic,
                                           const std::string& statement);

/// The units of lengths and times as labels call them: "µm", "s", "steps"; "" if a file does not say.
struct FileUnits {
  std::string length, time;
};

/// The units that a file states, with the names of the quantities; "" if it states none.
struct StatedUnits {
  using Named = std::pair<std::string, std::string>;  ///< name, unit
  std::vector<Named> lengths, angles, velocities;
  std::string time;
};

/// Throws UserError if lengths have different units, velocities have a unit other than that of lengths and times, or
/// angles one other than radians. Units of lengths are compared as texts, the others also as UDUNITS-2 knows them.
/// Returns the units of lengths and times.
FileUnits require_agreement(const StatedUnits& units);

/// In the plane the first semi-axis is the longer one: this exchanges the semi-axes for which it is not, and turns
/// their particles by π/2. Returns whether there were any.
bool put_longer_axis_first(ForeignFrame& frame);

/// A species by its name, with semi-axes and mass if all its particles have the same.
struct KnownSpecies {
  std::string name;
  std::optional<Vec3> half_lengths = {};
  std::optional<double> mass = {};
};

/// What the user states about a file of another program (`[import]`).
struct ImportOptions {
  enum class Unwrap { stated, nearest };
  enum class Angles { turns, directors };
  struct Kind {
    std::string name = "A";
    std::optional<double> diameter;
    std::optional<std::vector<double>> semi_axes;
    std::optional<double> mass;
  };
  struct Column {
    std::string file, meaning;
  };

  std::optional<std::string>
      format;  ///< the name of a format of foreign_formats.h; otherwise, the content decides
  std::optional<std::string> group;  ///< the group of particles in H5MD
  std::optional<int> dimension;
  std::optional<std::vector<double>> box;
  std::vector<Kind> species;            ///< lengths and masses in the units of the file
  std::optional<double> time_per_step;  ///< time per step in the unit of time of the results
  double length_unit = 1;               ///< unit of length of the results, in that of the file
  Unwrap unwrap = Unwrap::stated;       ///< how to find box crossings that no frame states
  Angles angles = Angles::turns;        ///< directors are known up to half turns
  std::vector<Column> columns;          ///< columns of tables, and what they mean
};

/// What is known beforehand about a system, and used where a frame does not state it.
struct KnownSystem {
  std::optional<int> dimension;
  std::optional<Vec3> box;
  std::vector<KnownSpecies> species;
  ImportOptions import = {};
};

/// Returns a unit quaternion as it is, or normalised if its norm is 1 to single precision only. Throws UserError, which
/// names the particle, for other quaternions.
Quaternion unit_quaternion(const Quaternion& q, std::size_t particle);

/// Returns the dimension of the frame, or the known one; otherwise, two if particles have an angle, and three if not.
/// Throws UserError if all particles have the same z and the box is lower than two of them, so that it may be either.
/// `plane` is how the format says that the dimension is two.
int dimension_of(const ForeignFrame& frame, const KnownSystem& known, const std::string& plane);

/// Returns the configuration that the frame describes. Where nothing says otherwise, particles are of one species "A",
/// at rest, and have the natural mass (core/state/species.h). Species have the order in which they are known; others
/// follow in alphabetical order. Throws UserError, which says what is missing or wrong and for which particle.
template <int Dim>
Configuration<Dim> configuration_of(const ForeignFrame& frame, const KnownSystem& known);

}  // namespace vitrel
