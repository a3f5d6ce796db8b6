#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "analysis/structure/packing_images.h"
#include "workflow/export/frame_sink.h"

/// @file
/// One period of a packing of ellipsoids in the formats of mesh generators, solvers on grids and viewers.
/// All of them get the bodies that meet the box, images included; the box is centred at the origin.
/// Throws FileError.
namespace vitrel {

struct Packing {
  Configuration3 configuration;
  std::vector<BodyInBox> bodies;  ///< the bodies that meet its box

  /// All semi-axes times `shrink`, which leaves room between bodies that touch.
  Packing(Configuration3 state, double shrink);

  Vec3 centre(const BodyInBox& body) const;
};

/// A Gmsh script for its OpenCASCADE kernel: the bodies cut by the box, the matrix around them, opposite
/// faces meshed alike. The box is moved by clean_cut; the script says by how much. Physical volumes: "matrix",
/// and "inclusions A" for a species A. Physical surfaces: "xmin" … "zmax". The mesh size h is half the
/// shortest semi-axis, or chosen by `gmsh -3 packing.geo -setnumber h 0.2`.
void write_geo(const std::filesystem::path& path, const Packing& packing);

/// VTK image data (.vti), `voxels` along the longest edge and cubic up to rounding; cell data "particle":
/// the number of the particle, from 0, that holds the centre of the voxel, −1 in the matrix.
void write_vti(const std::filesystem::path& path, const Packing& packing, std::size_t voxels);

/// VTK poly data (.vtp), a point for every body. Point data: "particle", "species", "image" (3, the shift),
/// "semi-axes" (3), "orientation" (quaternion w, x, y, z), "tensor" (R diag(a, b, c) Rᵀ: tensor glyphs of
/// a sphere of radius 1 are the bodies), and "velocity" and "angular velocity" (3) if they are stored.
void write_vtp(const std::filesystem::path& path, const Packing& packing, StoredMotion motion);

/// A trajectory as a ParaView series in a folder that exists: `frame_0007.vtp` for the frame of index 7, and
/// `<name>.pvd`, which lists them with their times and is written last.
class VtpSeries final : public FrameSink<3> {
 public:
  /// `shrink` as of Packing.
  VtpSeries(std::filesystem::path folder, std::string name, double shrink, StoredMotion motion)
      : folder_(std::move(folder)), name_(std::move(name)), shrink_(shrink), motion_(motion) {}
  void write(const StoredFrame<3>& frame) override;
  void close() override;

 private:
  std::filesystem::path folder_;
  std::string name_;
  double shrink_;
  StoredMotion motion_;
  std::string datasets_;  ///< a line of the .pvd file per frame
};

/// A table with a line for every body, after one line of `name [unit]`, every number with the digits, 17 at
/// most, that give the same double back:
///
///     particle, species                from 0; the name
///     image_x, image_y, image_z        centre = position of the particle + image ∘ box
///     x, y, z                          centre
///     a, b, c                          semi-axes along the own x, y and z axes
///     qw, qx, qy, qz                   quaternion that turns the own axes into those of space
///     box_x, box_y, box_z
void write_packing_csv(const std::filesystem::path& path, const Packing& packing);

}  // namespace vitrel
