// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace limber::dynamics {

/// Bodies with so many links that NewtonMatrix keeps their increments as
/// unknowns: eliminating a body of n links gives a dense block of n unknowns of
/// six, n^3 / 3 products of blocks to factor; keeping it n b^2 + b^3 / 3, b its
/// own blocks of six. No two of them share a link: without an eliminated body
/// between them, its stiffness would lose their inertia to round-off.
/// @param links_of_body of each body the links that end on it, repeats allowed
/// @param blocks_of_body of each body b; 0 for one to be eliminated
/// @returns their indices, the one with most links first
[[nodiscard]] std::vector<int> choose_hubs(
    const std::vector<std::vector<int>>& links_of_body,
    const std::vector<int>& blocks_of_body);

}  // namespace limber::dynamics
