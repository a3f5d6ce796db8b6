#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/foreign/foreign_frame.h"

namespace vitrel {

/// Rows of named columns, one row per particle, as CSV and extended XYZ have them. These columns are read, all of them
/// optional but the positions:
///
///     frame, step, time, box_x, box_y, box_z     the same in all rows
///     id                                         the order of the particles
///     species
///     x, y, z; unwrapped_x, …; image_x, …        one of the first two
///     angle; qw, qx, qy, qz                      radians; a quaternion
///     a, b, c, or radius                         semi-axes
///     diameter, or diameter_x, …                 whole axes
///     mass; vx, vy, vz; omega, or omega_x, …
///
/// Other columns are skipped. A table without the column z, or with angles, is two-dimensional.
class ParticleTable {
 public:
  /// `renamed` lists columns that mean one of those above. Throws FileError, for `place`, if a column comes twice, or
  /// if a column is missing that is renamed or belongs together with others.
  ParticleTable(std::vector<std::string> columns, const std::string& place,
                const std::vector<ImportOptions::Column>& renamed = {});

  bool has(const std::string& column) const { return numbers_.contains(column); }
  /// Adds a row with one cell per column. Throws FileError, for `place` ("file:line"), if the number of cells is wrong
  /// or a cell that should be a number is none.
  void add(const std::vector<std::string_view>& cells, const std::string& place);
  std::size_t rows() const { return rows_; }
  /// Removes all rows.
  void clear();

  /// Returns all rows as one frame. Throws FileError, for `place`, if an id comes twice.
  ForeignFrame frame(const std::string& place) const;

 private:
  using Order = std::vector<std::size_t>;

  /// Returns a column in this order; empty if there is no such column.
  std::vector<double> numbers(const std::string& column, const Order& order) const;
  /// Returns vectors from three columns "x", "y", "z" behind a prefix; the third may be missing and is then 0.
  std::vector<Vec3> vectors(const std::string& prefix, const std::array<const char*, 3>& columns,
                            const Order& order) const;
  std::vector<Vec3> half_lengths(const Order& order) const;
  std::optional<double> single(const std::string& column) const;
  Order by_id(const std::string& place) const;

  std::vector<std::string> columns_;  ///< "" for columns that are skipped
  std::set<std::string> skipped_;
  std::map<std::string, std::vector<double>> numbers_;
  std::vector<std::string> species_;
  std::size_t rows_ = 0;
};

}  // namespace vitrel
