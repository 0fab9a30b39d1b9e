// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "limber/dynamics/system/controller.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::python {

/// A Python function as a control law. With memory it is called as
/// `law(t, measured, memory)`, else as `law(t, measured)`, and is then taken to
/// keep what it likes by itself (Controller::has_hidden_memory).
/// @param identity what checkpoints compare
[[nodiscard]] std::shared_ptr<const dynamics::Controller> make_python_law(
    const py::function& law, const std::optional<std::vector<double>>& memory,
    const std::string& identity);

/// A Python function `measure(state)` as what a controller measures.
[[nodiscard]] dynamics::Measurement make_python_measurement(
    const std::string& name, const py::function& measure);

}  // namespace limber::python
