// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/flexbody/modal/maxwell_elements.hpp"

namespace limber::dynamics {

/// Frequencies at which the flexible bodies of a linked group deform: from the
/// lowest natural frequency of the group at rest to which their strain
/// contributes, to the highest of their own modes.
///
/// A mode whose strain energy in bodies is below 1 % of that in couplers and
/// bodies, such as rigid motion on a soft spring, does not count. Groups of
/// more than 1500 coordinates are not solved: the lowest frequency is then
/// estimated from below, by that of the bodies' own modes over 10 times the
/// number of flexible bodies.
/// @returns one per body; nothing for groups without flexible bodies
/// @throws InputError for a body at level `full`.
[[nodiscard]] std::vector<std::optional<flexbody::FrequencyBand>>
find_elastic_bands(const SystemModel& model, const SystemState& state);

}  // namespace limber::dynamics
