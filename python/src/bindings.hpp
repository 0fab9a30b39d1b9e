// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <string>

/// The module limber._core: what the library and the command do, as Python
/// sees it. What is convenient in Python is written in Python, in
/// python/limber.
namespace limber::python {

namespace py = pybind11;

void bind_errors();
void bind_run(py::module_& m);
void bind_scenario(py::module_& m);
void bind_analysis(py::module_& m);
void bind_linear(py::module_& m);
void bind_study(py::module_& m);
void bind_body(py::module_& m);
void bind_functions(py::module_& m);
void bind_laws(py::module_& m);
void bind_system(py::module_& m);
void bind_builder(py::module_& m);
void bind_simulator(py::module_& m);
void bind_batch(py::module_& m);

/// The name of the object's class.
[[nodiscard]] inline std::string name_type(const py::object& object) {
  return py::str(py::type::of(object).attr("__name__"));
}

}  // namespace limber::python
