#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/io/foreign/foreign_frame.h"

/// @file
/// The formats of other programs that vitrel reads. Each format has its own source file and a line in
/// `foreign_formats`.
namespace vitrel {

/// The frames of a file, read one after the other.
class ForeignFrames {
 public:
  virtual ~ForeignFrames() = default;
  /// Reads the next frame. Returns false after the last. Throws FileError, which names the place, if the file is
  /// damaged.
  virtual bool next(ForeignFrame& frame) = 0;
  /// The units that the file states; they are complete once a frame was read.
  virtual FileUnits units() const { return {}; }
};

/// The names of what a file may lack, as the format calls it.
struct FormatWords {
  const char* box;
  const char* plane;          ///< how the format says that particles lie in a plane
  const char* sizes;          ///< semi-axes or radii
  const char* box_crossings;  ///< the words after "it has no" in messages
};

struct ForeignFormat {
  const char* name;
  FormatWords words;
  /// Returns whether a file that begins with these bytes has this format.
  bool (*recognises)(std::string_view start);
  /// Opens a file. Throws FileError.
  std::unique_ptr<ForeignFrames> (*open)(const std::filesystem::path& path, const ImportOptions&);
};

/// H5MD 1.0 and 1.1 of other programs, in two or three dimensions. These elements of the group of particles are read:
/// position, image, orientation (quaternions w, x, y, z), angle (radians), velocity, angular_velocity, semiaxes,
/// radius, mass, species, id and box/edges, and also the attributes `boundary` and `dimension` of box and `unit` of
/// all. Each element is the same in all frames, as a dataset, or has the steps of `position`. Units of length must
/// agree.
extern const ForeignFormat h5md_format;

/// GSD in the schema of HOOMD-blue (https://gsd.readthedocs.io), file layers 1 and 2. These chunks are read: for
/// particles, N, types, typeid, type_shapes ("Sphere", "Disk" and "Ellipsoid"), diameter, position, orientation, image,
/// mass, moment_inertia, velocity and angmom; configuration/step, dimensions and box; log/time; and
/// log/particles/semiaxes, which vitrel writes for species of several shapes (version 0.2 wrote the types "A#1", "A#2"
/// instead). What a frame lacks is taken from the first frame, or else is the default of the schema. Diameters, steps,
/// and images that no frame after the first has are exceptions: they are unknown. Most numbers are in single precision.
extern const ForeignFormat gsd_format;

/// Extended XYZ, frame after frame: the number of particles; keys (Lattice, Origin, Properties, pbc, Time, Step or
/// Timestep); a line per particle. These Properties are read: species or type, pos, id, map_shift (box crossings),
/// angle, orientation (quaternions x, y, z, w), aspherical_shape (semi-axes), radius, mass or masses, velo, vel or
/// velocities, and omega. Without Properties, the file is plain XYZ: species, x, y, z. The box begins at Origin, or
/// else at 0.
extern const ForeignFormat xyz_format;

/// Dumps of LAMMPS in text, of styles atom and custom, with a cuboid as box. These columns are read: id, type or
/// element, one of x, xs, xu and xsu, ix, vx, mass, radius or diameter, shapex (a whole axis), quatw, omegax, the
/// further components of each, and what `[[import.columns]]` adds.
extern const ForeignFormat lammps_dump_format;

/// Data files of LAMMPS, which hold a single frame. The line "Atoms # style" names the atom style, which may be atomic,
/// charge, bond, angle, molecular, full, sphere or ellipsoid. The files do not say along which directions the box is
/// periodic.
extern const ForeignFormat lammps_data_format;

/// A table of particles in CSV, with commas or tabs: a line of names, each perhaps followed by a unit in brackets ("x
/// [length]"), and a line per particle (particle_table.h). Consecutive lines with the same `frame`, or else the same
/// `time`, are a frame; without such a column the whole file is one frame. Empty lines and lines that start with # are
/// skipped.
extern const ForeignFormat csv_format;

std::span<const ForeignFormat* const> foreign_formats();

/// Returns "H5MD, GSD, … or CSV".
std::string foreign_format_names();

/// Returns the format that the options name, or that recognises the content of the file. Throws FileError if no format
/// does, and UserError if the options name an unknown one.
const ForeignFormat& format_of(const std::filesystem::path& path, const ImportOptions& options);

}  // namespace vitrel
