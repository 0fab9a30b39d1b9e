// SPDX-License-Identifier: BSD-3-Clause
#include "arrays.hpp"

namespace limber::python {

py::array view_of(const double* data, const std::vector<py::ssize_t>& shape,
                  const std::vector<py::ssize_t>& strides,
                  const py::object& owner) {
  std::vector<py::ssize_t> bytes;
  for (const py::ssize_t stride : strides) {
    bytes.push_back(stride * py::ssize_t{sizeof(double)});
  }
  py::array array(py::dtype::of<double>(), shape, bytes, data, owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

py::array view_of(const std::vector<double>& values, const py::object& owner) {
  return view_of(values.data(), {std::ssize(values)}, {1}, owner);
}

}  // namespace limber::python
