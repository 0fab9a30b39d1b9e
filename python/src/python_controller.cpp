// SPDX-License-Identifier: BSD-3-Clause
#include "python_controller.hpp"

#include <fmt/format.h>
#include <pybind11/numpy.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "interruption.hpp"
#include "limber/common/records/manifest.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"

namespace limber::python {
namespace {

/// Keeps a function; released with the GIL held.
std::shared_ptr<py::function> hold_function(const py::function& function) {
  return {new py::function(function), [](py::function* held) {
            const py::gil_scoped_acquire gil;
            delete held;
          }};
}

/// Calls Python code with the GIL. What it raises is kept as the cause of the
/// error that ends the run.
template <typename Work>
void call(const Work& work) {
  const py::gil_scoped_acquire gil;
  try {
    work();
  } catch (const py::error_already_set& error) {
    set_cause(error);
    if (error.matches(PyExc_KeyboardInterrupt)) {
      throw dynamics::Interrupted("interrupted");
    }
    const std::string type = py::str(error.type().attr("__name__"));
    const std::string words = py::str(error.value());
    throw std::runtime_error(type + (words.empty() ? "" : ": " + words));
  }
}

/// Numbers that a law returned: one, or one for each input.
void fill(const py::object& given, std::span<double> written) {
  if (given.is_none()) {
    throw std::runtime_error(fmt::format(
        "it returned None; expected {}",
        written.size() == 1 ? "a number"
                            : fmt::format("{} numbers", written.size())));
  }
  const auto values =
      py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(
          given);
  if (!values) {
    PyErr_Clear();
    throw std::runtime_error(
        fmt::format("it returned {}; expected numbers", name_type(given)));
  }
  if (values.size() != std::ssize(written)) {
    throw std::runtime_error(fmt::format("it returned {} numbers; expected {}",
                                         values.size(), written.size()));
  }
  std::copy_n(values.data(), written.size(), written.begin());
}

class PythonLaw final : public dynamics::Controller {
 public:
  PythonLaw(const py::function& law, bool has_memory, std::string identity)
      : law_(hold_function(law)),
        has_memory_(has_memory),
        identity_(std::move(identity)) {}

  void sample(const dynamics::ControllerView& view, std::span<double> memory,
              std::span<double> written) const override {
    call([&] {
      // Copies, as Python may keep them.
      const py::array_t<double> measured(std::ssize(view.measured),
                                         view.measured.data());
      if (!has_memory_) return fill((*law_)(view.t, measured), written);
      const py::array_t<double> own(std::ssize(memory), memory.data());
      fill((*law_)(view.t, measured, own), written);
      std::copy_n(own.data(), memory.size(), memory.begin());
    });
  }

  void describe(Manifest& out) const override {
    out.add("Python function", std::string_view(identity_));
  }

  [[nodiscard]] bool has_hidden_memory() const override { return !has_memory_; }

 private:
  std::shared_ptr<py::function> law_;
  bool has_memory_;
  std::string identity_;
};

}  // namespace

std::shared_ptr<const dynamics::Controller> make_python_law(
    const py::function& law, const std::optional<std::vector<double>>& memory,
    const std::string& identity) {
  return std::make_shared<const PythonLaw>(law, memory.has_value(), identity);
}

dynamics::Measurement make_python_measurement(const std::string& name,
                                              const py::function& measure) {
  return {
      name, "Python function " + name,
      [held = hold_function(measure)](const dynamics::SystemModel& /*model*/,
                                      const dynamics::SystemState& state) {
        double value = 0.0;
        call([&] {
          // A copy, as Python may keep it.
          value = (*held)(py::cast(state)).cast<double>();
        });
        return value;
      }};
}

}  // namespace limber::python
