// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "limber/dynamics/newton/block_lu.hpp"
#include "limber/dynamics/newton/retained_bodies.hpp"
#include "limber/dynamics/newton/retained_transports.hpp"

namespace limber::dynamics {

/// A body whose increments are unknowns of the block LU of NewtonMatrix.
struct RetainedUnknowns {
  int body = 0;
  int first = 0;  ///< its first row of the LU
  int blocks = 0;
  int size = 0;                 ///< rigid motion and modes
  bool precedes_links = false;  ///< before the links, as if it were eliminated
};

/// Unknowns of the block LU: six a link, then those of retained bodies.
struct LuPlan {
  std::vector<RetainedUnknowns> retained;
  std::vector<int> retained_of_body;  ///< index into retained, -1: eliminated
  int rows = 0;
  RetainedTransports transports;
  BlockLu lu;
};

/// Two bodies whose increments a stiffness joins; world: -1.
using BodyPair = std::pair<int, int>;

/// Bodies with many links are retained, after their links, and bodies of
/// `pairs`, if they are none, before their links, so that no stiff link loses
/// their inertia to round-off; retained bodies that share links move relative
/// to each other. Pattern: links that share an eliminated body, retained bodies
/// with their links, and the bodies of a pair.
[[nodiscard]] LuPlan plan_lu(const LinkGraph& graph,
                             const std::vector<BodyPair>& pairs);

}  // namespace limber::dynamics
