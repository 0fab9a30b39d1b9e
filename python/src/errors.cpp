// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/errors.hpp"

#include <exception>
#include <filesystem>

#include "bindings.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"

namespace limber::python {
namespace {

/// Raises a class of limber.errors, whose only argument is the text.
void raise(const char* name, const char* text) {
  const py::object type = py::module_::import("limber.errors").attr(name);
  PyErr_SetObject(type.ptr(), type(text).ptr());
}

void translate(std::exception_ptr failure) {
  try {
    if (failure) std::rethrow_exception(failure);
  } catch (const InputError& error) {
    const py::object type =
        py::module_::import("limber.errors").attr("InputError");
    py::object raised = type(error.what());
    raised.attr("problems") = py::cast(error.problems());
    PyErr_SetObject(type.ptr(), raised.ptr());
  } catch (const dynamics::Interrupted& error) {
    raise("Interrupted", error.what());
  } catch (const NumericalError& error) {
    raise("NumericalError", error.what());
  } catch (const ContractError& error) {
    raise("ContractError", error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    PyErr_SetString(PyExc_OSError, error.what());
  }
}

}  // namespace

void bind_errors() { py::register_exception_translator(&translate); }

}  // namespace limber::python
