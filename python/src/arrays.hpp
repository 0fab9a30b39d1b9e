// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/numpy.h>

#include <vector>

#include "bindings.hpp"

namespace limber::python {

/// A read-only NumPy array of memory that `owner` holds and does not change.
/// @param strides in doubles
[[nodiscard]] py::array view_of(const double* data,
                                const std::vector<py::ssize_t>& shape,
                                const std::vector<py::ssize_t>& strides,
                                const py::object& owner);

/// A list of numbers.
[[nodiscard]] py::array view_of(const std::vector<double>& values,
                                const py::object& owner);

/// An Eigen matrix, columns one after the other: shape (rows, columns).
template <typename Matrix>
[[nodiscard]] py::array view_of_matrix(const Matrix& matrix,
                                       const py::object& owner) {
  return view_of(matrix.data(), {matrix.rows(), matrix.cols()},
                 {1, matrix.rows()}, owner);
}

}  // namespace limber::python
