// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace limber::dynamics {

/// Couplers and transmissions (links) by the bodies that they end on.
struct LinkGraph {
  int links = 0;
  std::vector<std::vector<int>> links_of_body;  ///< repeats allowed
  std::vector<int> blocks;     ///< of six; 0 if the body cannot be retained
  std::vector<int> sizes;      ///< of each body: rigid motion and modes
  std::vector<bool> moves;     ///< whether the body has rigid motion
  std::vector<bool> grounded;  ///< whether the link ends in the world, too
  std::vector<bool> ideal;     ///< whether it is an ideal joint
  std::vector<bool> anchored;  ///< whether one of its ends does not move
};

/// A body with so many links that NewtonMatrix keeps its increments as
/// unknowns.
struct RetainedBody {
  int body = 0;
  int parent =
      -1;  ///< index of an earlier retained body that it moves relative to
};

/// Eliminating a body of n links gives a dense block of n unknowns of six, n^3
/// / 3 products of blocks to factor; keeping it n b^2 + b^3 / 3, b its own
/// blocks. Two retained bodies that share links are expressed relative to each
/// other, or the stiffness between them would lose their inertia to round-off:
/// one is the parent of the other, or they have a common ancestor. A body that
/// shares links with retained bodies of two such trees is eliminated. So is one
/// of an ideal joint whose other end is retained or does not move: its rows
/// have no other pivots.
/// @returns the one with most links first
[[nodiscard]] std::vector<RetainedBody> choose_retained_bodies(
    const LinkGraph& graph);

}  // namespace limber::dynamics
