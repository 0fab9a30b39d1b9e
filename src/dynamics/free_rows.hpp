// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/types.hpp"

namespace limber::dynamics {

/// Turns the rows of a coupler's stiffness, forces and moments apart, to where
/// those of directions that are free vanish. Left among the rows of held ones,
/// what a free direction says would be lost in their round-off, and elimination
/// would spread it.
/// @returns the turn; its rows are those of the new K
[[nodiscard]] Matrix6 separate_free_rows(Matrix6& K);

}  // namespace limber::dynamics
