// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/common/files/hdf5_file.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/results/history.hpp"

namespace limber::results {

/// A body's name; empty for the world.
[[nodiscard]] std::string name_body(const dynamics::SystemModel& model,
                                    dynamics::BodyIndex body);

/// Whether the motion of a body's nodes is linear in its modes: not at level
/// `full`, whose unknowns are nodes, nor at `nonlinear` (products of modes).
[[nodiscard]] bool moves_linearly(const dynamics::BodyModel& body);

/// Writes couplers, lines, loads and contacts into the group `scene`.
/// @throws InputError if it cannot be written.
void write_marks(Hdf5File& out, const dynamics::SystemModel& model,
                 const History& history);

}  // namespace limber::results
