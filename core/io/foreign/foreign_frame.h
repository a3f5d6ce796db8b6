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
/// Configurations as files of other programs, or people, state them.
namespace vitrel {

/// One configuration in the box centred at the origin. What is not stated is empty; every other vector has an entry per
/// particle. In the plane third components mean nothing, and those of positions must be the same to single precision.
struct ForeignFrame {
  std::optional<int> dimension;
  std::optional<double> time;
  std::optional<std::int64_t> step;
  std::optional<Vec3> box;  ///< edge lengths

  std::vector<double> id;      ///< ascending, as all else
  std::vector<Vec3> position;  ///< anywhere
  std::vector<Vec3> unwrapped;
  std::vector<Shift<3>> image;
  std::vector<double> angle;            ///< of the first semi-axis, radians; in the plane only
  std::vector<Quaternion> orientation;  ///< from the axes of the body to those of space
  std::vector<Vec3> half_lengths;       ///< along the axes of the body
  std::vector<double> mass;
  std::vector<Vec3> velocity, angular_velocity;  ///< both in the axes of space
  std::vector<std::string> species;

  std::map<std::string, std::string>
      assumed;  ///< what is absent, and what the format puts in its place
  std::set<std::string>
      skipped;  ///< what is there and means nothing to vitrel, as the format calls it
};

/// The work, whose UserError becomes a FileError that says where in the file it arose.
template <class Work>
auto with_place(const std::string& place, Work&& work) {
  try {
    return work();
  } catch (const UserError& error) {
    throw FileError(fmt::format("{}: {}", place, error.what()));
  }
}

/// Whether a box that is periodic along these directions only can be one of vitrel's: in the plane, the third does not matter.
/// UserError, which begins with `statement`, what the file says, if it is not periodic along x or y. Returns the dimension
/// that follows, if one does.
std::optional<int> dimension_of_boundaries(const std::array<bool, 3>& periodic,
                                           const std::string& statement);

/// What lengths and times are counted in, as labels call it: "µm", "s", "steps"; "" where a file does not say.
struct FileUnits {
  std::string length, time;
};

/// The units that a file states, with what has them; "" where it states none.
struct StatedUnits {
  using Named = std::pair<std::string, std::string>;  ///< name, unit
  std::vector<Named> lengths, angles, velocities;
  std::string time;
};

/// UserError if lengths have different units, velocities another than that of lengths and times, or angles another than
/// radians. Units as UDUNITS-2 knows them, or texts that are the same. Returns those of lengths and times.
FileUnits require_agreement(const StatedUnits& units);

/// In the plane the first semi-axis is the longer one: exchanges those for which it is not, and turns their particles
/// by π/2. Whether there were any.
bool put_longer_axis_first(ForeignFrame& frame);

/// A species by its name; with semi-axes and mass where all its particles have the same.
struct KnownSpecies {
  std::string name;
  std::optional<Vec3> half_lengths = {};
  std::optional<double> mass = {};
};

/// What the user says about a file of another program (`[import]`).
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
      format;                        ///< the name of one of foreign_formats.h; otherwise by content
  std::optional<std::string> group;  ///< of the particles in H5MD
  std::optional<int> dimension;
  std::optional<std::vector<double>> box;
  std::vector<Kind> species;            ///< in the units of the file
  std::optional<double> time_per_step;  ///< in the unit of time of the results
  double length_unit = 1;               ///< of the results, in that of the file
  Unwrap unwrap = Unwrap::stated;       ///< box crossings that no frame states
  Angles angles = Angles::turns;        ///< directors are known up to half turns
  std::vector<Column> columns;          ///< of tables, and what they mean
};

/// What is known beforehand, and used where a frame does not state it.
struct KnownSystem {
  std::optional<int> dimension;
  std::optional<Vec3> box;
  std::vector<KnownSpecies> species;
  ImportOptions import = {};
};

/// A quaternion as it is, or normalised if it is a unit quaternion in single precision only. UserError, which names the
/// particle, if it is neither.
Quaternion unit_quaternion(const Quaternion& q, std::size_t particle);

/// The dimension of the frame, or the one known, or two if particles have an angle, and otherwise three. UserError if all
/// particles have the same z and the box is lower than two of them: then it may be either. `plane` is how the format
/// says that it is two.
int dimension_of(const ForeignFrame& frame, const KnownSystem& known, const std::string& plane);

/// The configuration that the frame describes. Where nothing says otherwise, particles are of one species "A", at rest,
/// and have the natural mass (core/state/species.h). Species are numbered as they are known, others follow in alphabetical order.
/// UserError, which says what is missing or wrong and of which particle.
template <int Dim>
Configuration<Dim> configuration_of(const ForeignFrame& frame, const KnownSystem& known);

}  // namespace vitrel
