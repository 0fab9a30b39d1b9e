// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber::dynamics {

/// Rotates the rows of a coupler's stiffness, forces and moments separately,
/// such that rows of free directions vanish. Mixed with constrained rows, they
/// would be lost in their round-off, which elimination would spread. Rows that
/// are free or dominated by their own direction stay, as those of a joint along
/// an axis of its frame.
/// @returns the rotation; its rows are those of the new K
[[nodiscard]] Matrix6 separate_free_rows(Matrix6& K);

}  // namespace limber::dynamics
