#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "analysis/structure/packing_images.h"
#include "workflow/export/frame_sink.h"

/// @file
/// One period of a packing of ellipsoids in the formats of mesh generators, grid solvers and viewers. All formats
/// contain the bodies that meet the box, including images. The box is centred at the origin. Functions throw
/// FileError.
namespace vitrel {

struct Packing {
  Configuration3 configuration;
  std::vector<BodyInBox> bodies;  ///< the bodies that meet its box

  /// Multiplies all semi-axes by `shrink`, which leaves room between bodies that touch.
  Packing(Configuration3 state, double shrink);

  Vec3 centre(const BodyInBox& body) const;
};

/// Writes a Gmsh script for its OpenCASCADE kernel: the bodies cut by the box, and the matrix around them, with
/// identical meshes on opposite faces. The box is moved by clean_cut, and the script states the displacement. The
/// physical volumes are "matrix" and, for a species A, "inclusions A"; the physical surfaces are "xmin" … "zmax". The
/// mesh size h is half the shortest semi-axis unless `gmsh -3 packing.geo -setnumber h 0.2` sets it.
void write_geo(const std::filesystem::path& path, const Packing& packing);

/// Writes VTK image data (.vti) with `voxels` voxels along the longest edge, which are cubic up to rounding. The cell
/// data "particle" is the number of the particle, from 0, that contains the centre of the voxel, and −1 in the
/// matrix.
void write_vti(const std::filesystem::path& path, const Packing& packing, std::size_t voxels);

/// Writes VTK poly data (.vtp) with a point for every body. The point data are "particle", "species", "image" (the 3
/// components of the shift), "semi-axes" (3), "orientation" (quaternion w, x, y, z), "tensor" (R diag(a, b, c) Rᵀ,
/// for which tensor glyphs of a sphere of radius 1 are the bodies) and, if they are stored, "velocity" and "angular
/// velocity" (3 each).
void write_vtp(const std::filesystem::path& path, const Packing& packing, StoredMotion motion);

/// A trajectory as a ParaView series in a folder that exists: `frame_0007.vtp` for the frame of index 7, and
/// `<name>.pvd`, which lists the frames with their times and is written last.
class VtpSeries final : public FrameSink<3> {
 public:
  /// `shrink` has the meaning that it has in Packing.
  VtpSeries(std::filesystem::path folder, std::string name, double shrink, StoredMotion motion)
      : folder_(std::move(folder)), name_(std::move(name)), shrink_(shrink), motion_(motion) {}
  void write(const StoredFrame<3>& frame) override;
  void close() override;

 private:
  std::filesystem::path folder_;
  std::string name_;
  double shrink_;
  StoredMotion motion_;
  std::string datasets_;  ///< one line of the .pvd file for each frame
};

/// Writes a table with a line for every body, after one line of `name [unit]`. Every number has as many digits, at
/// most 17, as are needed to read back the same double:
///
///
///     particle, species                from 0; the name
///     image_x, image_y, image_z        centre = position of the particle + image ∘ box
///     x, y, z                          centre
///     a, b, c                          semi-axes along the own x, y and z axes
///     qw, qx, qy, qz                   quaternion that turns the own axes into those of space
///     box_x, box_y, box_z
void write_packing_csv(const std::filesystem::path& path, const Packing& packing);

}  // namespace vitrel
