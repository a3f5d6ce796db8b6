#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/geometry/pose.h"

/// @file
/// Conversion between NumPy arrays and the vectors of the program.
namespace vitrel::python {

namespace py = pybind11;

/// Rows of numbers. An array is converted, and thus copied, only unless it already holds doubles in row-major order.
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// The number of rows of an array of shape (N, columns), or (N,) if `columns` is 0. Throws UserError if it has
/// another shape.
inline std::size_t require_rows(const py::array& array, int columns, const std::string& name) {
  const bool fits =
      columns == 0 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == columns;
  if (!fits)
    throw UserError(fmt::format("{} must have the shape {}", name,
                                columns == 0 ? "(N,)" : fmt::format("(N, {})", columns)));
  return static_cast<std::size_t>(array.shape(0));
}

/// Requires the shape as above, and exactly n rows.
inline void require_rows(const py::array& array, int columns, const std::string& name,
                         std::size_t n) {
  if (const std::size_t found = require_rows(array, columns, name); found != n)
    throw UserError(fmt::format("{} has {} rows, but must have {}", name, found, n));
}

template <int Dim>
Vec<Dim> row(const Doubles& array, std::size_t i) {
  return Eigen::Map<const Vec<Dim>>(array.data(static_cast<py::ssize_t>(i)));
}

/// The vectors as an array, without a copy. `owner` keeps them alive.
template <class Scalar, int Dim>
py::array_t<Scalar> view(std::vector<Eigen::Matrix<Scalar, Dim, 1>>& values, py::handle owner) {
  return py::array_t<Scalar>({values.size(), static_cast<std::size_t>(Dim)},
                             reinterpret_cast<Scalar*>(values.data()), owner);
}
template <class Scalar>
py::array_t<Scalar> view(std::vector<Scalar>& values, py::handle owner) {
  return py::array_t<Scalar>(values.size(), values.data(), owner);
}

/// An array that owns these values.
template <class Scalar>
py::array_t<Scalar> owned(std::vector<Scalar>&& values) {
  auto* kept = new std::vector<Scalar>(std::move(values));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<Scalar>*>(p); });
  return py::array_t<Scalar>(kept->size(), kept->data(), owner);
}
template <int Dim>
py::array_t<double> owned(std::vector<Vec<Dim>>&& values) {
  auto* kept = new std::vector<Vec<Dim>>(std::move(values));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<Vec<Dim>>*>(p); });
  return view<double, Dim>(*kept, owner);
}

}  // namespace vitrel::python
