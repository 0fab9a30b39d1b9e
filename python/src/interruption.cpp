// SPDX-License-Identifier: BSD-3-Clause
#include "interruption.hpp"

#include <chrono>
#include <memory>
#include <string>

#include "limber/dynamics/simulation/interrupted.hpp"

namespace limber::python {
namespace {

// A pointer, because a thread may end after Python.
thread_local PyObject* the_cause = nullptr;

void replace_cause(PyObject* cause) {
  PyObject* const before = the_cause;
  the_cause = cause;
  Py_XDECREF(before);
}

/// Released with the GIL held, whoever is the last to hold it.
using Held = std::shared_ptr<py::object>;

Held hold(const py::object& object) {
  return {new py::object(object), [](py::object* held) {
            const py::gil_scoped_acquire gil;
            delete held;
          }};
}

[[noreturn]] void interrupt(const py::error_already_set& error) {
  set_cause(error);
  const std::string name = py::str(error.type().attr("__name__"));
  throw dynamics::Interrupted(
      name == "KeyboardInterrupt" ? "interrupted" : "interrupted by " + name);
}

}  // namespace

void clear_cause() { replace_cause(nullptr); }

void set_cause(const py::error_already_set& error) {
  py::object value = error.value();
  if (error.trace()) PyException_SetTraceback(value.ptr(), error.trace().ptr());
  replace_cause(value.release().ptr());
}

py::object take_cause() {
  if (the_cause == nullptr) return py::none();
  const py::object cause = py::reinterpret_steal<py::object>(the_cause);
  the_cause = nullptr;
  return cause;
}

Progress make_watch(const py::object& callback) {
  return [callback = hold(callback)](std::string_view what, double fraction) {
    const py::gil_scoped_acquire gil;
    try {
      if (fraction < 1.0 && PyErr_CheckSignals() != 0) {
        throw py::error_already_set();
      }
      if (!callback->is_none()) (*callback)(std::string(what), fraction);
    } catch (const py::error_already_set& error) {
      interrupt(error);
    }
  };
}

bool SignalWatch::operator()() {
  constexpr double kBetween = 5e-3;  // s
  const double now = std::chrono::duration<double>(
                         std::chrono::steady_clock::now().time_since_epoch())
                         .count();
  if (now - requested_ < kBetween) return false;
  requested_ = now;
  const py::gil_scoped_acquire gil;
  if (PyErr_CheckSignals() == 0) return false;
  set_cause(py::error_already_set());
  return true;
}

}  // namespace limber::python
