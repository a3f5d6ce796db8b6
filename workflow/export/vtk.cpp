#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <span>

#include "core/io/base64.h"
#include "workflow/export/frame_sink.h"
#include "workflow/export/packing.h"

namespace vitrel {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say so");

std::string head(const char* type) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n",
      type);
}

template <class T>
constexpr const char* type_name = nullptr;
template <>
constexpr const char* type_name<double> = "Float64";
template <>
constexpr const char* type_name<std::int32_t> = "Int32";

/// An array with `columns` numbers for each point or cell, in base64: the number of bytes, then the bytes.
template <class T>
std::string data_array(const std::string& name, int columns, const std::vector<T>& values) {
  const std::span<const std::byte> bytes = std::as_bytes(std::span(values));
  std::vector<std::byte> all(sizeof(std::uint64_t));
  const std::uint64_t size = bytes.size();
  std::memcpy(all.data(), &size, sizeof size);
  all.insert(all.end(), bytes.begin(), bytes.end());
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">\n{}\n"
      "</DataArray>\n",
      type_name<T>, name, columns, base64(all));
}

template <class T>
void append(std::vector<T>& row, const auto& vector) {
  row.insert(row.end(), vector.data(), vector.data() + vector.size());
}

/// A grid of voxels that fills the box.
struct Grid {
  Eigen::Array<std::int64_t, 3, 1> count;
  Vec3 origin, step;

  Grid(const PeriodicBox<3>& box, std::size_t voxels) {
    const Vec3& lengths = box.lengths();
    const double width = lengths.maxCoeff() / static_cast<double>(voxels);
    for (int k = 0; k < 3; ++k) {
      count[k] = std::max<std::int64_t>(1, std::llround(lengths[k] / width));
      step[k] = lengths[k] / static_cast<double>(count[k]);
      origin[k] = -0.5 * lengths[k];
    }
  }
  /// The coordinate of the centre of a voxel.
  double coordinate(int k, std::int64_t n) const {
    return origin[k] + (static_cast<double>(n) + 0.5) * step[k];
  }
  /// The voxels whose centres lie between two coordinates: the first, and the one after the last.
  std::pair<std::int64_t, std::int64_t> between(int k, double low, double high) const {
    const auto voxel = [&](double x) {
      return static_cast<std::int64_t>(std::ceil((x - origin[k]) / step[k] - 0.5));
    };
    return {std::max<std::int64_t>(0, voxel(low)), std::min(count[k], voxel(high))};
  }
};

/// Assigns `number` to all voxels whose centres lie in the body. On a line along x the quadratic form is P_xx (x −
/// x₀)² + least, where P is the inverse of the shape matrix.
void fill(std::vector<std::int32_t>& voxels, const Grid& grid, const ParticleShape<3>& body,
          const Quaternion& orientation, const Vec3& centre, std::int32_t number) {
  const Mat3 form = (orientation.toRotationMatrix() *
                     body.half_lengths().cwiseAbs2().cwiseInverse().asDiagonal() *
                     orientation.toRotationMatrix().transpose());
  const Vec3 reach = half_extents(body, orientation);
  const auto [z_first, z_end] = grid.between(2, centre.z() - reach.z(), centre.z() + reach.z());
  const auto [y_first, y_end] = grid.between(1, centre.y() - reach.y(), centre.y() + reach.y());
  for (std::int64_t z = z_first; z < z_end; ++z)
    for (std::int64_t y = y_first; y < y_end; ++y) {
      const Vec2 off(grid.coordinate(1, y) - centre.y(), grid.coordinate(2, z) - centre.z());
      const double slope = form(0, 1) * off.x() + form(0, 2) * off.y();
      const double least = form(1, 1) * off.x() * off.x() + 2 * form(1, 2) * off.x() * off.y() +
                           form(2, 2) * off.y() * off.y() - slope * slope / form(0, 0);
      if (least > 1) continue;
      const double middle = centre.x() - slope / form(0, 0);
      const double half = std::sqrt((1 - least) / form(0, 0));
      const auto [x_first, x_end] = grid.between(0, middle - half, middle + half);
      const std::int64_t line = (z * grid.count[1] + y) * grid.count[0];
      for (std::int64_t x = x_first; x < x_end; ++x) voxels[line + x] = number;
    }
}

}  // namespace

