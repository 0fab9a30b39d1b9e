// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/flexbody/model/recipe.hpp"
#include "limber/flexbody/model/reduced_body.hpp"

/// Questions about values that are possible but unlikely, mostly because of a
/// wrong unit. Each states the value and the expected unit.
namespace limber::flexbody {

/// Of E below 1 MPa and of a density below 10 kg/m^3.
[[nodiscard]] std::vector<std::string> question_material(
    const MaterialRegion& region);

/// Of a part longer than 100 m or heavier than 1e6 kg.
[[nodiscard]] std::vector<std::string> question_size(const Vector3& size,
                                                     double mass);

/// Of a body's size, and of interfaces with more than half of the nodes of its
/// surface.
[[nodiscard]] std::vector<std::string> question_body(const ReducedBody& body);

}  // namespace limber::flexbody
