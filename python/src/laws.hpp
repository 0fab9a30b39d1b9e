// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "bindings.hpp"
#include "limber/joints/coupler_law.hpp"

namespace limber::python {

/// @throws InputError for an object that is no such law
[[nodiscard]] joints::CouplerLaw to_coupler_law(const py::object& given);
[[nodiscard]] std::vector<joints::ScalarLaw> to_scalar_laws(
    const std::vector<py::object>& given);
/// [(coordinate, law), ...]
[[nodiscard]] std::vector<joints::JointElement> to_elements(
    const std::vector<std::pair<int, py::object>>& given);

}  // namespace limber::python