void write_vti(const std::filesystem::path& path, const Packing& packing, std::size_t voxels) {
  const Configuration3& configuration = packing.configuration;
  const Grid grid(configuration.box, voxels);
  std::vector<std::int32_t> holder(grid.count.prod(), -1);
  for (const BodyInBox& body : packing.bodies)
    fill(holder, grid, configuration.shape[body.particle], configuration.orientation[body.particle],
         packing.centre(body), static_cast<std::int32_t>(body.particle));
  const std::string extent =
      fmt::format("0 {} 0 {} 0 {}", grid.count[0], grid.count[1], grid.count[2]);
  write_file(
      path,
      head("ImageData") +
          fmt::format("<ImageData WholeExtent=\"{}\" Origin=\"{} {} {}\" Spacing=\"{} {} {}\">\n"
                      "<Piece Extent=\"{}\">\n<CellData Scalars=\"particle\">\n",
                      extent, grid.origin[0], grid.origin[1], grid.origin[2], grid.step[0],
                      grid.step[1], grid.step[2], extent) +
          data_array("particle", 1, holder) + "</CellData>\n</Piece>\n</ImageData>\n</VTKFile>\n");
}

void write_vtp(const std::filesystem::path& path, const Packing& packing, StoredMotion motion) {
  const Configuration3& configuration = packing.configuration;
  std::vector<double> centres, axes, orientations, tensors, velocities, angular_velocities;
  std::vector<std::int32_t> particles, species, images, connectivity, offsets;
  for (const BodyInBox& body : packing.bodies) {
    const std::size_t i = body.particle;
    const Vec3& half_lengths = configuration.shape[i].half_lengths();
    const Quaternion& q = configuration.orientation[i];
    const Mat3 turn = q.toRotationMatrix();
    append(centres, packing.centre(body));
    append(axes, half_lengths);
    append(orientations, Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()));
    append(tensors, Mat3(turn * half_lengths.asDiagonal() * turn.transpose()));
    append(velocities, configuration.velocity[i]);
    append(angular_velocities, configuration.angular_velocity[i]);
    append(images, body.shift);
    particles.push_back(static_cast<std::int32_t>(i));
    species.push_back(configuration.species[i]);
    connectivity.push_back(static_cast<std::int32_t>(connectivity.size()));
    offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
  }
  std::string motions;
  if (motion.velocities) motions += data_array("velocity", 3, velocities);
  if (motion.angular_velocities) motions += data_array("angular velocity", 3, angular_velocities);
  const std::size_t n = packing.bodies.size();
  write_file(path,
             head("PolyData") +
                 fmt::format("<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" "
                             "NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
                             n, n) +
                 "<PointData Scalars=\"particle\" Tensors=\"tensor\">\n" +
                 data_array("particle", 1, particles) + data_array("species", 1, species) +
                 data_array("image", 3, images) + data_array("semi-axes", 3, axes) +
                 data_array("orientation", 4, orientations) + data_array("tensor", 9, tensors) +
                 motions + "</PointData>\n<Points>\n" + data_array("centres", 3, centres) +
                 "</Points>\n<Verts>\n" + data_array("connectivity", 1, connectivity) +
                 data_array("offsets", 1, offsets) +
                 "</Verts>\n</Piece>\n</PolyData>\n</VTKFile>\n");
}

void VtpSeries::write(const StoredFrame<3>& frame) {
  const std::string file = fmt::format("frame_{:04}.vtp", frame.index);
  write_vtp(folder_ / file, Packing(frame.configuration, shrink_), motion_);
  datasets_ += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n",
                           frame.configuration.time, file);
}

void VtpSeries::close() {
  write_file(folder_ / (name_ + ".pvd"),
             head("Collection") + "<Collection>\n" + datasets_ + "</Collection>\n</VTKFile>\n");
}

}  // namespace vitrel
